// The command's write_image and read_image: they load csgrt::image when they are first called. OpenImageIO brings some 200
// libraries with it, and a command that writes no picture should not wait a quarter of a second for them.
#include <dlfcn.h>

#include <filesystem>

#include <csgrt/image.hpp>
#include <csgrt/renderer.hpp>

#include "image/functions.hpp"

namespace csgrt {
namespace {

const ImageFunctions& functions() {
    static const ImageFunctions* found = [] {
        // Beside the library that is here already: a sanitizer's dlopen knows nothing of this program's search path.
        Dl_info core;
        std::filesystem::path path;
        if (dladdr(reinterpret_cast<const void*>(&version), &core)) path = std::filesystem::path(core.dli_fname).parent_path();
        void* library = dlopen((path / CSGRT_IMAGE_LIBRARY).c_str(), RTLD_LAZY | RTLD_LOCAL);
        if (!library) library = dlopen(CSGRT_IMAGE_LIBRARY, RTLD_LAZY | RTLD_LOCAL);
        void* symbol = library ? dlsym(library, image_functions_name) : nullptr;
        if (!symbol) throw Error(Status::file, std::string("cannot load the library for pictures: ") + dlerror());
        return static_cast<const ImageFunctions*>(symbol);
    }();
    return *found;
}

}  // namespace

void write_image(const Image& image, const std::string& path, const std::string& format) {
    functions().write(image, path, format);
}

Image read_image(const std::string& path) { return functions().read(path); }

}  // namespace csgrt
