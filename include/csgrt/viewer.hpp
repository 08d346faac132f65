// Viewer: a page that shows a model in a browser. The Viewer is in the component csgrt::view, which csgrt itself does
// not need.
#pragma once

#include <functional>
#include <memory>
#include <string>

#include <csgrt/image.hpp>
#include <csgrt/model.hpp>
#include <csgrt/settings.hpp>

namespace csgrt {

/// The address on which a Viewer listens, and texts about its model.
struct ViewerOptions {
    std::string address = "127.0.0.1";  ///< of the interface; with another one, other machines can connect
    int port = 0;                       ///< 0: any free port
    std::string name = {};              ///< name of the model, on the page
    /// The words after `csgrt` and `csgrt shoot` that load the same model, quoted for a shell: a file, objects,
    /// options.
    std::string command = {};
    std::string file = {};             ///< when this file changes, `load` is called on another thread
    std::function<Model()> load = {};  ///< returns the current model; throws Error, which the page then shows
    /// Writes an .exr, for example csgrt::write_image of the component csgrt::image. Stops if the progress function,
    /// which it calls, returns false. Empty: the page does not offer an .exr.
    std::function<void(const Image&, const std::string&, const std::function<bool(double)>&)> write_exr = {};
};

/// Serves one page over HTTP, and draws for any number of browsers that have its address. The address holds a secret.
/// Requests without the secret are refused, as are requests with another host's name or from another host's page. No
/// request can open a file.
class CSGRT_API Viewer {
public:
    /// Starts to listen. Throws Error (file) if there is no such interface, the port is in use, or no thread is
    /// available, and the errors of Renderer.
    Viewer(Model model, const Settings& settings, ViewerOptions options);
    ~Viewer();
    Viewer(const Viewer&) = delete;
    Viewer& operator=(const Viewer&) = delete;

    /// The page's address: "http://127.0.0.1:40123/4f0c.../".
    const std::string& address() const;
    /// Answers requests until the page's button End is pressed, stop() is called, or `go_on` returns false, which is
    /// called at least twenty times a second. Then a picture that is being drawn or written is stopped. Call run()
    /// once.
    void run(const std::function<bool()>& go_on = {});
    /// Ends run(). Any thread.
    void stop();

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace csgrt
