// Tables for other programs: partitions as CSV or as NumPy's arrays.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <csgrt/renderer.hpp>

#include "cli/commands/commands.hpp"

namespace csgrt::cli {

/// The header of an array in NumPy's format 1.0. `type`: Python's text of its dtype. The header's size does not depend
/// on the numbers in `shape`.
std::string npy_header(std::string_view type, std::span<const std::uint64_t> shape);

/// Appends numbers as they lie in memory, which is little-endian.
template <class T>
void append_bytes(std::string& out, std::span<const T> numbers) {
    out.append(reinterpret_cast<const char*>(numbers.data()), numbers.size_bytes());
}

/// Appends a field of CSV, in quotes if RFC 4180 needs them.
void append_field(std::string& out, std::string_view text);

/// Writes the rows of rays: CSV with the columns of BRL-CAD's nirt, or packed records.
class RowTable {
public:
    /// Makes a table in any format but text.
    RowTable(const Model& model, RowFormat format);

    /// The header before the rows. `rows`: the number of rows, which only npy's header has.
    std::string header(std::uint64_t rows) const;
    /// Appends the rows of an answer's i-th ray. `number`: the ray's index among all rays.
    void append(std::string& out, std::uint64_t number, const Ray& ray, const Partitions& rows, std::size_t i) const;

private:
    void append_csv(std::string& out, std::uint64_t number, const Ray& ray, const Partitions& rows,
                    std::size_t row) const;

    RowFormat format_;
    std::vector<std::string> names_;  ///< for each region: three columns of CSV
    std::vector<int> los_;            ///< for each region: BRL-CAD's attribute los
};

}  // namespace csgrt::cli
