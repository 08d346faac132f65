#include "scene/instances.hpp"

#include <algorithm>
#include <cstdio>
#include <string_view>
#include <unordered_set>

namespace csgrt {

namespace {

/// The cost of one instance of a solid, measured in balls: a ball takes 6 microseconds and 1.6 kB.
struct Cost {
    std::uint64_t parts = 0;  ///< the part that grows with the size of the file
    std::uint64_t more = 0;   ///< the part that grows faster than the file
};

/// The cost of a solid by its type, as a visitor of Shape.
struct CostOf {
    static constexpr std::uint64_t many = 64;  ///< number of triangles or cells that cost as much as a ball

    Cost operator()(const Hrt&) const { return {150}; }
    Cost operator()(const Arbn& s) const { return {2 * s.planes.size(), s.planes.size() * s.planes.size() / 1300}; }
    Cost operator()(const Metaball& s) const {
        if (s.method == Metaball::Method::isopotential) return {s.points.size(), 1000 + 60 * s.points.size()};
        return {8 + (s.method == Metaball::Method::blob ? 8 : 1) * s.points.size()};
    }
    Cost operator()(const Pipe& s) const { return {8 * s.points.size()}; }
    Cost operator()(const Extrude& s) const { return {8 + s.sketch.curves.size()}; }
    Cost operator()(const Revolve& s) const { return {8 + s.sketch.curves.size()}; }
    Cost operator()(const Bot& s) const { return {s.faces.size() / many}; }
    Cost operator()(const Ars& s) const {
        return {s.curves.empty() ? 0 : s.curves.size() * s.curves.front().size() / many};
    }
    Cost operator()(const Nmg& s) const { return {s.vertices.size() / many}; }
    Cost operator()(const Ebm& s) const { return {8 + s.cells.size() / many}; }
    Cost operator()(const Vol& s) const {  // cost by the cells' sides; changes along rows show a third of all sides
        const auto is_solid = [&](std::uint8_t cell) { return cell >= s.low && cell <= s.high; };
        std::uint64_t changes = 0;
        for (std::size_t i = 1; i < s.cells.size(); ++i) changes += is_solid(s.cells[i]) != is_solid(s.cells[i - 1]);
        return {s.cells.size() / many, 3 * changes / 4};
    }
    Cost operator()(const Dsp& s) const { return {s.heights.size() / 2}; }
    template <class Other>
    Cost operator()(const Other&) const {
        return {1};
    }
};

/// The sketch's name or the cells of a solid, which tell whether several solids have copies of one source.
std::string_view source_of(const Shape& shape) {
    const auto bytes_of = [](const auto& cells) {
        return std::string_view(reinterpret_cast<const char*>(cells.data()), cells.size() * sizeof cells[0]);
    };
    if (const auto* s = std::get_if<Extrude>(&shape)) return s->sketch.name;
    if (const auto* s = std::get_if<Revolve>(&shape)) return s->sketch.name;
    if (const auto* s = std::get_if<Ebm>(&shape)) return bytes_of(s->cells);
    if (const auto* s = std::get_if<Vol>(&shape)) return bytes_of(s->cells);
    if (const auto* s = std::get_if<Dsp>(&shape)) return bytes_of(s->heights);
    return {};
}

}  // namespace

std::uint64_t instances_of(const Solid& solid) {
    constexpr std::uint64_t name_bytes = 1024;
    const Cost cost = std::visit(CostOf(), solid.shape);
    return std::max<std::uint64_t>(1, cost.parts + cost.more) + solid.name.size() / name_bytes;
}

InstanceLimit::InstanceLimit(const Scene& scene, std::uint64_t max_instances)
    : scene_(scene),
      allowed_(max_instances > 0 ? std::min(max_instances, Limits::most_instances) : Limits::instances),
      counts_own_(max_instances == 0) {}

// A scene's own solids, each counted once, are always allowed, because their cost grows only with the file.
bool InstanceLimit::allows(double count) {
    if (counts_own_ && count > static_cast<double>(allowed_)) {
        counts_own_ = false;
        std::uint64_t own = 0;
        std::unordered_set<std::string_view> sources;
        for (const Object& object : scene_.objects) {
            const auto* solid = std::get_if<Solid>(&object);
            if (solid == nullptr) continue;
            const std::string_view source = source_of(solid->shape);
            const bool again = !source.empty() && !sources.insert(source).second;
            own += again ? 1 : std::max<std::uint64_t>(1, std::visit(CostOf(), solid->shape).parts);
        }
        allowed_ = std::max(allowed_, 2 * own);
    }
    return count <= static_cast<double>(allowed_);
}

Diagnostic InstanceLimit::fault(const Place& place, const std::string& what, double count) const {
    char number[32];
    std::snprintf(number, sizeof number, "%.0f", count);
    Diagnostic found{place,
                     what + " expands to " + (count > 1e18 ? "more than 10^18" : number) + " instances; at most " +
                         std::to_string(allowed_) + " are allowed",
                     "render fewer objects, or use fewer copies",
                     {}};
    if (count <= static_cast<double>(Limits::most_instances))
        found.suggestion += ", or allow more with --max-instances (Settings::max_instances)";
    return found;
}

}  // namespace csgrt
