#include "tally.hpp"

#include <algorithm>

#include <csgrt/csgrt.hpp>
#include <nlohmann/json.hpp>

namespace csgrt::campaign {
namespace {

using Json = nlohmann::ordered_json;

double per_ray(double seconds, const Sums& s) { return s.rays ? 1e6 * seconds / static_cast<double>(s.rays) : 0; }

Json json_of(const Sums& s) {
    return {{"items", s.items},
            {"planned", s.planned},
            {"rays", s.rays},
            {"hits", s.hits},
            {"decided", s.decided},
            {"ties", s.ties},
            {"wrong", s.wrong},
            {"worst", s.worst},
            {"compared_with_reference", s.compared},
            {"bit_differences", s.bit_differences},
            {"seconds", {{"build", s.build}, {"shoot", s.shoot}, {"judge", s.judge}}},
            {"us_a_ray", {{"shoot", per_ray(s.shoot, s)}, {"judge", per_ray(s.judge, s)}}}};
}

Json json_of(const std::map<std::string, Sums>& all) {
    Json json = Json::object();
    for (const auto& [name, sums] : all) json[name] = json_of(sums);
    return json;
}

}  // namespace

void Sums::operator+=(const Sums& other) {
    items += other.items;
    planned += other.planned;
    rays += other.rays;
    decided += other.decided;
    ties += other.ties;
    hits += other.hits;
    wrong += other.wrong;
    compared += other.compared;
    bit_differences += other.bit_differences;
    worst = std::max(worst, other.worst);
    build += other.build;
    shoot += other.shoot;
    judge += other.judge;
}

Tally::Tally(const std::string& wrong_rays) : wrong_rays_(std::fopen(wrong_rays.c_str(), "w")) {
    if (wrong_rays_ == nullptr) throw Error(Status::file, wrong_rays + ": cannot be written");
}
Tally::~Tally() { std::fclose(wrong_rays_); }

void Tally::add(const Item& item, const Sums& sums) {
    const std::lock_guard lock(mutex_);
    families_[item.family] += sums;
    if (!item.path.empty()) files_[item.name] += sums;
}

void Tally::add_wrong(const Item& item, const Ray& ray, const std::string& what) {
    const auto list = [](const Vec3& v) { return Json{v.x, v.y, v.z}; };
    const Json json = {{"scene", item.name},
                       {"seed", item.seed},
                       {"origin", list(ray.origin)},
                       {"direction", list(ray.direction)},
                       {"what", what}};
    const std::lock_guard lock(mutex_);
    std::fprintf(wrong_rays_, "%s\n", json.dump().c_str());
    std::fflush(wrong_rays_);  // found is found, however the campaign ends
}

void Tally::add_error(const Item& item, const std::string& what) {
    const std::lock_guard lock(mutex_);
    errors_.push_back(item.name + ": " + what);
    std::fprintf(stderr, "%s\n", errors_.back().c_str());
}

Sums Tally::total() const {
    const std::lock_guard lock(mutex_);
    Sums total;
    for (const auto& [name, sums] : families_) total += sums;
    return total;
}

bool Tally::passed() const {
    const Sums sums = total();
    return sums.decided > 0 && sums.wrong == 0 && sums.bit_differences == 0 && errors_.empty();
}

std::string Tally::table() const {
    std::string text;
    char line[200];
    std::snprintf(line, sizeof line, "%-12s %6s %11s %11s %9s %6s %9s %6s %9s %9s\n", "family", "items", "rays",
                  "decided", "ties", "wrong", "worst", "bits", "us shoot", "us judge");
    text += line;
    const auto add = [&](const std::string& name, const Sums& s) {
        std::snprintf(line, sizeof line, "%-12s %6llu %11llu %11llu %9llu %6llu %9.3g %6llu %9.1f %9.1f\n",
                      name.c_str(), static_cast<unsigned long long>(s.items), static_cast<unsigned long long>(s.rays),
                      static_cast<unsigned long long>(s.decided), static_cast<unsigned long long>(s.ties),
                      static_cast<unsigned long long>(s.wrong), s.worst,
                      static_cast<unsigned long long>(s.bit_differences), per_ray(s.shoot, s), per_ray(s.judge, s));
        text += line;
    };
    for (const auto& [name, sums] : families_) add(name, sums);
    add("all", total());
    return text;
}

std::string Tally::to_json(const std::string& device, unsigned threads, double seconds) const {
    const Json json = {{"device", device},         {"csgrt", version()},        {"threads", threads},
                       {"seconds", seconds},       {"total", json_of(total())}, {"families", json_of(families_)},
                       {"files", json_of(files_)}, {"errors", errors_}};
    return json.dump(1) + "\n";
}

}  // namespace csgrt::campaign
