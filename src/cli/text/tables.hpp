// Tables for other programs: CSV, NumPy's arrays, and the rows of rays in either form.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <csgrt/renderer.hpp>

#include "cli/commands/commands.hpp"

namespace csgrt::cli {

/// The header of an array in NumPy's format 1.0. `type`: Python's text of its dtype. Its size does not depend on the
/// numbers in `shape`.
std::string npy_header(std::string_view type, std::span<const std::uint64_t> shape);

/// Appends numbers as they lie in memory, in the machine's order of bytes: little-endian.
template <class T>
void append_bytes(std::string& out, std::span<const T> numbers) {
    out.append(reinterpret_cast<const char*>(numbers.data()), numbers.size_bytes());
}

/// Appends a field of CSV, in quotes if RFC 4180 needs them.
void append_field(std::string& out, std::string_view text);

/// Writes the rows of rays: CSV with the columns of BRL-CAD's nirt, or packed records.
class RowTable {
public:
    /// Makes a table. The format is not text.
    RowTable(const Model& model, RowFormat format);

    /// The header before the rows, if there are `rows` of them; only npy needs the number.
    std::string header(std::uint64_t rows) const;
    /// Appends the rows of the i-th ray of an answer, whose number among all rays is `number`.
    void append(std::string& out, std::uint64_t number, const Ray& ray, const Partitions& rows, std::size_t i) const;

private:
    void append_csv(std::string& out, std::uint64_t number, const Ray& ray, const Partitions& rows,
                    std::size_t row) const;

    RowFormat format_;
    std::vector<std::string> names_;  ///< of the regions: the three columns of CSV behind the ray's
    std::vector<int> los_;            ///< of the regions
};

}  // namespace csgrt::cli
