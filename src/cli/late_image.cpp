// Late image: the command's write_image and read_image, which load csgrt::image at their first call. OpenImageIO needs
// some 260 libraries, which take 0.2 s to load. A command without pictures does not load them, and a command that will
// write a picture loads them on a thread.
//
// Each library is loaded by its own dlopen, after the libraries that it needs: one dlopen of all would look up each
// symbol in all of them, and take almost twice as long. The build lists the libraries in this order
// (cmake/openimageio.cmake).
#include "late_image.hpp"

#include <dlfcn.h>

#include <exception>
#include <sstream>
#include <stop_token>
#include <string>
#include <thread>

#include <csgrt/image.hpp>

#include "base/load_fault.hpp"
#include "image/functions.hpp"
#include "component.hpp"
#include "fatal_end.hpp"
#include "interrupt.hpp"

namespace csgrt {
namespace {

std::jthread loading;
bool has_begun = false;  ///< whether loading has begun

/// Loads the libraries, none into the global scope. Returns at the next library after a request to stop.
void load_one_by_one(const std::stop_token& stop) {
    std::istringstream names(CSGRT_PICTURE_LIBRARIES);
    // RTLD_NOW: a library may fail here, because it is missing or uses symbols of libraries that it does not name. Then
    // the dlopen of csgrt::image loads or reports it.
    for (std::string name; !stop.stop_requested() && names >> name;) dlopen(name.c_str(), RTLD_NOW | RTLD_LOCAL);
}

const ImageFunctions& functions() {
    static const ImageFunctions* found = [] {
        const cli::LoadingNotice notice;
        cli::expect_picture_libraries();
        if (loading.joinable()) loading.join();
        if (!has_begun) load_one_by_one({});
        void* const library = cli::open_component(CSGRT_IMAGE_LIBRARY);
        void* symbol = library ? dlsym(library, image_functions_name) : nullptr;
        if (!symbol) {
            const std::string why = dlerror();
            const std::string what = "cannot load the library for pictures: ";
            if (lacked_memory(why)) throw Error(Status::out_of_memory, what + "not enough memory: " + why);
            throw Error(Status::file, what + why);
        }
        return static_cast<const ImageFunctions*>(symbol);
    }();
    return *found;
}

}  // namespace

void write_image(const Image& image, const std::string& path, const std::string& format,
                 const std::function<bool(double)>& progress) {
    functions().write(image, path, format, progress);
}

Image read_image(const std::string& path) { return functions().read(path); }

namespace cli {

ImageLoading::ImageLoading(const Command& command) {
    const auto* render = std::get_if<RenderArguments>(&command);
    if (!render || render->outputs.empty()) return;
    // With a named device, the libraries are not loaded ahead: its driver may need other releases of some of them
    // (Intel's needs a newer TBB), and the release that is loaded first serves both. A native device needs no driver.
    const std::string& device = render->settings.device;
    if (!device.empty() && !device.starts_with("native")) return;
    try {
        expect_picture_libraries();
        loading = std::jthread([](std::stop_token stop) {
            try {
                load_one_by_one(stop);
            } catch (const std::exception&) {  // there is no memory: functions() tries again, and reports the failure
            }
        });
        has_begun = true;
        if (render->repeat > 1) loading.join();  // otherwise loading would disturb the first frames' times
    } catch (const std::system_error&) {         // there is no thread: functions() loads the libraries
    }
}

ImageLoading::~ImageLoading() {
    const LoadingNotice notice;
    loading = {};
}

}  // namespace cli
}  // namespace csgrt
