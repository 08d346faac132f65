// Lists of allowed overlaps: on each line two patterns of paths.
#include <algorithm>

#include <csgrt/check.hpp>

#include "formats/brlcad/values.hpp"
#include "formats/text_source.hpp"

namespace csgrt {

namespace {

constexpr std::string_view between = " \t\r";

/// Takes the first pattern of a line, whose place in the file is `at`. Empty: the line has no more. Throws Fault.
std::string take_pattern(std::string_view& line, std::size_t& at) {
    const auto skip = [&](std::size_t count) {
        line.remove_prefix(count);
        at += count;
    };
    skip(std::min(line.find_first_not_of(between), line.size()));
    if (line.empty() || line.front() == '#') return {};
    const std::size_t begin = at;
    std::size_t end = std::min(line.find_first_of(between), line.size());
    std::string pattern(line.substr(0, end));
    if (line.front() == '"') {
        end = line.find('"', 1);
        if (end == line.npos) throw Fault{begin, "a quotation mark has no second one on its line", {}};
        pattern = line.substr(1, end - 1);
        if (++end < line.size() && between.find(line[end]) == between.npos)
            throw Fault{begin + end, "no blank follows the quotation mark", {}};
    }
    skip(end);
    if (pattern.empty() || std::string_view("/*?[").find(pattern.front()) == std::string_view::npos)
        throw Fault{begin, quoted(pattern) + " can be no path, which begins with '/'", {}};
    return pattern;
}

}  // namespace

std::vector<AllowedOverlap> load_allowed_overlaps(const std::string& path) {
    const TextSource source = TextSource::read(path);
    Findings findings(source);
    std::vector<AllowedOverlap> rows;
    for (std::size_t begin = source.begin(), end = 0; begin < source.text().size(); begin = end + 1) {
        end = std::min(source.text().find('\n', begin), source.text().size());
        std::string_view line = source.text().substr(begin, end - begin);
        std::size_t at = begin;
        try {
            AllowedOverlap row{take_pattern(line, at), take_pattern(line, at)};
            if (row.first.empty()) continue;
            if (row.second.empty()) throw Fault{at, "the second pattern is missing", {}};
            if (const std::size_t after = at; !take_pattern(line, at).empty())
                throw Fault{after, "there are more than two patterns", {}};
            rows.push_back(std::move(row));
        } catch (Fault& fault) {
            fault.suggestion = "a line is two patterns of paths, such as /all/wheel.r \"/all/left axle/*\"";
            findings.add(std::move(fault), {});
        }
    }
    findings.throw_if_any();
    return rows;
}

}  // namespace csgrt
