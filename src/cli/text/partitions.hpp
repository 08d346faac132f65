// Partitions as text: for each ray a line "ray INDEX PARTITIONS OVERLAPS", then a line a partition,
//
//     region in out inx iny inz outx outy outz in-solid out-solid in-type out-type
//
// then a line an overlap, "overlap in out region region...". Numbers have 17 significant digits, so that they read back
// to the same bits. A blank or a backslash in a name is written as \ooo, its byte in octal. Lines that begin with # are
// comments.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include <csgrt/renderer.hpp>

#include "base/decimal.hpp"
#include "lines.hpp"

namespace csgrt::cli {

class PartitionWriter {
public:
    explicit PartitionWriter(const Model& model);

    /// Appends the lines of one ray to `out`. If a range cuts a partition, no solid is at the cut: the solid and its
    /// type are written as -.
    void append(std::string& out, std::uint64_t ray, const RayPartitions& partitions) const;

private:
    std::vector<std::string> regions_, solids_, types_;  ///< the last entry stands for no solid
};

/// Appends a number with 17 significant digits, as printf's %.17g does in the C locale.
void append_number(std::string& out, double value);
/// The numbers of a ray, "ox oy oz dx dy dz", or with commas.
std::string numbers_of(const Ray& ray, const char* between);
/// Appends a name and escapes its blanks, control characters and backslashes.
void append_name(std::string& out, std::string_view name);

/// A ray's answer, as it was read from a file.
struct TextRay {
    struct Partition {
        std::string region;
        double in = 0, out = 0;
        std::array<double, 6> normals{};
        std::array<std::string, 4> solids;  ///< in-solid out-solid in-type out-type
    };
    struct Overlap {
        double in = 0, out = 0;
        std::vector<std::string> regions;
    };
    std::uint64_t index = 0;
    std::vector<Partition> partitions;
    std::vector<Overlap> overlaps;
};

class PartitionReader {
public:
    /// Opens the file. Throws Error (file); so does next() if the file has another form.
    explicit PartitionReader(const std::string& path) : lines_(path, LineReader::Passes::one) {}

    /// Replaces `ray` by the next ray; false at the end of the file.
    bool next(TextRay& ray);

private:
    void next_words(std::size_t least, const char* form);
    double number(const Word& word) const;
    [[noreturn]] void fail(int column, const std::string& message, const char* form) const;

    LineReader lines_;
    std::vector<Word> words_;
};

}  // namespace csgrt::cli
