// A scene with two of each solid under each operator and overlapping, rays at it, and what must be true of an answer.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include <csgrt/csgrt.hpp>

#include "integration/same_answers.hpp"
#include "integration/samples.hpp"
#include "stress/build.hpp"

namespace csgrt::every_solid {

using namespace csgrt::stress;

inline constexpr double away = 300;    // from where rays start to what they are shot at
inline constexpr double clear = 1e-4;  // what is shorter may be there or not when a ray's start is moved

struct Stretch {
    double in, out;
};
using Stretches = std::vector<Stretch>;

/// Where op(a, b) holds, with no ends in it.
inline Stretches where(const Stretches& a, const Stretches& b, const std::function<bool(bool, bool)>& op) {
    std::vector<double> ends;
    for (const Stretches* each : {&a, &b})
        for (const Stretch& s : *each) ends.insert(ends.end(), {s.in, s.out});
    std::sort(ends.begin(), ends.end());
    Stretches result;
    for (std::size_t i = 0; i + 1 < ends.size(); ++i) {
        const double middle = 0.5 * (ends[i] + ends[i + 1]);
        const auto within = [middle](const Stretch& s) { return s.in < middle && middle < s.out; };
        if (!(ends[i] < ends[i + 1])) continue;
        if (!op(std::any_of(a.begin(), a.end(), within), std::any_of(b.begin(), b.end(), within))) continue;
        if (!result.empty() && result.back().out == ends[i])
            result.back().out = ends[i + 1];
        else
            result.push_back({ends[i], ends[i + 1]});
    }
    return result;
}

/// Ends of both that are closer than `least` but not the same.
inline bool has_close_boundaries(const std::vector<double>& ends, double least) {
    for (std::size_t i = 0; i + 1 < ends.size(); ++i)
        if (ends[i] != ends[i + 1] && ends[i + 1] - ends[i] < least) return true;
    return false;
}

// ---- The scene: every sample at a place of its own for each way to put two of it together ----

struct Way {
    const char* name;
    Operator op;
    bool (*holds)(bool, bool);
};
inline const Way ways[] = {
    {"union", Operator::union_, [](bool a, bool b) { return a || b; }},
    {"intersection", Operator::intersection, [](bool a, bool b) { return a && b; }},
    {"difference", Operator::difference, [](bool a, bool b) { return a && !b; }},
    {"xor", Operator::xor_, [](bool a, bool b) { return a != b; }},
    {"not", Operator::not_, [](bool a, bool b) { return a && !b; }},  // intersected with the first
    {"overlap", Operator::leaf, nullptr},                             // two regions
};

/// The boxes of metaballs take long to compute.
inline bool is_spared(const std::string& sample, const Way& way) {
    return sample == "metaball" && way.op != Operator::difference;
}

/// All but one: the metaball of the other method takes three times as long as all others together.
inline std::vector<test::Sample> solids_to_test() {
    std::vector<test::Sample> all(std::begin(test::samples), std::end(test::samples));
    std::erase_if(all, [](const test::Sample& sample) { return sample.name == std::string("blob"); });
    return all;
}
inline const std::vector<test::Sample> tested = solids_to_test();

struct Spot {
    std::string first, second, region;  ///< `region`: of an operator; none of an overlap
    const Way* way;
    Vec3 at;
};

inline void add_combination(Scene& scene, const std::string& name, Tree tree, bool region) {
    Combination combination{.name = name, .tree = std::move(tree), .region = region};
    scene.objects.push_back(std::move(combination));
}

/// What stands for a sample where others are near: itself, or a half-space's part in a box.
inline std::string add_bounded(Scene& scene, const std::string& sample) {
    const std::string name = "bounded " + sample;
    Tree tree = leaf(sample);
    if (sample == "half") tree = operate(Operator::intersection, {tree, leaf("limits")});
    add_combination(scene, name, std::move(tree), false);
    return name;
}

inline std::string sample_of(const std::string& region) { return region.substr(region.rfind(' ') + 1); }

inline constexpr double pitch = 8;
inline Vec3 grid(std::size_t i) {
    return {pitch * static_cast<double>(i % 15) - 56, pitch * static_cast<double>(i / 15) - 56, 0};
}

/// The regions of all places, and below them a half-space, "floor". `first` and `second` are regions that are not
/// drawn.
struct EverySolid {
    Scene scene;
    std::vector<Spot> places;
    std::vector<Ray> rays;  ///< some at each place, in the order of the places

    explicit EverySolid(int rays_a_place) {
        Random random(5);
        scene = test::scene_of_samples();
        for (const test::Sample& sample : tested) {
            const std::string bounded = add_bounded(scene, sample.name);
            for (const Way& way : ways) {
                if (is_spared(sample.name, way)) continue;
                Spot place{"", "", "", &way, grid(places.size())};
                const std::string name = std::string(way.name) + " " + sample.name;
                const Matrix placed = translation(place.at) * rotation(random);
                const Matrix beside = placed * translation(0.3 * random.direction()) * rotation(8, 1, -1, 1);
                place.first = "first " + name, place.second = "second " + name;
                add_combination(scene, place.first, leaf(bounded, placed), true);
                add_combination(scene, place.second, leaf(bounded, beside), true);
                const Tree a = leaf(bounded, placed), b = leaf(bounded, beside);
                if (way.op == Operator::leaf) {
                    scene.top.insert(scene.top.end(), {place.first, place.second});
                } else {
                    place.region = name;
                    add_combination(scene, name,
                                    way.op == Operator::not_
                                        ? operate(Operator::intersection, {a, operate(Operator::not_, {b})})
                                        : operate(way.op, {a, b}),
                                    true);
                    scene.top.push_back(name);
                }
                for (int i = 0; i < rays_a_place; ++i) {
                    const Vec3 d = random.between(0.5, 2) * random.direction();
                    rays.push_back({place.at + 0.6 * random.in_cube() - (away / std::sqrt(dot(d, d))) * d, d});
                }
                places.push_back(std::move(place));
            }
        }
        scene.objects.push_back(Solid{"floor", Half{{{0, 0, 1}, -100}}, {}});
        scene.top.push_back("floor");
    }
    std::vector<std::string> all(std::string Spot::*operand) const {
        std::vector<std::string> names;
        for (const Spot& place : places) names.push_back(place.*operand);
        return names;
    }
};

inline Settings on_reference() { return {.reference = true}; }

/// The reference, and the device that has its bits.
class Both {
public:
    explicit Both(const Scene& scene, Settings settings = {})
        : reference_(scene, {}, as_reference(settings)), device_(scene, {}, as_device(settings)) {}

    std::vector<RayPartitions> shoot(const std::vector<Ray>& rays) {
        std::vector<RayPartitions> answers = reference_.shoot(rays);
        test::require_same(device_.shoot(rays), answers);
        return answers;
    }
    Image render(const View& view) {
        Image image = reference_.render(view);
        test::require_same(device_.render(view), image);
        return image;
    }
    Renderer& reference() { return reference_; }
    Renderer& device() { return device_; }
    /// The region's name, without a slash.
    std::string region(std::uint32_t index) const { return reference_.model().regions()[index].path.substr(1); }
    std::string solid(std::uint32_t index) const { return reference_.model().solids()[index].name; }

private:
    static Settings as_reference(Settings settings) {
        settings.reference = true;
        return settings;
    }
    static Settings as_device(Settings settings) {
        const Settings device = test::on_device();
        settings.device = device.device;
        settings.wait_for_device = device.wait_for_device;
        return settings;
    }
    Renderer reference_, device_;
};

inline std::vector<double> boundaries_of(const RayPartitions& answer) {
    std::vector<double> ends;
    for (const Partition& p : answer.partitions) ends.insert(ends.end(), {p.in, p.out});
    for (const Overlap& o : answer.overlaps) ends.insert(ends.end(), {o.in, o.out});
    std::sort(ends.begin(), ends.end());
    return ends;
}

/// What is wrong with an answer by itself; empty: nothing.
inline std::string fault_of(const RayPartitions& answer, const Ray& ray, const Both& both) {
    std::string wrong;
    const Vec3& d = ray.direction;
    const auto normal = [&](double t, const Vec3& n, double way) {
        if (!std::isfinite(t)) return;
        if (std::abs(dot(n, n) - 1) > 1e-12) wrong += "a normal is no unit vector; ";
        if (way * dot(n, d) < -1e-6 * std::sqrt(dot(d, d))) wrong += "a normal points the other way; ";
    };
    const auto solid = [&](std::uint32_t index, const std::string& region) {
        const std::string name = sample_of(both.solid(index));
        if ((name == "limits" ? "half" : name) != sample_of(region)) wrong += "a foreign solid; ";
    };
    const Partition* before = nullptr;
    for (const Partition& p : answer.partitions) {
        if (!(p.in < p.out)) wrong += "a partition without length; ";
        if (p.out < 0) wrong += "a partition behind the start; ";
        if (before && !(before->out <= p.in)) wrong += "partitions overlap, or are not in order; ";
        if (before && before->out == p.in && before->region == p.region) wrong += "neighbours are not joined; ";
        normal(p.in, p.in_normal, -1);
        normal(p.out, p.out_normal, 1);
        const std::string region = both.region(p.region);
        if (std::isfinite(p.in)) solid(p.in_solid, region);
        if (std::isfinite(p.out)) solid(p.out_solid, region);
        before = &p;
    }
    for (std::size_t i = 0; i < answer.overlaps.size(); ++i) {
        const Overlap& o = answer.overlaps[i];
        if (!(o.in < o.out) || o.out < 0) wrong += "an overlap without length, or behind the start; ";
        if (i > 0 && !(answer.overlaps[i - 1].out <= o.in)) wrong += "overlaps are not in order; ";
        if (o.regions.size() < 2 || !std::is_sorted(o.regions.begin(), o.regions.end()))
            wrong += "an overlap's regions are not in order; ";
        const auto owner = std::find_if(answer.partitions.begin(), answer.partitions.end(),
                                        [&](const Partition& p) { return p.in <= o.in && o.out <= p.out; });
        if (owner == answer.partitions.end() || owner->region != o.regions.front())
            wrong += "an overlap is not in a partition of its first region; ";
    }
    return wrong;
}

inline std::string said(const Ray& ray) {
    char text[200];
    const Vec3 &o = ray.origin, &d = ray.direction;
    std::snprintf(text, sizeof text, "%.17g %.17g %.17g  %.17g %.17g %.17g", o.x, o.y, o.z, d.x, d.y, d.z);
    return text;
}

/// What one answer lacks of the other, ends and normals to `clear`; empty: they say the same.
inline std::string difference_of(const RayPartitions& a, const RayPartitions& b) {
    const auto far = [](double x, double y) { return x != y && !(std::abs(x - y) < 1e-2 * clear); };
    const auto turned = [](const Vec3& x, const Vec3& y) { return dot(x - y, x - y) > clear; };
    if (a.partitions.size() != b.partitions.size()) return "other partitions";
    for (std::size_t k = 0; k < a.partitions.size(); ++k) {
        const Partition &p = a.partitions[k], &q = b.partitions[k];
        if (p.region != q.region) return "another region";
        if (far(p.in, q.in) || far(p.out, q.out)) return "another distance";
        if (std::isfinite(p.in) && turned(p.in_normal, q.in_normal)) return "another normal of an entry";
        if (std::isfinite(p.out) && turned(p.out_normal, q.out_normal)) return "another normal of an exit";
    }
    if (a.overlaps.size() != b.overlaps.size()) return "other overlaps";
    for (std::size_t k = 0; k < a.overlaps.size(); ++k) {
        const Overlap &p = a.overlaps[k], &q = b.overlaps[k];
        if (p.regions != q.regions || far(p.in, q.in) || far(p.out, q.out)) return "another overlap";
    }
    return {};
}

/// The first faults, and how many there are.
struct Faults {
    std::size_t count = 0;
    std::string first;
    void add(const std::string& what, const std::string& where) {
        if (what.empty()) return;
        if (count++ < 5) first += where + ": " + what + "\n";
    }
};
#define REQUIRE_NONE(faults)                            \
    do {                                                \
        INFO((faults).count << "\n" << (faults).first); \
        REQUIRE((faults).count == 0);                   \
    } while (false)

template <class Stretched>
Stretched shifted(Stretched stretch, double by) {
    stretch.in -= by;
    stretch.out -= by;
    return stretch;
}

}  // namespace csgrt::every_solid
