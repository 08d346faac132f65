#include "report.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>

#include <csgrt/error.hpp>
#include <nlohmann/json.hpp>

namespace csgrt::bench {
namespace {

using Json = nlohmann::ordered_json;

/// JSON has no infinity: an end that should be finite and is not is null.
Json number(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

Json json_of(const Row& row) {
    Json json = {{"variant", row.variant}, {"workload", row.workload}, {"family", row.family}};
    if (!row.error.empty()) {
        json["error"] = row.error;
        return json;
    }
    const Accuracy& a = row.accuracy;
    json["rays"] = a.rays;
    json["decided"] = a.decided;
    json["ties"] = a.ties;
    json["rule"] = a.rule;
    json["wrong"] = a.wrong;
    json["wrong_ppm"] = a.decided ? Json(1e6 * static_cast<double>(a.wrong) / static_cast<double>(a.decided)) : Json();
    json["ends"] = a.error_mm.size();
    json["rule_ends"] = a.rule_ends;
    json["error_mm"] = {{"p999", number(quantile(a.error_mm, 0.999))}, {"worst", number(quantile(a.error_mm, 1))}};
    json["error_ulp"] = {{"p999", number(quantile(a.error_ulp, 0.999))}, {"worst", number(quantile(a.error_ulp, 1))}};
    if (row.ns_per_ray > 0) json["ns_per_ray"] = row.ns_per_ray;
    if (row.frame_ms > 0) json["frame_ms"] = row.frame_ms;
    return json;
}

}  // namespace

std::vector<std::string> timed_workloads(const Report& report) {
    std::vector<std::string> timed;
    for (const Row& row : report.rows)
        if (std::find(timed.begin(), timed.end(), row.workload) == timed.end()) timed.push_back(row.workload);
    for (const Row& row : report.rows)
        if (!(row.ns_per_ray > 0)) std::erase(timed, row.workload);
    std::vector<std::string> shared = timed;
    for (const Anchor& anchor : report.anchors)
        if (anchor.device_type == report.device_type)
            std::erase_if(shared, [&](const std::string& name) {
                return std::none_of(anchor.ms.begin(), anchor.ms.end(), [&](const auto& m) { return m.first == name; });
            });
    return shared.empty() ? timed : shared;
}

std::vector<Row> totals(const Report& report) {
    const std::vector<std::string> timed = timed_workloads(report);
    std::vector<Row> all;
    for (const Row& row : report.rows) {
        auto at = std::find_if(all.begin(), all.end(), [&](const Row& r) { return r.variant == row.variant; });
        if (at == all.end()) {
            all.push_back({row.variant, "all", "all", {}, timed.empty() ? 0.0 : 1.0, 0, {}});
            at = all.end() - 1;
        }
        at->accuracy += row.accuracy;
        if (std::find(timed.begin(), timed.end(), row.workload) != timed.end())
            at->ns_per_ray *= std::pow(row.ns_per_ray, 1 / static_cast<double>(timed.size()));
    }
    return all;
}

std::string to_json(const Report& report) {
    Json json = {{"device", report.device},  {"device_type", report.device_type}, {"csgrt", report.version},
                 {"size", report.size},      {"frames", report.frames},           {"rays", report.rays},
                 {"seconds", report.seconds}};
    json["anchors"] = Json::array();
    for (const Anchor& anchor : report.anchors) {
        Json ms = Json::object();
        for (const auto& [workload, value] : anchor.ms) ms[workload] = value;
        json["anchors"].push_back({{"name", anchor.name}, {"device_type", anchor.device_type}, {"ms", ms}});
    }
    json["timed_workloads"] = timed_workloads(report);
    json["totals"] = Json::array();
    for (const Row& row : totals(report)) json["totals"].push_back(json_of(row));
    json["results"] = Json::array();
    for (const Row& row : report.rows) json["results"].push_back(json_of(row));
    return json.dump(1) + "\n";
}

void write_whole(const std::string& text, const std::string& path) {
    const std::string unfinished = path + ".part";
    std::ofstream out(unfinished, std::ios::binary);
    out << text;
    out.close();
    if (!out || std::rename(unfinished.c_str(), path.c_str()) != 0) {
        std::remove(unfinished.c_str());
        throw Error(Status::file, path + ": cannot be written");
    }
}

}  // namespace csgrt::bench
