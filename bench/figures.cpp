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

void save(const std::vector<Figures>& all, const std::string& path) {
    Json list = Json::array();
    for (const Figures& f : all) {
        Json ms = Json::object();
        for (const auto& [name, value] : f.ms) ms[name] = value;
        list.push_back({{"workload", f.workload},
                        {"device", f.device},
                        {"mode", f.mode},
                        {"size", f.size},
                        {"frames", f.frames},
                        {"orbit", f.orbit},
                        {"solids", f.solids},
                        {"regions", f.regions},
                        {"segments", f.segments},
                        {"partitions", {{"used", f.partitions_used}, {"allocated", f.partitions_allocated}}},
                        {"segment_and_partition_bytes", f.segment_and_partition_bytes},
                        {"device_bytes", f.device_bytes},
                        {"ms", ms}});
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
            Figures f;
            f.workload = entry.at("workload");
            f.device = entry.at("device");
            f.mode = entry.at("mode");
            f.size = entry.at("size");
            f.frames = entry.at("frames");
            f.orbit = entry.at("orbit");
            f.solids = entry.at("solids");
            f.regions = entry.at("regions");
            f.segments = entry.at("segments");
            f.partitions_used = entry.at("partitions").at("used");
            f.partitions_allocated = entry.at("partitions").at("allocated");
            f.segment_and_partition_bytes = entry.at("segment_and_partition_bytes");
            f.device_bytes = entry.at("device_bytes");
            for (const auto& [name, value] : entry.at("ms").items()) f.ms.emplace_back(name, value);
            all.push_back(std::move(f));
        }
    } catch (const Json::exception& error) {
        throw Error(Status::file, path + ": is no file of this benchmark: " + error.what());
    }
    return all;
}

}  // namespace csgrt::bench
