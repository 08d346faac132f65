#include "rays.hpp"

#include "scene/range.hpp"
#include "cli/values.hpp"

namespace csgrt::cli {

RayReader::RayReader(const std::string& path) : lines_(path, LineReader::Passes::several) {
    std::string_view line;
    Ray ray;
    while (lines_.next(line))
        if (parse(line, ray)) ++count_;
    if (!findings_.empty()) throw Error(Status::file, findings_.take());
    lines_.rewind();
}

bool RayReader::next(std::vector<Ray>& rays, std::size_t limit) {
    rays.clear();
    std::string_view line;
    Ray ray;
    while (rays.size() < limit && lines_.next(line))
        if (parse(line, ray)) rays.push_back(ray);
    return !rays.empty();
}

/// False for a line without a ray: a blank line, a comment, or a wrong line, which becomes a finding.
bool RayReader::parse(std::string_view line, Ray& ray) {
    split(line.substr(0, line.find('#')), words_);
    if (words_.empty()) return false;
    double* numbers[] = {&ray.origin.x,    &ray.origin.y,    &ray.origin.z,
                         &ray.direction.x, &ray.direction.y, &ray.direction.z};
    constexpr const char* names[] = {"ox", "oy", "oz", "dx", "dy", "dz"};
    constexpr const char* form = "a ray is six numbers: ox oy oz dx dy dz";
    for (std::size_t i = 0; i < std::size(numbers); ++i) {
        if (i == words_.size()) {
            int end = words_.back().column + static_cast<int>(words_.back().text.size());
            findings_.add(lines_.finding(end, std::string(names[i]) + " is missing", form));
            return false;
        }
        auto number = parse_number(words_[i].text);
        if (!number) {
            findings_.add(
                lines_.finding(words_[i].column, std::string(names[i]) + ": " + number_fault(words_[i].text), form));
            return false;
        }
        *numbers[i] = *number;
    }
    if (words_.size() > std::size(numbers)) {
        findings_.add(lines_.finding(words_[std::size(numbers)].column, "more than six numbers", form));
        return false;
    }
    if (ray.direction == Vec3{}) {
        findings_.add(lines_.finding(words_[3].column, "the direction is 0 0 0", "a ray needs a direction"));
        return false;
    }
    bool in_direction = false;
    if (const std::string fault = ray_fault(ray.origin, ray.direction, in_direction); !fault.empty()) {
        findings_.add(lines_.finding(words_[in_direction ? 3 : 0].column, fault, form));
        return false;
    }
    return true;
}

}  // namespace csgrt::cli
