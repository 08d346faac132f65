#include "report.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iterator>

#include <csgrt/error.hpp>
#include <nlohmann/json.hpp>

namespace csgrt::bench {
namespace {

using Json = nlohmann::ordered_json;

/// JSON has no infinity: an end that should be finite and is not is null.
Json finite_or_null(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

/// The same with six digits.
Json number(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.6g", value);
    return finite_or_null(std::strtod(text, nullptr));
}

Json ppm(std::size_t part, std::size_t all) {
    return all ? number(1e6 * static_cast<double>(part) / static_cast<double>(all)) : Json();
}

Json interval(const ConfidenceInterval& of, double unit = 1) { return {number(unit * of.low), number(unit * of.high)}; }

/// An element of a list a line: so a file of two megabytes can be read, and compared with another one.
std::string to_lines(const Json& json) {
    std::string text = "{";
    for (const auto& [key, value] : json.items()) {
        text += (text.size() > 1 ? ",\n" : "") + Json(key).dump() + ": ";
        if (!value.is_array() || value.empty()) {
            text += value.dump();
            continue;
        }
        char before = '[';
        for (const Json& one : value) {
            text += before;
            text += '\n' + one.dump();
            before = ',';
        }
        text += ']';
    }
    return text + "}\n";
}

Json json_of(const Row& row) {
    Json json = {{"variant", row.variant}, {"method", row.method}, {"mode", name_of(row.mode)}};
    if (!row.knob.empty()) {
        json["knob"] = row.knob;
        json["knob_value"] = row.knob_value;
    }
    json["laboratory"] = row.laboratory;
    json["exact"] = row.exact;
    json["workload"] = row.workload;
    json["family"] = row.family;
    if (!row.device.empty()) json["device"] = row.device;
    if (!row.refusals.empty()) {
        json["refusals"] = Json::array();
        for (const auto& [words, rays] : row.refusals) json["refusals"].push_back({{"why", words}, {"rays", rays}});
    }
    if (!row.error.empty()) {
        json["error"] = row.error;
        return json;
    }
    const Accuracy& a = row.accuracy;
    json["rays"] = a.rays;
    json["unanswered"] = a.unanswered;
    const std::size_t answered = a.rays - a.unanswered;
    json["answered_share"] = a.rays ? number(static_cast<double>(answered) / static_cast<double>(a.rays)) : Json();
    json["decided"] = a.decided;
    json["ties"] = a.ties;
    json["rule"] = a.rule;
    json["wrong"] = a.wrong;
    json["wrong_ppm"] = ppm(a.wrong, a.decided);
    json["wrong_ppm_interval"] = interval(share_interval(a.wrong, a.decided), 1e6);
    json["misplaced"] = a.misplaced;
    json["misplaced_ppm"] = ppm(a.misplaced, a.decided);
    json["ends"] = a.error_mm.count();
    json["rule_ends"] = a.rule_ends;
    json["error_mm"] = {{"p999", number(a.error_mm.quantile(0.999))}, {"worst", number(a.error_mm.worst())}};
    json["error_ulp"] = {{"p999", number(a.error_ulp.quantile(0.999))}, {"worst", number(a.error_ulp.worst())}};
    if (row.ns_per_ray > 0) {
        json["ns_per_ray"] = number(row.ns_per_ray);
        json["ns_per_ray_interval"] = interval(row.ns);
    }
    if (row.timed_rays > 0 && row.ns_per_ray > 0) json["timed_rays"] = row.timed_rays;
    if (row.frame_ms > 0) json["frame_ms"] = number(row.frame_ms);
    for (const auto& [name, value] : row.figures) json["figures"][name] = number(value);
    return json;
}

Json json_of(const Total& total) {
    Json json = json_of(total.row);
    json["timed_on"] = total.timed_on;
    if (total.of_default > 0) json["of_default"] = number(total.of_default);
    if (!total.failed.empty()) json["failed"] = total.failed;
    return json;
}

/// What the others' times are divided by, or null.
const Row* default_row(const Report& report, const std::string& workload, Mode mode) {
    for (const Row& row : report.rows)
        if (row.variant == report.rows.front().variant && row.workload == workload && row.mode == mode &&
            row.ns_per_ray > 0)
            return &row;
    return nullptr;
}

}  // namespace

std::vector<std::string> timed_workloads(const Report& report) {
    std::vector<std::string> timed;
    for (const Row& row : report.rows)
        if (row.variant == report.rows.front().variant && row.ns_per_ray > 0 && row.family != "deep" &&
            std::find(timed.begin(), timed.end(), row.workload) == timed.end())
            timed.push_back(row.workload);
    std::vector<std::string> shared = timed;
    for (const Anchor& anchor : report.anchors)
        if (anchor.device_type == report.device_type)
            std::erase_if(shared, [&](const std::string& name) {
                return std::none_of(anchor.ms.begin(), anchor.ms.end(), [&](const auto& m) { return m.first == name; });
            });
    return shared.empty() ? timed : shared;
}

std::vector<Total> totals(const Report& report, bool by_family) {
    const std::vector<std::string> timed = timed_workloads(report);
    struct Sum {
        Total total;
        std::size_t on_timed = 0, beside_default = 0;
        double ns = 0, low = 0, high = 0, ratio = 0;  // sums of logarithms
    };
    std::vector<Sum> sums;
    for (const Row& row : report.rows) {
        const std::string family = by_family ? row.family : "all";
        auto at = std::find_if(sums.begin(), sums.end(), [&](const Sum& sum) {
            const Row& r = sum.total.row;
            return r.variant == row.variant && r.mode == row.mode && r.family == family;
        });
        if (at == sums.end()) {
            Sum sum;
            Row& r = sum.total.row;
            r = row;
            r.workload = "all";
            r.family = family;
            r.accuracy = {};
            r.ns_per_ray = r.frame_ms = 0;
            r.ns = {};
            r.timed_rays = 0;
            r.refusals.clear();
            r.figures.clear();
            r.error.clear();
            at = sums.insert(sums.end(), sum);
        }
        Row& all = at->total.row;
        if (!row.error.empty()) {
            at->total.failed.push_back(row.workload);
            continue;
        }
        all.accuracy += row.accuracy;
        for (const auto& [words, rays] : row.refusals) all.refusals[words] += rays;
        for (const auto& [name, value] : row.figures) all.figures[name] = std::max(all.figures[name], value);
        if (!(row.ns_per_ray > 0)) continue;
        ++at->total.timed_on;
        if (std::find(timed.begin(), timed.end(), row.workload) == timed.end()) continue;
        ++at->on_timed;
        at->ns += std::log(row.ns_per_ray);
        at->low += std::log(row.ns.low);
        at->high += std::log(row.ns.high);
        if (const Row* beside = default_row(report, row.workload, row.mode)) {
            ++at->beside_default;
            at->ratio += std::log(row.ns_per_ray / beside->ns_per_ray);
        }
    }
    std::vector<Total> all;
    for (Sum& sum : sums) {
        const double n = static_cast<double>(sum.on_timed);
        if (sum.on_timed > 0 && (by_family || sum.on_timed == timed.size())) {
            sum.total.row.ns_per_ray = std::exp(sum.ns / n);
            sum.total.row.ns = {std::exp(sum.low / n), std::exp(sum.high / n)};
        }
        if (sum.beside_default > 0)
            sum.total.of_default = std::exp(sum.ratio / static_cast<double>(sum.beside_default));
        all.push_back(std::move(sum.total));
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
        json["anchors"].push_back({{"name", anchor.name},
                                   {"device_type", anchor.device_type},
                                   {"mode", name_of(Mode::first_hits)},
                                   {"ms", ms}});
    }
    json["methods"] = Json::array();
    for (const Method& method : report.methods)
        json["methods"].push_back({{"name", method.name},
                                   {"source", method.source},
                                   {"about", method.about},
                                   {"breaks", method.breaks},
                                   {"knob", method.knob},
                                   {"exact", method.exact},
                                   {"on_device", method.on_device}});
    json["timed_workloads"] = timed_workloads(report);
    json["totals"] = Json::array();
    for (const Total& total : totals(report)) json["totals"].push_back(json_of(total));
    json["families"] = Json::array();
    for (const Total& total : totals(report, true)) json["families"].push_back(json_of(total));
    json["results"] = Json::array();
    for (const Row& row : report.rows) json["results"].push_back(json_of(row));
    return to_lines(json);
}

namespace {

Json whole_json(const Errors& errors) {
    return {{"counts", errors.counts()}, {"worst", finite_or_null(errors.worst())}};
}
Errors errors_of(const Json& json) {
    const Json& worst = json.at("worst");
    return {json.at("counts").get<std::vector<std::int64_t>>(), worst.is_null() ? HUGE_VAL : worst.get<double>()};
}

}  // namespace

std::string rows_to_json(const std::vector<Row>& rows, const std::string& key) {
    Json json = {{"key", key}, {"rows", Json::array()}};
    for (const Row& row : rows) {
        const Accuracy& a = row.accuracy;
        json["rows"].push_back(
            {{"names", {row.variant, row.workload, row.family, row.method, row.knob, row.device, row.error}},
             {"first_hits", row.mode == Mode::first_hits},
             {"laboratory", row.laboratory},
             {"exact", row.exact},
             {"counts",
              {a.rays, a.decided, a.ties, a.rule, a.unanswered, a.wrong, a.misplaced, a.rule_ends, row.timed_rays}},
             {"error_mm", whole_json(a.error_mm)},
             {"error_ulp", whole_json(a.error_ulp)},
             {"times", {row.knob_value, row.ns_per_ray, row.ns.low, row.ns.high, row.frame_ms}},
             {"refusals", row.refusals},
             {"figures", row.figures}});
    }
    return json.dump() + "\n";
}

std::optional<std::vector<Row>> rows_from_json(const std::string& text, const std::string& key, std::string& fault) {
    try {
        const Json json = Json::parse(text);
        if (json.at("key").get<std::string>() != key) {
            fault = "it was measured otherwise";
            return std::nullopt;
        }
        std::vector<Row> rows;
        for (const Json& from : json.at("rows")) {
            Row row;
            std::string* const names[] = {&row.variant, &row.workload, &row.family, &row.method,
                                          &row.knob,    &row.device,   &row.error};
            Accuracy& a = row.accuracy;
            std::size_t* const counts[] = {&a.rays,  &a.decided,   &a.ties,      &a.rule,        &a.unanswered,
                                           &a.wrong, &a.misplaced, &a.rule_ends, &row.timed_rays};
            double* const times[] = {&row.knob_value, &row.ns_per_ray, &row.ns.low, &row.ns.high, &row.frame_ms};
            for (std::size_t i = 0; i < std::size(names); ++i) from.at("names").at(i).get_to(*names[i]);
            for (std::size_t i = 0; i < std::size(counts); ++i) from.at("counts").at(i).get_to(*counts[i]);
            for (std::size_t i = 0; i < std::size(times); ++i) from.at("times").at(i).get_to(*times[i]);
            row.mode = from.at("first_hits").get<bool>() ? Mode::first_hits : Mode::every_partition;
            from.at("laboratory").get_to(row.laboratory);
            from.at("exact").get_to(row.exact);
            a.error_mm = errors_of(from.at("error_mm"));
            a.error_ulp = errors_of(from.at("error_ulp"));
            from.at("refusals").get_to(row.refusals);
            from.at("figures").get_to(row.figures);
            rows.push_back(std::move(row));
        }
        return rows;
    } catch (const std::exception&) {  // of the parser, or of a list that is too short
        fault = "it is damaged";
        return std::nullopt;
    }
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
