// Renderer implementation: the data of a Renderer. renderer.cpp has construction, models and lists of rays;
// pictures.cpp has pictures.
#pragma once

#include <array>
#include <atomic>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>

#include <csgrt/renderer.hpp>

#include "base/clock.hpp"
#include "base/process.hpp"
#include "compile/frame.hpp"
#include "render/backend.hpp"
#include "render/model_impl.hpp"

namespace csgrt {

/// The backend, the model of the current call, and the statistics. Each call takes the model that was set last,
/// prepares the backend for it, and runs under a Watch.
struct Renderer::Impl {
    const unsigned process = process_number();  ///< its threads, and drivers' data, exist in this process only
    Settings settings;
    bool uses_drivers = false;
    Model model;                                              ///< of the current call; `next` may be another
    double tolerance = 0;                                     ///< as kernels get it, in millimetres
    std::array<std::shared_ptr<const ModelInUse>, 3> in_use;  ///< by ClaimingRegions; null: not needed yet
    std::unique_ptr<Backend> backend;
    std::vector<Warning> device_warnings;
    Statistics statistics;
    Framebuffer beside;  ///< for rays beside the pixels' middles
    Framebuffer passed;  ///< for ghosts

    Impl(Model of, const Settings& given) : settings(given), model(std::move(of)), next(model) {}

    std::mutex mutex;                   ///< guards the next two members
    Model next;                         ///< the model of the next call
    std::atomic<bool> has_next{false};  ///< `next` differs from `model`

    const CompiledScene& scene() const { return model.impl_->scene; }
    void use_model(bool is_reference);
    void take_next();
    std::shared_ptr<const ModelInUse> used(ClaimingRegions claims, bool is_reference);
    const CompiledScene& scene_of(ClaimingRegions claims) { return used(claims, backend->is_reference())->scene; }
    void warn(std::string reason);
    void set_up_devices();
    void use_reference();
    void start_call(std::uint64_t rays, bool every_partition, int width, int height);
    void prepare(bool every_partition, ClaimingRegions claims);
    void end_call(Clock::time_point start);

    void fit(Framebuffer& framebuffer, const kernel::Frame& frame, std::uint32_t channels, const Watch& watch) const;
    void draw(const PreparedFrame& prepared, Framebuffer& framebuffer, Watch& watch);
    const Image& draw_beside(const View& view, const Sampling& sampling, std::uint32_t channels, Watch& watch);
    std::optional<PreparedFrame> with_edges(PreparedFrame prepared) const;
    const Image& draw_with_edges(const View& view, const Sampling& sampling, std::uint32_t channels, Watch& watch);
    bool draw_coarse(const View& view, std::uint32_t channels, std::uint32_t more, Framebuffer& framebuffer,
                     const std::function<bool(int)>& coarse, Watch& watch);
    void add_samples(const View& view, const PreparedFrame& prepared, Framebuffer& framebuffer, Watch& watch);
    void add_ghosts(const View& view, Framebuffer& framebuffer, std::span<const float> distances, Watch& watch);
    std::uint32_t word_of(const float (&color)[4]) const;
    void render(const View& view, Framebuffer& framebuffer, const std::function<bool(int)>& coarse, Watch& watch);
    void trace(const RayList& list, RowReceiver& receiver, ClaimingRegions claims, Watch& watch);
    class WatchedTracer;
    /// Calls work(tracer) as one call of the user. `all`: the number of rays, if `work` traces several lists; 0: `work`
    /// traces one list.
    template <class Work>
    void call(const Work& work, std::uint64_t all = 0);
};

}  // namespace csgrt
