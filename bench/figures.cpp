#include "figures.hpp"

#include <algorithm>
#include <fstream>

#include <nlohmann/json.hpp>

namespace csgrt::bench {

using Json = nlohmann::ordered_json;

double median(std::vector<double> values) {
    if (values.empty()) return 0;
    std::sort(values.begin(), values.end());
    const std::size_t n = values.size();
    return n % 2 ? values[n / 2] : 0.5 * (values[n / 2 - 1] + values[n / 2]);
}

double Figures::time(const std::string& name) const {
    for (const auto& [stage, value] : ms)
        if (stage == name) return value;
    return -1;
}

namespace {

/// Calls field(place in an element of the file, member) for all but the times.
template <class AnyFigures, class Field>
void for_fields(AnyFigures& f, const Field& field) {
    field("/workload", f.workload);
    field("/device", f.device);
    field("/mode", f.mode);
    field("/size", f.size);
    field("/frames", f.frames);
    field("/orbit", f.orbit);
    field("/solids", f.solids);
    field("/regions", f.regions);
    field("/segments", f.segments);
    field("/partitions/used", f.partitions_used);
    field("/partitions/allocated", f.partitions_allocated);
    field("/segment_and_partition_bytes", f.segment_and_partition_bytes);
    field("/device_bytes", f.device_bytes);
}

}  // namespace

void save(const std::vector<Figures>& all, const std::string& path) {
    Json list = Json::array();
    for (const Figures& f : all) {
        Json entry;
        for_fields(f, [&](const char* at, const auto& value) { entry[Json::json_pointer(at)] = value; });
        entry["ms"] = Json::object();
        for (const auto& [name, value] : f.ms) entry["ms"][name] = value;
        list.push_back(std::move(entry));
    }
    std::ofstream out(path);
    out << list.dump(1) << "\n";
    if (!out.flush()) throw Error(Status::file, path + ": cannot be written");
}

std::vector<Figures> load(const std::string& path) {
    std::ifstream in(path);
    if (!in) throw Error(Status::file, path + ": cannot be read");
    std::vector<Figures> all;
    try {
        for (const Json& entry : Json::parse(in)) {
            Figures& f = all.emplace_back();
            for_fields(f, [&](const char* at, auto& value) { entry.at(Json::json_pointer(at)).get_to(value); });
            for (const auto& [name, value] : entry.at("ms").items()) f.ms.emplace_back(name, value);
        }
    } catch (const Json::exception& error) {
        throw Error(Status::file, path + ": is no file of this benchmark: " + error.what());
    }
    return all;
}

}  // namespace csgrt::bench
