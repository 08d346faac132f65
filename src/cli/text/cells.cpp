#include "cells.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <string_view>
#include <utility>
#include <vector>

#include "base/decimal.hpp"
#include "cli/output.hpp"
#include "tables.hpp"

namespace csgrt::cli {

namespace {

/// The characters of a name. Those of old databases may be in any encoding; then each byte is one.
std::u32string characters_of(const std::string& name) {
    try {
        return std::filesystem::path(name).u32string();
    } catch (const std::filesystem::filesystem_error&) {
        std::u32string all;
        for (const char c : name) all += static_cast<unsigned char>(c);
        return all;
    }
}

template <class List>
std::string_view bytes_of(const List& list) {
    return {reinterpret_cast<const char*>(list.data()), list.size() * sizeof(list[0])};
}

/// The checksum of a zip archive. `crc`: that of the bytes before.
std::uint32_t crc_of(std::string_view bytes, std::uint32_t crc = 0) {
    static const auto table = [] {
        std::array<std::uint32_t, 256> all;
        for (std::uint32_t i = 0; i < 256; ++i) {
            all[i] = i;
            for (int bit = 0; bit < 8; ++bit) all[i] = (all[i] & 1) ? 0xEDB88320u ^ (all[i] >> 1) : all[i] >> 1;
        }
        return all;
    }();
    crc = ~crc;
    for (const char c : bytes) crc = table[(crc ^ static_cast<unsigned char>(c)) & 255] ^ (crc >> 8);
    return ~crc;
}

/// Writes arrays as NumPy's savez() does: a zip archive without compression.
class NpzWriter {
public:
    explicit NpzWriter(OutputFile& out) : out_(out) {}

    void add(std::string name, const std::string& type, const std::vector<std::uint64_t>& shape,
             std::string_view bytes) {
        name += ".npy";
        const std::string head = npy_header("'" + type + "'", shape);
        const std::uint64_t size = head.size() + bytes.size();
        if (offset_ + size > std::numeric_limits<std::uint32_t>::max())
            throw Error(Status::file, "--grid-output: a .npz has 4 GiB at most: take fewer cells");
        constexpr std::uint16_t version = 20, day = 0x21;  // the first day, so that no two days differ
        std::string common;                                // what an array and its entry in the list have
        put<std::uint16_t>(common, {version, 0, 0, 0, day});
        put<std::uint32_t>(common, {crc_of(bytes, crc_of(head)), std::uint32_t(size), std::uint32_t(size)});
        put<std::uint16_t>(common, {std::uint16_t(name.size()), 0});
        const std::string begin = "PK\3\4" + common + name + head;
        out_.write(begin);
        out_.write(bytes);
        put<std::uint16_t>(list_ += "PK\1\2", {version});
        put<std::uint16_t>(list_ += common, {0, 0, 0});
        put<std::uint32_t>(list_, {0, std::uint32_t(offset_)});
        list_ += name;
        offset_ += begin.size() + bytes.size();
        ++arrays_;
    }
    void add(const std::string& name, const std::vector<std::string>& texts) {
        std::vector<std::u32string> rows;
        std::size_t longest = 1;
        for (const std::string& text : texts)
            longest = std::max(longest, rows.emplace_back(characters_of(text)).size());
        std::u32string all;
        for (std::u32string& row : rows) {
            row.resize(longest);
            all += row;
        }
        add(name, "<U" + std::to_string(longest), {rows.size()}, bytes_of(all));
    }
    void add(const std::string& of, const CellVolumes& rows) {
        const std::uint64_t count = rows.ids.size();
        add(of + "_cells", "<i4", {count, 3}, bytes_of(rows.cells));
        add(of + "_ids", "<i4", {count}, bytes_of(rows.ids));
        add(of + "_volumes", "<f8", {count}, bytes_of(rows.volumes));
        add(of + "_half_widths", "<f8", {count}, bytes_of(rows.half_widths));
    }
    void end() {
        const auto size = static_cast<std::uint32_t>(list_.size());
        put<std::uint16_t>(list_ += "PK\5\6", {0, 0, arrays_, arrays_});
        put<std::uint32_t>(list_, {size, std::uint32_t(offset_)});
        put<std::uint16_t>(list_, {0});
        out_.write(list_);
    }

private:
    template <class T>
    static void put(std::string& out, std::initializer_list<T> numbers) {
        append_bytes<T>(out, std::span(numbers.begin(), numbers.size()));
    }

    OutputFile& out_;
    std::string list_;
    std::uint64_t offset_ = 0;
    std::uint16_t arrays_ = 0;
};

using Materials = std::vector<std::pair<std::int32_t, std::string>>;  ///< numbers and names

void write_npz(const Measurement& result, const Materials& materials, OutputFile& out) {
    std::vector<std::string> regions, names;
    std::vector<std::int32_t> numbers;
    for (const Measured& m : result.parts)
        if (m.kind == MeasuredKind::region) regions.push_back(m.name);
    for (const auto& [number, name] : materials) {
        numbers.push_back(number);
        names.push_back(name);
    }
    const MeasuredGrid& grid = result.grid;
    NpzWriter npz(out);
    npz.add("shape", "<i4", {3}, bytes_of(grid.sides));
    npz.add("box", "<f8", {2, 3}, {reinterpret_cast<const char*>(&grid.box), sizeof grid.box});
    npz.add("region_names", regions);
    npz.add("region", grid.regions);
    npz.add("material_names", names);
    npz.add("material_numbers", "<i4", {numbers.size()}, bytes_of(numbers));
    npz.add("material", grid.materials);
    npz.end();
}

std::string in_xml(const std::string& name) {
    std::string text;
    for (const char32_t c : characters_of(name)) {
        const bool is_plain = c >= ' ' && c < 127 && c != '<' && c != '&' && c != '"';
        text += is_plain ? std::string(1, static_cast<char>(c)) : c < ' ' ? "?" : "&#" + std::to_string(c) + ";";
    }
    return text;
}

void write_vti(const MeasuredGrid& grid, const Materials& materials, OutputFile& out) {
    const std::size_t columns = grid.sides[0], rows = grid.sides[1], layers = grid.sides[2];
    const std::size_t count = columns * rows * layers;
    const auto [low, high] = grid.box;
    const Vec3 step = {(high.x - low.x) / static_cast<double>(columns), (high.y - low.y) / static_cast<double>(rows),
                       (high.z - low.z) / static_cast<double>(layers)};
    const auto text_of = [](const Vec3& v) { return shortest(v.x) + " " + shortest(v.y) + " " + shortest(v.z); };
    const std::string extent =
        "Extent=\"0 " + std::to_string(columns) + " 0 " + std::to_string(rows) + " 0 " + std::to_string(layers) + "\"";
    std::string head =
        "<VTKFile type=\"ImageData\" version=\"1.0\" byte_order=\"LittleEndian\" "
        "header_type=\"UInt64\">\n<ImageData Whole" +
        extent + " Origin=\"" + text_of(grid.box.low) + "\" Spacing=\"" + text_of(step) + "\">\n<Piece " + extent +
        ">\n<CellData Scalars=\"volume fraction\">\n";
    std::size_t offset = 0;
    const auto declare = [&](const std::string& name, const std::string& type, std::size_t bytes) {
        head += "<DataArray type=\"" + type + "\" Name=\"" + name + "\" format=\"appended\" offset=\"" +
                std::to_string(offset) + "\"/>\n";
        offset += sizeof(std::uint64_t) + count * bytes;
    };
    declare("volume fraction", "Float64", sizeof(double));
    declare("region", "Int32", sizeof(std::int32_t));
    for (const auto& [number, name] : materials) {
        const std::string usual = "material " + std::to_string(number);
        declare(in_xml(name == usual ? name : usual + " " + name), "Float64", sizeof(double));
    }
    out.write(head + "</CellData>\n</Piece>\n</ImageData>\n<AppendedData encoding=\"raw\">\n_");
    const auto write = [&out](const auto& values) {
        const std::uint64_t bytes = bytes_of(values).size();
        out.write({reinterpret_cast<const char*>(&bytes), sizeof bytes});
        out.write(bytes_of(values));
    };
    const auto place = [&](const std::array<std::int32_t, 3>& cell) {
        return std::size_t(cell[0]) + columns * (std::size_t(cell[1]) + rows * std::size_t(cell[2]));
    };
    const double whole = step.x * step.y * step.z;
    std::vector<double> fractions(count);
    const CellVolumes &all = grid.materials, &regions = grid.regions;
    for (std::size_t i = 0; i < all.ids.size(); ++i) fractions[place(all.cells[i])] += all.volumes[i] / whole;
    write(fractions);
    std::vector<std::int32_t> largest(count, -1);
    std::fill(fractions.begin(), fractions.end(), 0);
    for (std::size_t i = 0; i < regions.ids.size(); ++i) {
        const std::size_t at = place(regions.cells[i]);
        if (regions.volumes[i] <= fractions[at]) continue;
        fractions[at] = regions.volumes[i];
        largest[at] = regions.ids[i];
    }
    write(largest);
    std::size_t i = 0;
    for (const auto& [number, name] : materials) {
        std::fill(fractions.begin(), fractions.end(), 0);
        for (; i < all.ids.size() && all.ids[i] == number; ++i) fractions[place(all.cells[i])] = all.volumes[i] / whole;
        write(fractions);
    }
    out.write("\n</AppendedData>\n</VTKFile>\n");
}

}  // namespace

void write_cells(const Measurement& result, const std::string& path) {
    Materials materials;
    for (const Measured& m : result.parts)
        if (m.kind == MeasuredKind::material) materials.emplace_back(m.id, m.name);
    OutputFile out(path);
    if (extension_of(path) == ".npz")
        write_npz(result, materials, out);
    else
        write_vti(result.grid, materials, out);
    out.commit();
}

}  // namespace csgrt::cli
