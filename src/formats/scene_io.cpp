#include <csgrt/scene_io.hpp>

#include <cstdio>
#include <filesystem>
#include <new>
#include <utility>

#include <unistd.h>

#include "formats/brlcad/asc.hpp"
#include "formats/brlcad/g/reader.hpp"
#include "formats/brlcad/g/bytes.hpp"
#include "formats/json/reader.hpp"
#include "formats/json/write/writer.hpp"
#include "formats/strict_scene.hpp"
#include "formats/brlcad/view_script.hpp"
#include "formats/text_source.hpp"
#include "base/floating_point.hpp"
#include "base/letters.hpp"
#include "base/new_file.hpp"

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

std::string extension_of(const std::string& path) { return lower(fs::path(path).extension().string()); }

}  // namespace

Scene load_scene(const std::string& path, const LoadOptions& options) {
    const FloatingPoint own;
    if (path == "-") return parse_scene(read_standard_input(), standard_input, options);
    const std::string extension = extension_of(path);
    if (extension == ".json") return read_json(path);
    if (extension == ".asc") return read_brlcad_asc(path, !options.strict, options.file_folders);
    if (extension == ".g") return read_brlcad_g(path, !options.strict, options.file_folders);
    if (target_of(path).direct) return parse_scene(read_file(path), path, options);
    std::error_code ignored;
    if (fs::is_directory(path, ignored)) refuse(path, "this is a folder", "name a scene in it");
    refuse(path.empty() ? "''" : path, "this is no scene by its name",
           "scenes end in .json (csgrt), .g or .asc (BRL-CAD, binary and text)");
}

Scene parse_scene(std::string bytes, const std::string& name, const LoadOptions& options) {
    const FloatingPoint own;
    try {
        if (bytes.starts_with("\x1f\x8b")) refuse(name, "this is compressed", "gunzip it first");
        if (is_brlcad_g(bytes)) {
            ByteSource source(name, std::move(bytes));
            source.file_folders = options.file_folders;
            return parse_brlcad_g(source, !options.strict);
        }
        TextSource source(name, std::move(bytes));
        source.file_folders = options.file_folders;
        const std::size_t first = source.text().find_first_not_of(" \t\r\n", source.begin());
        const bool is_json = first != std::string::npos && source.text()[first] == '{';
        return is_json ? parse_json_scene(source) : parse_brlcad_asc(source, !options.strict);
    } catch (const std::bad_alloc&) {
        throw Error(Status::out_of_memory, name + ": the model does not fit the memory");
    }
}

Camera load_view(const std::string& path) {
    const FloatingPoint own;
    return parse_view_script(TextSource::read(path));
}

void save_scene(const Scene& scene, const std::string& path) {
    const FloatingPoint own;
    if (path != "-" && extension_of(path) != ".json" && !target_of(path).direct) {
        refuse(path, "scenes are written as .json", "give the file a name that ends in .json");
    }
    const std::string text = json_scene_text(scene.lenient ? strict_scene(scene) : scene);  // .json is always strict
    if (path == "-") {
        std::fflush(stdout);
        NewFile::write_to(STDOUT_FILENO, text, "standard output");
        return;
    }
    NewFile file(path);
    file.write(text);
    file.keep();
}

}  // namespace csgrt
