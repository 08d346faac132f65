// csgrt compare: compares two pictures or two files of partitions. The first bytes of a file tell its kind.
#include "compare.hpp"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <string_view>

namespace csgrt::cli {

namespace {

enum class Kind { picture, text };

Kind kind_of(const std::string& path) {
    std::error_code ignored;
    auto type = std::filesystem::status(path, ignored).type();
    if (type == std::filesystem::file_type::fifo) return Kind::text;  // a pipe's first bytes could not be read again
    constexpr std::string_view exr = "\x76\x2f\x31\x01", gzip = "\x1f\x8b", png = "\x89PNG";
    std::FILE* file = std::fopen(path.c_str(), "rb");
    char bytes[4] = {};
    std::size_t count = file ? std::fread(bytes, 1, sizeof bytes, file) : 0;
    int code = !file || std::ferror(file) ? errno : 0;
    if (file) std::fclose(file);
    if (code) throw Error(Status::file, path + ": cannot read: " + std::strerror(code));
    std::string_view head(bytes, count);
    if (head.starts_with(gzip)) throw Error(Status::file, path + ": is compressed: gunzip it first");
    if (head.starts_with(png))
        throw Error(Status::file, path + ": a PNG holds 8 bits of each colour: compare .exr files");
    return head == exr ? Kind::picture : Kind::text;
}

}  // namespace

std::string counted(std::uint64_t count, const char* noun) {
    return std::to_string(count) + " " + noun + (count == 1 ? "" : "s");
}

Status run(const CompareArguments& arguments) {
    Kind first = kind_of(arguments.first), second = kind_of(arguments.second);
    if (first != second)
        throw Error(Status::file, (first == Kind::picture ? arguments.second : arguments.first) +
                                      ": is no EXR picture, but the other file is one");
    return first == Kind::picture ? compare_images(arguments) : compare_partitions(arguments);
}

}  // namespace csgrt::cli
