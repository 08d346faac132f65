#include <cstdio>
#include <filesystem>
#include <string_view>

#include <unistd.h>

#include <csgrt/image.hpp>

#include "image/encode.hpp"
#include "image/threads.hpp"
#include "base/letters.hpp"
#include "base/new_file.hpp"

namespace csgrt {

namespace {

std::string extension_of(const std::string& path) {
    const std::string extension = lower(std::filesystem::path(path).extension().string());
    return extension.empty() ? extension : extension.substr(1);
}

}  // namespace

void write_image(const Image& image, const std::string& path, const std::string& format,
                 const std::function<bool(double)>& progress) {
    const FloatingPoint own;
    const auto encoded = [&](const std::string& as, const std::string& name) {
        return with_image_threads(name, [&] { return encode(image, as, name, progress); });
    };
    const auto text = [](const std::vector<unsigned char>& bytes) {
        return std::string_view(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    };
    if (path == "-") {
        std::fflush(stdout);
        NewFile::write_to(STDOUT_FILENO, text(encoded(format, "standard output")), "standard output");
        return;
    }
    // The name of a device or a pipe may have no extension. Then `format` gives the format.
    std::string by_name = extension_of(path);
    if (by_name != "exr" && by_name != "png" && target_of(path).direct) by_name = format;
    const std::vector<unsigned char> bytes = encoded(by_name, path);
    NewFile file(path);
    file.write(text(bytes));
    file.keep();
}

}  // namespace csgrt
