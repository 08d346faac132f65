// Conversions of records from double into the precision of the namespace CSGRT_KERNELS, for the file that includes this
// header: a converter, or the reference in this precision.
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <span>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include <csgrt/error.hpp>

#include "compile/compiled_scene.hpp"

namespace csgrt {
namespace {

namespace k = CSGRT_KERNELS;
using k::real;
using k::wide;

/// A table that is the same in both precisions is not copied.
template <class To, class From>
using Converted = std::conditional_t<std::is_same_v<To, From>, std::span<const From>, std::vector<To>>;

/// Converts a record: a record begins with `numbers` numbers of type `wide`, and the rest is the same in all
/// precisions.
template <class To, std::size_t numbers, class From>
To converted(const From& record) {
    constexpr std::size_t own = numbers * sizeof(wide), other = numbers * sizeof(double);
    constexpr std::size_t rest = std::min(sizeof(To) - own, sizeof(From) - other);
    static_assert(sizeof(To) - own - rest < alignof(To) && sizeof(From) - other - rest < alignof(From));  // padding
    std::array<double, numbers> from;
    std::array<wide, numbers> to;
    std::memcpy(from.data(), &record, other);
    std::transform(from.begin(), from.end(), to.begin(), [](double x) { return static_cast<wide>(x); });
    To result{};
    std::memcpy(&result, to.data(), own);
    std::memcpy(reinterpret_cast<std::byte*>(&result) + own, reinterpret_cast<const std::byte*>(&record) + other, rest);
    return result;
}

real convert(double x) { return static_cast<real>(x); }
[[maybe_unused]] k::PlaneRecord convert(const kernel::PlaneRecord& p) { return converted<k::PlaneRecord, 4>(p); }
[[maybe_unused]] k::LightRecord convert(const kernel::LightRecord& l) { return converted<k::LightRecord, 8>(l); }

// Boxes are larger in single precision, where a ray may meet a solid a little beside the solid's position. With larger
// boxes a device finds everything that the reference finds.
[[maybe_unused]] k::BvhNode convert_node(const kernel::BvhNode& n) {
    k::BvhNode node = std::bit_cast<k::BvhNode>(n);
    double diagonal = 0;
    for (int i = 0; i < 3; ++i) diagonal += double(n.high[i] - n.low[i]) * double(n.high[i] - n.low[i]);
    const bool single = sizeof(real) == sizeof(float);
    const auto pad = static_cast<float>(single ? 0x1p-10 * std::sqrt(diagonal) : 0);
    for (int i = 0; i < 3; ++i) {
        node.low[i] -= pad;
        node.high[i] += pad;
    }
    return node;
}

[[maybe_unused]] k::SolidRecord convert_solid(const kernel::SolidRecord& s, const CompiledScene& scene) {
    k::SolidRecord solid{};
    static_assert(offsetof(k::SolidRecord, alone) == offsetof(kernel::SolidRecord, alone));
    std::memcpy(&solid, &s, sizeof s);  // the center comes after these members
#ifdef CSGRT_EYE_RELATIVE
    if (s.type != SOLID_ARB && s.type != SOLID_HALF)  // the reals of all other types begin with their center
        for (std::size_t i = 0; i < 3; ++i) solid.center[i] = scene.reals[s.first_real + i];
#endif
    (void)scene;
    return solid;
}

template <class To, class From, class Convert>
Converted<To, From> convert_all(const std::vector<From>& from, const Convert& one) {
    if constexpr (std::is_same_v<To, From>) {
        return from;
    } else {
        std::vector<To> to;
        to.reserve(from.size());
        for (const From& x : from) to.push_back(one(x));
        return to;
    }
}

Converted<k::LightRecord, kernel::LightRecord> lights_of(const std::vector<kernel::LightRecord>& lights) {
    return convert_all<k::LightRecord>(lights, [](const auto& l) { return convert(l); });
}

k::RayRecord convert(const kernel::RayRecord& r) {
    return {static_cast<wide>(r.ox), static_cast<wide>(r.oy), static_cast<wide>(r.oz),     static_cast<wide>(r.dx),
            static_cast<wide>(r.dy), static_cast<wide>(r.dz), static_cast<wide>(r.t_near), static_cast<wide>(r.t_far)};
}

[[maybe_unused]] std::vector<kernel::Boundary> boundaries_of(std::vector<kernel::Boundary>&& boundaries) {
    return std::move(boundaries);
}
template <class Boundary>
std::vector<kernel::Boundary> boundaries_of(std::vector<Boundary>&& boundaries) {
    std::vector<kernel::Boundary> result;
    result.reserve(boundaries.size());
    for (const Boundary& e : boundaries) result.push_back({static_cast<double>(e.t), e.solid, e.surface});
    return result;
}

/// Throws Error (usage) for a ray whose numbers do not fit the precision. `first`: the index of the first ray.
inline void check_rays(std::span<const kernel::RayRecord> rays, std::uint64_t first) {
    if (sizeof(wide) > sizeof(float)) return;
    for (std::size_t i = 0; i < rays.size(); ++i) {
        const k::RayRecord r = convert(rays[i]);
        const wide sum = r.ox + r.oy + r.oz;
        const wide size2 = r.dx * r.dx + r.dy * r.dy + r.dz * r.dz;
        if (sum - sum == 0 && size2 > wide(1e-30) && size2 < wide(1e30)) continue;
        throw Error(Status::usage, "ray " + std::to_string(first + i) +
                                       ": single precision in world coordinates needs a direction whose length is "
                                       "between 1e-15 and 1e15, and an origin below 1e38");
    }
}

[[maybe_unused]] const kernel::Frame& convert_frame(const kernel::Frame& f, const kernel::Frame*) { return f; }
template <class Frame>
Frame convert_frame(const kernel::Frame& f, const Frame*) {
    static_assert(offsetof(Frame, word_capacity) - offsetof(Frame, background) ==
                  offsetof(kernel::Frame, word_capacity) - offsetof(kernel::Frame, background));
    return converted<Frame, offsetof(kernel::Frame, background) / sizeof(double)>(f);
}
decltype(auto) convert_frame(const kernel::Frame& f) { return convert_frame(f, static_cast<const k::Frame*>(nullptr)); }

/// The scene's tables that depend on the precision.
struct Records {
    explicit Records(const CompiledScene& scene)
        : solids(
              convert_all<k::SolidRecord>(scene.solids.get(), [&](const auto& s) { return convert_solid(s, scene); })),
          reals(convert_all<real>(scene.reals.get(), [](double x) { return convert(x); })),
          planes(convert_all<k::PlaneRecord>(scene.planes.get(), [](const auto& p) { return convert(p); })),
          inner_nodes(convert_all<k::BvhNode>(scene.inner_nodes.get(), [](const auto& n) { return convert_node(n); })),
          nodes(convert_all<k::BvhNode>(scene.nodes.get(), [](const auto& n) { return convert_node(n); })) {}

    const Converted<k::SolidRecord, kernel::SolidRecord> solids;
    const Converted<real, double> reals;
    const Converted<k::PlaneRecord, kernel::PlaneRecord> planes;
    const Converted<k::BvhNode, kernel::BvhNode> inner_nodes, nodes;
};

}  // namespace
}  // namespace csgrt
