// A model and its Renderer, for pages that each have a view and looks of their own.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <initializer_list>
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

/// Who waits for an answer that takes long, or is long.
struct Client {
    std::function<bool()> is_wanted;  ///< false ends the work
    /// Begins an answer of all these bytes, and so many more, which `send_more` sends.
    std::function<void(std::initializer_list<std::string_view> parts, std::uint64_t later)> send;
    std::function<void(std::string_view)> send_more;
};

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
    void slice(const Request& request, const Client& client);
    /// A file. Throws Error, too, if it cannot be written.
    void exr(const Request& request, const Client& client);
    /// A picture of a page: the length of a text of JSON in 4 bytes, the text, and pixels. The newest of a page's ends
    /// those before it.
    void frame(const Request& request, const Client& client);

    /// The model is what ViewerOptions::load says now. If that throws, the old model stays, and status() has the error.
    void load_again();
    /// The old model stays, and status() has the error.
    void set_error(const std::string& error);

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

    /// Memory for an answer, which is there for the next again when it has been sent or given up. Answers that wait
    /// have none: all that are made or sent have most_lent bytes, or there is only one.
    class Lent {
    public:
        /// Waits for it; false: it was given up.
        Lent(Studio& from, std::size_t bytes, const std::function<bool()>& is_wanted);
        ~Lent();
        Lent(const Lent&) = delete;
        Lent& operator=(const Lent&) = delete;
        explicit operator bool() const { return bytes_ > 0; }

        std::vector<std::uint32_t> pixels = {};

    private:
        Studio& studio_;
        std::size_t bytes_ = 0;
    };

    const ViewerOptions options_;
    const std::string methods_;  ///< the options of how pictures are drawn; picks are in double precision
    mutable std::mutex current_mutex_;
    Current current_;
    std::string device_;  ///< what drew last; under current_mutex_, too
    std::map<std::string, std::shared_ptr<std::atomic<std::uint64_t>>> pages_;
    /// New memory takes the system longer than a GPU takes for the picture.
    std::vector<std::vector<std::uint32_t>> spare_pixels_;
    std::size_t lent_bytes_ = 0;

    std::timed_mutex exporting_, drawing_;
    const std::function<bool()>* wanted_ = nullptr;  ///< of the frame that is drawn
    Framebuffer framebuffer_;
    Renderer renderer_;
};

}  // namespace csgrt
