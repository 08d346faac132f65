#include "partitions.hpp"

#include <algorithm>
#include <charconv>
#include <limits>

#include "cli/values.hpp"

namespace csgrt::cli {

namespace {

constexpr const char* ray_form = "expected: ray INDEX PARTITIONS OVERLAPS";
constexpr const char* partition_form =
    "expected: region in out inx iny inz outx outy outz in-solid out-solid in-type out-type";
constexpr const char* overlap_form = "expected: overlap in out region region...";

std::string escaped(std::string_view name) {
    std::string out;
    append_name(out, name);
    return out;
}

void append_numbers(std::string& out, std::initializer_list<double> values) {
    for (double value : values) {
        out += ' ';
        append_number(out, value);
    }
}

}  // namespace

void append_number(std::string& out, double value) {
    char text[64];
    out.append(text, std::to_chars(text, text + sizeof text, value, std::chars_format::general, 17).ptr);
}

std::string numbers_of(const Ray& ray, const char* between) {
    std::string text;
    for (const double value :
         {ray.origin.x, ray.origin.y, ray.origin.z, ray.direction.x, ray.direction.y, ray.direction.z}) {
        if (!text.empty()) text += between;
        append_number(text, value);
    }
    return text;
}

void append_name(std::string& out, std::string_view name) {
    for (char c : name) {
        auto byte = static_cast<unsigned char>(c);
        if (byte > ' ' && byte != 0x7f && c != '\\' && name != "-") {
            out += c;
        } else {
            out += '\\';
            for (int shift : {6, 3, 0}) out += static_cast<char>('0' + (byte >> shift & 7));
        }
    }
    if (name.empty()) out += '-';  // an empty name is still a word
}

PartitionWriter::PartitionWriter(const Model& model) {
    for (const RegionInfo& region : model.regions()) regions_.push_back(escaped(region.path));
    for (const SolidInfo& solid : model.solids()) {
        solids_.push_back(escaped(solid.name));
        types_.push_back(escaped(solid.type));
    }
    for (auto* names : {&solids_, &types_}) names->emplace_back("-");
}

void PartitionWriter::append(std::string& out, std::uint64_t ray, const RayPartitions& along) const {
    out += "ray " + std::to_string(ray) + ' ' + std::to_string(along.partitions.size()) + ' ' +
           std::to_string(along.overlaps.size()) + '\n';
    for (const Partition& p : along.partitions) {
        out += regions_.at(p.region);
        append_numbers(out, {p.in, p.out, p.in_normal.x, p.in_normal.y, p.in_normal.z, p.out_normal.x, p.out_normal.y,
                             p.out_normal.z});
        const std::size_t none = solids_.size() - 1, in = std::min<std::size_t>(p.in_solid, none),
                          last = std::min<std::size_t>(p.out_solid, none);
        for (const std::string* name : {&solids_[in], &solids_[last], &types_[in], &types_[last]})
            (out += ' ') += *name;
        out += '\n';
    }
    for (const Overlap& overlap : along.overlaps) {
        out += "overlap";
        append_numbers(out, {overlap.in, overlap.out});
        for (std::uint32_t region : overlap.regions) (out += ' ') += regions_.at(region);
        out += '\n';
    }
}

void PartitionReader::fail(int column, const std::string& message, const char* form) const {
    throw Error(Status::file, {lines_.finding(column, message, form)});
}

/// Reads the next line that is not a comment, and has at least `least` words.
void PartitionReader::next_words(std::size_t least, const char* form) {
    std::string_view line;
    do {
        if (!lines_.next(line))
            throw Error(Status::file, lines_.name() + ": ends in the middle of a ray: is it whole?");
        split(line, words_);
    } while (words_.empty() || words_[0].text[0] == '#');
    if (words_.size() < least) fail(words_.back().column, "too few words", form);
}

double PartitionReader::number(const Word& word) const {
    if (auto finite = parse_number(word.text)) return *finite;
    constexpr double infinity = std::numeric_limits<double>::infinity();
    if (word.text == "inf") return infinity;
    if (word.text == "-inf") return -infinity;
    if (word.text == "nan" || word.text == "-nan") return std::numeric_limits<double>::quiet_NaN();
    throw Error(Status::file, {lines_.finding(word.column, "'" + std::string(word.text) + "' is not a number")});
}

bool PartitionReader::next(TextRay& ray) {
    ray = {};
    std::string_view line;
    do {
        if (!lines_.next(line)) return false;
        split(line, words_);
    } while (words_.empty() || words_[0].text[0] == '#');
    if (words_.size() != 4 || words_[0].text != "ray") fail(words_[0].column, "no ray begins here", ray_form);
    std::uint64_t counts[3] = {};
    for (int i = 0; i < 3; ++i) {
        auto count = parse_count(words_[i + 1].text);
        if (!count)
            fail(words_[i + 1].column, "'" + std::string(words_[i + 1].text) + "' is not a whole number", ray_form);
        counts[i] = *count;
    }
    ray.index = counts[0];
    for (std::uint64_t i = 0; i < counts[1]; ++i) {
        next_words(13, partition_form);
        if (words_.size() > 13) fail(words_[13].column, "too many words", partition_form);
        auto& p = ray.partitions.emplace_back();
        p.region = words_[0].text;
        p.in = number(words_[1]);
        p.out = number(words_[2]);
        for (std::size_t k = 0; k < p.normals.size(); ++k) p.normals[k] = number(words_[3 + k]);
        for (std::size_t k = 0; k < p.solids.size(); ++k) p.solids[k] = words_[9 + k].text;
    }
    for (std::uint64_t i = 0; i < counts[2]; ++i) {
        next_words(3, overlap_form);
        if (words_[0].text != "overlap") fail(words_[0].column, "no overlap", overlap_form);
        auto& overlap = ray.overlaps.emplace_back();
        overlap.in = number(words_[1]);
        overlap.out = number(words_[2]);
        for (std::size_t k = 3; k < words_.size(); ++k) overlap.regions.emplace_back(words_[k].text);
    }
    return true;
}

}  // namespace csgrt::cli
