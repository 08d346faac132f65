// The session of `csgrt view`: one model and one Renderer, which several pages draw from. Each page has its own view
// and looks.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <initializer_list>
#include <list>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <csgrt/framebuffer.hpp>
#include <csgrt/renderer.hpp>
#include <csgrt/viewer.hpp>

#include "view/page_request.hpp"
#include "view/turns.hpp"

namespace csgrt {

/// The client waits for an answer that takes long to compute or to send.
struct Client {
    std::function<bool()> is_wanted;  ///< false ends the work
    /// Begins an answer: sends `parts`. `later`: the number of bytes that calls of `send_more` will add.
    std::function<void(std::initializer_list<std::string_view> parts, std::uint64_t later)> send;
    std::function<void(std::string_view)> send_more;
};

/// Bytes in zlib's format. The fastest level takes less time than the networks that need it.
std::string compressed(std::string_view bytes);

/// The session answers the requests of pages. Any thread may call any function. src/view/page/ says which members a
/// request and an answer have.
class ViewSession {
public:
    /// Throws as Renderer does.
    ViewSession(Model model, const Settings& settings, ViewerOptions options);

    /// The model, with the paths and looks of its regions in columns.
    Json model() const;
    Json status() const;
    /// What the page shows of parts, which are lists of regions: the numbers of each part's first region, and the box
    /// around the part.
    Json parts(const Request& request) const;
    Json pick(const Request& request);
    Json command(const Request& request) const;
    /// Sends a region's index for each pixel, in 4 bytes. -1: no region is there; -2: several are.
    void slice(const Request& request, const Client& client);
    /// Sends a picture as an OpenEXR file. Throws Error if the file cannot be written.
    void exr(const Request& request, const Client& client);
    /// Sends the regions that overlap in the model as it was loaded, as JSON.
    void check(const Request& request, const Client& client);
    /// Sends a picture to a page: 4 bytes with the length of a JSON text, the text, and the pixels. A page's newest
    /// request ends the page's earlier ones.
    void frame(const Request& request, const Client& client);

    /// Replaces the model by what ViewerOptions::load returns. If `load` throws, the old model stays, and status()
    /// reports the error.
    void load_again();
    /// Keeps the model. status() reports the error.
    void set_error(const std::string& error);

private:
    /// The model as it was loaded, and the models that pages' looks made of it.
    struct Current {
        Model base;
        std::uint64_t generation = 1;
        std::string error = {};
        std::list<std::pair<std::string, Model>> edited = {};  ///< most recently used first, by the text of their looks
    };
    /// A model with a page's looks. `generation`: the loaded model that the indices of regions belong to.
    struct EditedModel {
        Model model;
        std::uint64_t generation;
    };
    std::string shoot_command(const Ray& ray) const;
    std::string picture_command(const PageView& page) const;
    EditedModel model_with(const std::vector<Look>& looks);
    /// A Renderer, which draws one picture at a time.
    struct Drawer {
        Turns turns = {};
        const std::function<bool()>* wanted = nullptr;  ///< whether what is drawn now is still wanted
        Framebuffer framebuffer = {};
        std::optional<Renderer> renderer = {};
    };
    void make_renderer(Drawer& drawer, const Model& model);
    /// Waits until the drawer's turn comes, gives its Renderer the model and calls draw(). False: is_wanted() ended the
    /// wait or the drawing.
    bool draw_with(Drawer& drawer, const Model& model, const std::function<bool()>& is_wanted,
                   const std::function<void(Renderer&)>& draw);
    /// Notes that a picture of so many rays took so many ms.
    void note_picture(double rays, double ms);
    /// Draws a picture in short passes of slow_, each of them a rectangle of its pixels. Other pages draw theirs
    /// between two passes. Adds to `ms` what the passes take. False: is_wanted() ended the drawing.
    bool draw_in_passes(const Model& model, View view, const std::function<bool()>& is_wanted, Image& whole,
                        double& ms);

    /// Memory for answers of a kind. One answer may always be made, and others while all together take at most `most`.
    struct Budget {
        std::size_t most, used = 0;
    };
    /// Memory for an answer while the answer is made and sent. It goes back to `pool_` for the next answer.
    class AnswerMemory {
    public:
        /// Waits until there is enough memory. The object is false if is_wanted() ended the wait.
        AnswerMemory(ViewSession& from, Budget& budget, std::size_t bytes, const std::function<bool()>& is_wanted);
        ~AnswerMemory();
        AnswerMemory(const AnswerMemory&) = delete;
        AnswerMemory& operator=(const AnswerMemory&) = delete;
        explicit operator bool() const { return bytes_ > 0; }

        std::vector<std::uint32_t> pixels = {};
        Image whole = {};

    private:
        ViewSession& session_;
        Budget& budget_;
        std::size_t bytes_ = 0;
    };

    const ViewerOptions options_;
    const std::string methods_;  ///< the options of a command that draws alike; picks are in double precision
    mutable std::mutex current_mutex_;
    Current current_;
    std::string device_;  ///< the device that drew last; current_mutex_ guards it, too
    std::map<std::string, std::shared_ptr<std::atomic<std::uint64_t>>> pages_;
    /// Memory of finished answers. New memory would take the system longer than the picture takes a GPU.
    std::vector<std::pair<std::vector<std::uint32_t>, Image>> pool_;
    Budget answers_{64'000'000};  ///< four frames of 2000 x 2000
    Budget exports_{1'000'000'000};

    const Settings settings_;
    /// For pictures that take as long as a few passes at most, and slices; for the others, in passes. The second
    /// Renderer is made when it is needed first.
    Drawer quick_, slow_;
    Turns checks_;
    std::atomic<double> rays_of_pass_{1 << 20};  ///< as many as the last pictures let expect
};

}  // namespace csgrt
