#include "formats/brlcad/parts.hpp"

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>
#include <utility>

#include "formats/brlcad/values.hpp"

namespace csgrt {

namespace {

namespace fs = std::filesystem;

/// The longest path in a message; a user needs to see the whole path.
constexpr std::size_t longest_path = 1000;

/// The reason why a solid cannot be completed, as an exception that never leaves this file.
struct Lack {
    std::string reason;
};

std::uint64_t bytes_of(const Sketch& sketch) {
    struct {
        std::size_t operator()(const Sketch::Line&) const { return 0; }
        std::size_t operator()(const Sketch::Arc&) const { return 0; }
        std::size_t operator()(const Sketch::Bezier& c) const { return c.points.size(); }
        std::size_t operator()(const Sketch::Nurb& c) const {
            return c.points.size() + 2 * (c.knots.size() + c.weights.size());
        }
    } words;
    std::uint64_t bytes = sketch.vertices.size() * sizeof(Sketch::Point);
    for (const Sketch::Curve& curve : sketch.curves) {
        bytes += sizeof(Sketch::Curve) + 1 + sizeof(std::uint32_t) * std::visit(words, curve);
    }
    return bytes;
}

/// a x b, but at most a number that is larger than any file.
std::uint64_t capped_product(std::uint64_t a, std::uint64_t b) {
    constexpr std::uint64_t cap = max_file_bytes + 1;
    return a != 0 && b > cap / a ? cap : a * b;
}

void assign(std::vector<std::uint8_t>& cells, const std::string& bytes) { cells.assign(bytes.begin(), bytes.end()); }

/// Reads heights, the highest byte first.
void assign(std::vector<std::uint16_t>& heights, const std::string& bytes) {
    heights.resize(bytes.size() / 2);
    for (std::size_t i = 0; i < heights.size(); ++i) {
        const auto high = static_cast<std::uint8_t>(bytes[2 * i]), low = static_cast<std::uint8_t>(bytes[2 * i + 1]);
        heights[i] = static_cast<std::uint16_t>(high << 8 | low);
    }
}

/// The path without links and .., as far as it exists. Empty if the path cannot be resolved.
fs::path resolved(const fs::path& path) {
    std::error_code failed;
    const fs::path whole = fs::absolute(path, failed);
    fs::path result = failed ? fs::path() : fs::weakly_canonical(whole, failed);
    return failed ? fs::path() : result;
}

bool is_below(const fs::path& path, const fs::path& folder) {
    return std::mismatch(folder.begin(), folder.end(), path.begin(), path.end()).first == folder.end();
}

}  // namespace

BrlcadParts::BrlcadParts(fs::path folder, const std::vector<std::string>& allowed,
                         std::function<const BrlcadItem*(const std::string&)> find)
    : folder_(std::move(folder)), base_(resolved(folder_.empty() ? "." : folder_)), find_(std::move(find)) {
    for (const std::string& name : allowed)
        if (fs::path path = resolved(name); !path.empty()) allowed_.push_back(std::move(path));
}

void BrlcadParts::complete(Shape& shape, bool cells_in_object) {
    try {
        if (auto* extrude = std::get_if<Extrude>(&shape)) complete_sketch(extrude->sketch);
        if (auto* revolve = std::get_if<Revolve>(&shape)) complete_sketch(revolve->sketch);
        if (auto* ebm = std::get_if<Ebm>(&shape)) {
            assign(ebm->cells, take_cells({ebm->file, ebm->width, ebm->depth, 1, 1}, cells_in_object));
        } else if (auto* vol = std::get_if<Vol>(&shape)) {
            assign(vol->cells, take_cells({vol->file, vol->width, vol->depth, vol->height, 1}, cells_in_object));
        } else if (auto* dsp = std::get_if<Dsp>(&shape)) {
            assign(dsp->heights, take_cells({dsp->file, dsp->width, dsp->depth, 1, 2}, cells_in_object));
        }
    } catch (Lack& lack) {
        shape = Unsupported{type_name(shape), std::move(lack.reason)};
    }
}

void BrlcadParts::spend(std::uint64_t bytes) {
    if (bytes > most_bytes - spent_) {
        throw Lack{"the sketches and cells that the model's solids take exceed " + std::to_string(most_bytes >> 20) +
                   " MiB"};
    }
    spent_ += bytes;
}

void BrlcadParts::complete_sketch(Sketch& sketch) {
    const BrlcadItem* item = find_(sketch.name);
    const auto* found = item == nullptr ? nullptr : std::get_if<Sketch>(&item->content);
    if (found == nullptr) throw Lack{"no sketch of the name " + csgrt::quoted(sketch.name) + " is in the model"};
    spend(bytes_of(*found));
    sketch = *found;
}

std::string BrlcadParts::take_cells(const Cells& cells, bool in_object) {
    std::uint64_t bytes = capped_product(cells.width, cells.depth);
    bytes = capped_product(capped_product(bytes, cells.height), cells.size);
    if (bytes > max_file_bytes) {
        throw Lack{"its cells are more than " + std::to_string(max_file_bytes >> 20) + " MiB"};
    }
    spend(bytes);
    return in_object ? read_object(cells.source, bytes, cells.size) : read_file(cells.source, bytes);
}

/// Reads a file. Only a regular file of exactly the right size is opened, so no device or pipe. The message about a
/// file that the model may not name does not tell whether the file exists.
std::string BrlcadParts::read_file(const std::string& name, std::uint64_t bytes) const {
    const std::string what =
        "its cells are in the file " + csgrt::quoted((folder_ / name).string(), longest_path) + ", which ";
    // Each .. is removed first, so that no folder outside is tested for existence.
    const fs::path path = resolved((base_ / name).lexically_normal());
    if (std::none_of(allowed_.begin(), allowed_.end(), [&](const fs::path& f) { return is_below(path, f); }))
        throw Lack{what + "the model may not name: allow its folder with --allow-files"};
    std::error_code failed;
    if (!fs::is_regular_file(path, failed)) {
        throw Lack{what + (failed ? "cannot be read: " + failed.message() : "is no file")};
    }
    const std::uint64_t size = fs::file_size(path, failed);
    if (failed) throw Lack{what + "cannot be read: " + failed.message()};
    if (size != bytes) {
        throw Lack{what + "has " + std::to_string(size) + " bytes, not " + std::to_string(bytes)};
    }
    errno = 0;
    const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(path.string().c_str(), "rb"), &std::fclose);
    if (!file) throw Lack{what + "cannot be opened: " + std::strerror(errno)};
    std::string data(static_cast<std::size_t>(bytes), '\0');
    if (std::fread(data.data(), 1, data.size(), file.get()) != data.size()) {
        throw Lack{
            what + "cannot be read" +
            (std::ferror(file.get()) != 0 ? std::string(": ") + std::strerror(errno) : std::string(" to its end"))};
    }
    return data;
}

std::string BrlcadParts::read_object(const std::string& name, std::uint64_t bytes, unsigned size) const {
    const std::string what = "its cells are in the object " + csgrt::quoted(name) + ", which ";
    const BrlcadItem* item = find_(name);
    const auto* numbers = item == nullptr ? nullptr : std::get_if<BrlcadNumbers>(&item->content);
    if (numbers == nullptr) throw Lack{what + (item == nullptr ? "is not in the model" : "holds no numbers")};
    if (numbers->type != (size == 1 ? BrlcadNumbers::bytes : BrlcadNumbers::words)) {
        throw Lack{what + "holds no unsigned numbers of " + std::to_string(8 * size) + " bits"};
    }
    if (numbers->data.size() != bytes) {
        throw Lack{what + "has " + std::to_string(numbers->data.size()) + " bytes, not " + std::to_string(bytes)};
    }
    return numbers->data;
}

}  // namespace csgrt
