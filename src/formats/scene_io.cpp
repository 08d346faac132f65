#include <csgrt/scene_io.hpp>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>

#include <unistd.h>

#include "formats/brlcad_asc.hpp"
#include "formats/brlcad_g.hpp"
#include "formats/json_reader.hpp"
#include "formats/json_writer.hpp"
#include "formats/mended.hpp"
#include "formats/view_script.hpp"

namespace csgrt {

namespace {

namespace fs = std::filesystem;

[[noreturn]] void refuse(const std::string& path, std::string message, std::string suggestion = {}) {
    Diagnostic diagnostic;
    diagnostic.place.file = path;
    diagnostic.message = std::move(message);
    diagnostic.suggestion = std::move(suggestion);
    throw Error(Status::file, std::vector{std::move(diagnostic)});
}

std::string extension_of(const std::string& path) {
    std::string extension = fs::path(path).extension().string();
    std::transform(extension.begin(), extension.end(), extension.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return extension;
}

/// Writes all of it or says why not, as an errno.
int write_all(std::FILE* file, const std::string& text) {
    errno = 0;
    const bool written = std::fwrite(text.data(), 1, text.size(), file) == text.size() && std::fflush(file) == 0;
    return written ? 0 : errno;
}

/// Beside its place under a name of its own, then renamed: whoever looks finds the old file or the new one, whole.
void replace_file(const std::string& path, const std::string& text) {
    std::error_code ignored;
    fs::path target = fs::canonical(path, ignored);  // a link stays, and what it leads to is replaced
    if (ignored) target = path;
    const std::string temporary = target.string() + "." + std::to_string(getpid()) + ".part";
    std::FILE* file = std::fopen(temporary.c_str(), "wbx");
    if (file == nullptr) refuse(path, std::string("cannot be created: ") + std::strerror(errno));
    int failed = write_all(file, text);
    if (std::fclose(file) != 0 && failed == 0) failed = errno;
    if (failed == 0 && std::rename(temporary.c_str(), target.c_str()) != 0) failed = errno;
    if (failed == 0) return;
    std::remove(temporary.c_str());
    refuse(path, std::string("cannot be written: ") + std::strerror(failed));
}

/// Devices and pipes, which nothing can be renamed onto.
bool is_special(const std::string& path) {
    std::error_code ignored;
    return fs::exists(path, ignored) && !fs::is_regular_file(path, ignored) && !fs::is_directory(path, ignored);
}

void write_through(const std::string& path, const std::string& text) {
    std::FILE* file = std::fopen(path.c_str(), "wb");
    if (file == nullptr) refuse(path, std::string("cannot be opened: ") + std::strerror(errno));
    int failed = write_all(file, text);
    if (std::fclose(file) != 0 && failed == 0) failed = errno;
    if (failed != 0) refuse(path, std::string("cannot be written: ") + std::strerror(failed));
}

}  // namespace

Scene load_scene(const std::string& path, bool strict) {
    const std::string extension = extension_of(path);
    if (extension == ".json") return read_json(path);
    if (extension == ".asc") return read_brlcad_asc(path, !strict);
    if (extension == ".g") return read_brlcad_g(path, !strict);
    refuse(path, "this is no scene by its name", "scenes end in .json (csgrt), .g or .asc (BRL-CAD, binary and text)");
}

Camera load_view(const std::string& path) { return parse_view_script(TextSource::read(path)); }

void save_scene(const Scene& scene, const std::string& path) {
    if (path != "-" && extension_of(path) != ".json" && !is_special(path)) {
        refuse(path, "scenes are written as .json", "give the file a name that ends in .json");
    }
    const std::string text = json_scene_text(scene.lenient ? mended(scene) : scene);  // JSON is strict
    if (path == "-") {
        if (const int failed = write_all(stdout, text); failed != 0) {
            refuse("standard output", std::string("cannot be written: ") + std::strerror(failed));
        }
    } else if (is_special(path)) {
        write_through(path, text);
    } else {
        replace_file(path, text);
    }
}

}  // namespace csgrt
