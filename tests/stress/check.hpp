// One stress scene through the reference: against the truth, and against itself in other words.
#pragma once

#include <array>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

#include <csgrt/csgrt.hpp>

#include "stress/metamorphic.hpp"

namespace csgrt::test {

/// Of a scene, or summed over a family's. Wrong answers are counted on decided rays.
struct Counts {
    std::size_t scenes = 0, rays = 0, ties = 0;
    std::size_t wrong = 0;     ///< another sequence of regions than the truth's, gaps included
    std::size_t overlaps = 0;  ///< right regions, but other overlaps
    std::size_t far = 0;       ///< right regions, but an end farther off than the documented accuracy
    double worst = 0;          ///< an end's distance from the truth, in units of the documented accuracy
    std::array<std::size_t, changes.size()> disagreements{};

    void operator+=(const Counts& other) {
        scenes += other.scenes;
        rays += other.rays;
        ties += other.ties;
        wrong += other.wrong;
        overlaps += other.overlaps;
        far += other.far;
        worst = std::max(worst, other.worst);
        for (std::size_t i = 0; i < changes.size(); ++i) disagreements[i] += other.disagreements[i];
    }
};

inline Settings on_reference() {
    Settings settings;
    settings.reference = true;
    settings.threads = 1;
    return settings;
}

/// Writes a scene and the first of its rays that went wrong into the folder CSGRT_STRESS_FINDINGS, if that is given:
/// csgrt shoot NAME.json --rays NAME.rays
inline void keep_finding(const std::string& what, const stress::StressScene& made, const Scene& scene, const Ray& ray) {
    const char* folder = std::getenv("CSGRT_STRESS_FINDINGS");
    if (folder == nullptr) return;
    std::filesystem::create_directories(folder);
    const std::string name = std::string(folder) + "/" + made.family + "-" + what + "-" + std::to_string(made.seed);
    save_scene(scene, name + ".json");
    std::FILE* file = std::fopen((name + ".rays").c_str(), "w");
    if (file == nullptr) return;
    std::fprintf(file, "%.17g %.17g %.17g %.17g %.17g %.17g\n", ray.origin.x, ray.origin.y, ray.origin.z,
                 ray.direction.x, ray.direction.y, ray.direction.z);
    std::fclose(file);
}

/// What every ray must meet, and whether that is decided.
struct Expected {
    std::vector<Sequence> sequences;
    std::vector<std::vector<std::vector<std::uint32_t>>> overlaps;  ///< empty: not known
    std::vector<bool> ties;
};

inline Expected expected_of(const stress::StressScene& made) {
    Expected expected;
    if (!made.known.empty()) {
        for (std::size_t i = 0; i < made.rays.size(); ++i)
            expected.sequences.push_back(sequence_of(made.known[i], made.rays[i]));
        expected.ties.assign(made.rays.size(), false);
        return expected;
    }
    const TrueScene truth(made.scene, made.objects);
    for (const Ray& ray : made.rays) {
        const Truth one = truth.shoot(ray);
        bool tie = one.tie;
        expected.sequences.push_back(sequence_of(one, tie));
        expected.overlaps.push_back(overlaps_of(one));
        expected.ties.push_back(tie);
    }
    return expected;
}

/// The regions of a renderer in the order of `objects`: a region without solids has none.
inline void renumber(std::vector<RayPartitions>& answers, const Renderer& renderer,
                     const std::vector<std::string>& objects) {
    std::vector<std::uint32_t> number;
    for (const RegionInfo& region : renderer.regions()) {
        const std::string name = region.path.substr(region.path.rfind('/') + 1);
        number.push_back(static_cast<std::uint32_t>(std::find(objects.begin(), objects.end(), name) - objects.begin()));
    }
    for (RayPartitions& answer : answers) {
        for (Partition& p : answer.partitions) p.region = number[p.region];
        for (Overlap& o : answer.overlaps)
            for (std::uint32_t& r : o.regions) r = number[r];
    }
}

inline std::vector<RayPartitions> shoot(const Scene& scene, const std::vector<std::string>& objects,
                                        const std::vector<std::string>& regions, const std::vector<Ray>& rays,
                                        const Settings& settings, double& size) {
    Renderer renderer(scene, objects, settings);
    const Box& b = renderer.bounds();
    size = std::hypot(b.high.x - b.low.x, b.high.y - b.low.y, b.high.z - b.low.z);
    std::vector<RayPartitions> found = renderer.shoot(rays);
    renumber(found, renderer, regions);
    return found;
}

inline Counts check(const stress::StressScene& made, const Settings& settings) {
    Counts counts;
    counts.scenes = 1;
    counts.rays = made.rays.size();
    const Expected expected = expected_of(made);
    double size = 0;
    const std::vector<RayPartitions> found = shoot(made.scene, made.objects, made.objects, made.rays, settings, size);
    std::vector<Sequence> base;
    std::vector<bool> right;
    for (std::size_t i = 0; i < found.size(); ++i) {
        base.push_back(sequence_of(found[i]));
        right.push_back(same_regions(base[i], expected.sequences[i]));
        if (expected.ties[i]) {
            ++counts.ties;
            continue;
        }
        if (!right[i]) {
            if (counts.wrong++ == 0) keep_finding("wrong", made, made.scene, made.rays[i]);
            continue;
        }
        if (!expected.overlaps.empty() && overlaps_of(found[i]) != expected.overlaps[i])
            if (counts.overlaps++ == 0) keep_finding("overlaps", made, made.scene, made.rays[i]);
        const double off = worst_end(base[i], expected.sequences[i], 0);
        counts.worst = std::max(counts.worst, off);
        if (off > 1 && counts.far++ == 0) keep_finding("far", made, made.scene, made.rays[i]);
    }
    for (std::size_t c = 0; c < changes.size(); ++c) {
        const Changed other = changed(made, c, size, base);
        double other_size = 0;
        const std::vector<RayPartitions> again =
            shoot(other.scene, other.objects, made.objects, other.rays, settings, other_size);
        for (std::size_t i = 0; i < again.size(); ++i) {
            if (expected.ties[i]) continue;
            Sequence sequence = sequence_of(again[i]);
            if (!other.way.empty()) sequence = turned_around(sequence, other.way[i]);
            bool agrees = same_regions(sequence, base[i]);
            if (agrees && changes[c].to_the_bit) agrees = worst_end(sequence, base[i], 0) == 0;
            if (!agrees && counts.disagreements[c]++ == 0)
                keep_finding(std::string("change") + std::to_string(c), made, other.scene, other.rays[i]);
        }
    }
    return counts;
}

}  // namespace csgrt::test
