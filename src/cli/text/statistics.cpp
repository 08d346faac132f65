#include "statistics.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>

#include "partitions.hpp"

namespace csgrt::cli {

namespace {

using Times = decltype(Statistics::ms);

/// The times in the order in which they are printed.
constexpr std::pair<const char*, double Times::*> times[] = {
    {"load", &Times::load},
    {"compile", &Times::compile},
    {"build", &Times::build},
    {"count_segments", &Times::count_segments},
    {"scan", &Times::scan},
    {"store_segments", &Times::store_segments},
    {"weave", &Times::weave},
    {"evaluate", &Times::evaluate},
    {"shade", &Times::shade},
    {"cull_tiles", &Times::cull_tiles},
    {"first_hits", &Times::first_hits},
    {"kernels", &Times::kernels},
    {"frame", &Times::frame},
    {"write", &Times::write},
};

std::string milliseconds(double value) {
    char text[64];
    std::snprintf(text, sizeof text, "%.4f", std::isfinite(value) ? value : 0.0);  // JSON has no infinity
    return text;
}

std::string shortest(double value) {
    std::string text;
    append_shortest(text, value);
    return text;
}

}  // namespace

std::string json_text(std::string_view text) {
    std::string out = "\"";
    for (char c : text) {
        if (c == '"' || c == '\\') {
            out += '\\';
            out += c;
        } else if (static_cast<unsigned char>(c) < 0x20) {
            char escape[8];
            std::snprintf(escape, sizeof escape, "\\u%04x", static_cast<unsigned>(c));
            out += escape;
        } else {
            out += c;
        }
    }
    return out + '"';
}

std::string to_json(const Statistics& s) {
    auto count = [](const char* name, std::uint64_t value) {
        return std::string("  \"") + name + "\": " + std::to_string(value) + ",\n";
    };
    auto text = [](const char* name, const std::string& value) {
        return std::string("  \"") + name + "\": " + json_text(value) + ",\n";
    };
    std::string out = "{\n" + text("device", s.device) + text("awaited_device", s.awaited_device) +
                      text("precision", s.precision) + text("method", s.method) +
                      "  \"tolerance\": " + shortest(s.tolerance) + ",\n";
    out += "  \"size\": [" + std::to_string(s.width) + ", " + std::to_string(s.height) + "],\n";
    out += count("rays", s.rays) + count("ends", s.ends) + count("segments", s.segments);
    out += "  \"partitions\": {\"used\": " + std::to_string(s.partitions_used) +
           ", \"allocated\": " + std::to_string(s.partitions_allocated) + "},\n";
    out += count("overlaps", s.overlaps) + count("device_bytes", s.device_bytes) +
           count("segment_bytes", s.segment_bytes) + count("partition_bytes", s.partition_bytes) +
           count("batches", s.batches);
    out += "  \"ms\": {";
    for (const auto& [name, member] : times)
        out += std::string(member == times[0].second ? "" : ", ") + "\"" + name + "\": " + milliseconds(s.ms.*member);
    return out + "}\n}\n";
}

Statistics median_of(const std::vector<Statistics>& frames) {
    Statistics result = frames.back();
    auto warm = frames.begin() + (frames.size() > 1 ? 1 : 0);
    std::vector<double> values;
    for (const auto& time : times) {
        values.clear();
        for (auto frame = warm; frame != frames.end(); ++frame) values.push_back(frame->ms.*time.second);
        std::sort(values.begin(), values.end());
        std::size_t half = values.size() / 2;
        result.ms.*time.second = values.size() % 2 ? values[half] : (values[half - 1] + values[half]) / 2;
    }
    return result;
}

}  // namespace csgrt::cli
