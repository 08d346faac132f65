// A page that shows a model in a browser: the component csgrt::view, which csgrt itself does not need.
#pragma once

#include <functional>
#include <memory>
#include <string>

#include <csgrt/image.hpp>
#include <csgrt/model.hpp>
#include <csgrt/settings.hpp>

namespace csgrt {

/// Where a Viewer listens, and what it knows about its model besides the model.
struct ViewerOptions {
    std::string address = "127.0.0.1";  ///< of the interface; with another one than this other machines can connect
    int port = 0;                       ///< 0: any that is free
    std::string name = {};              ///< the model's, on the page
    /// What stands behind `csgrt` and `csgrt shoot` to load the same model, quoted for a shell: a file, objects,
    /// options.
    std::string command = {};
    std::string file = {};             ///< when this file changes, `load` is called, on another thread
    std::function<Model()> load = {};  ///< the model as it is now; throws Error, which the page then shows
    /// Writes an .exr, unless the progress that it calls says no: csgrt::write_image, where csgrt::image is there.
    /// Empty: the page does not offer it.
    std::function<void(const Image&, const std::string&, const std::function<bool(double)>&)> write_exr = {};
};

/// Serves one page over HTTP, and draws for any number of browsers that have its address. The address holds a secret;
/// without it, or with another host's name or page behind the request, every request is refused. No file is opened at a
/// client's word.
class CSGRT_API Viewer {
public:
    /// Listens from now on. Throws Error: file if there is no such interface, the port is taken, or there is no thread
    /// to answer with; as Renderer does.
    Viewer(Model model, const Settings& settings, ViewerOptions options);
    ~Viewer();
    Viewer(const Viewer&) = delete;
    Viewer& operator=(const Viewer&) = delete;

    /// "http://127.0.0.1:40123/4f0c.../": of the page.
    const std::string& address() const;
    /// Answers requests until the page's button End is pressed, stop() is called or `go_on`, which is called twenty
    /// times a second or more, returns false. What is being drawn or written ends then. Once.
    void run(const std::function<bool()>& go_on = {});
    /// Ends run(). Any thread.
    void stop();

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace csgrt
