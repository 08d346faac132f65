// A model and its Renderer, for pages that each have a view and looks of their own.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <list>
#include <map>
#include <mutex>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <csgrt/framebuffer.hpp>
#include <csgrt/renderer.hpp>
#include <csgrt/viewer.hpp>

#include "view/asked.hpp"

namespace csgrt {

/// Any thread may call everything. A request has the members that page.html sends; answers are those that it expects.
class Studio {
public:
    /// Throws as Renderer does.
    Studio(Model model, const Settings& settings, ViewerOptions options);

    Json model() const;
    Json status() const;
    Json pick(const Request& request);
    Json command(const Request& request) const;
    /// Numbers of regions, 4 bytes each; -1 nothing, -2 several.
    std::string slice(const Request& request);
    /// The bytes of a file. Throws Error, too, if the file cannot be written.
    std::string exr(const Request& request);

    /// A picture of a page. The newest of a page's ends those before it; `is_wanted` ends it, too.
    class Frame {
    public:
        /// The answer in pieces: the length of a text of JSON in 4 bytes, the text, and pixels.
        void draw(const std::function<bool()>& is_wanted, const std::function<void(std::string_view)>& send);

    private:
        friend class Studio;
        Studio* studio = nullptr;
        Asked asked = {};
        std::shared_ptr<std::atomic<std::uint64_t>> newest = {};
        std::uint64_t number = 0;
        bool deflates = false;
    };
    Frame frame(const Request& request);

    /// The model is what ViewerOptions::load says now. If that throws, the old model stays, and status() has the error.
    void load_again();

private:
    /// The model as the file has it, and with what looks it was asked for.
    struct Current {
        Model base;
        std::vector<std::string> paths = {};  ///< of its regions, in order
        std::uint64_t generation = 1;
        std::string error = {};
        std::list<std::pair<std::string, Model>> dressed = {};  ///< the last ones, the latest first
    };
    /// The model with these looks; the numbers of regions are those of `generation`.
    struct Dressed {
        Model model;
        std::uint64_t generation;
    };
    std::string picture_command(const Asked& asked) const;
    Dressed model_with(const std::vector<Look>& looks);
    /// Calls draw() when no other frame is drawn, and the Renderer has the model; false: it was given up.
    bool with_renderer(const Model& model, const std::function<bool()>& is_wanted, const std::function<void()>& draw);

    /// Pixels of a frame before, which are there for the next again when they have been sent or given up.
    struct Lent {
        explicit Lent(Studio& from);
        ~Lent();
        Lent(const Lent&) = delete;
        Lent& operator=(const Lent&) = delete;
        Studio& studio;
        std::vector<std::uint32_t> pixels = {};
    };

    const ViewerOptions options_;
    const std::string methods_;  ///< the options of how pictures are drawn; picks are in double precision
    mutable std::mutex current_mutex_;
    Current current_;
    std::string device_;  ///< what drew last; under current_mutex_, too
    std::map<std::string, std::shared_ptr<std::atomic<std::uint64_t>>> pages_;
    /// New memory takes the system longer than a GPU takes for the picture.
    std::vector<std::vector<std::uint32_t>> spare_pixels_;

    std::timed_mutex drawing_;
    const std::function<bool()>* wanted_ = nullptr;  ///< of the frame that is drawn
    Framebuffer framebuffer_;
    Renderer renderer_;
};

}  // namespace csgrt
