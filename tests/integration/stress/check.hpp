// One stress scene through the reference: against the truth, and against itself in other words.
#pragma once

#include <array>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

#include <csgrt/csgrt.hpp>

#include "integration/stress/expected.hpp"
#include "integration/stress/metamorphic.hpp"

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

inline Settings on_reference() { return {.reference = true, .threads = 1}; }

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

inline std::vector<Expected> expected_of(const stress::StressScene& made) {
    const ExpectedAnswers answers(made);
    std::vector<Expected> all;
    for (std::size_t i = 0; i < made.rays.size(); ++i) all.push_back(answers(i));
    return all;
}

struct Shot {
    std::vector<RayPartitions> found;
    double size = 0, fused = 0;  ///< of the scene; ends closer than that are one
};
inline Shot shoot(const Scene& scene, const std::vector<std::string>& objects, const std::vector<std::string>& regions,
                  const std::vector<Ray>& rays, const Settings& settings) {
    Renderer renderer(scene, objects, settings);
    const Box& b = renderer.model().bounds();
    const double size = std::hypot(b.high.x - b.low.x, b.high.y - b.low.y, b.high.z - b.low.z);
    Shot shot{renderer.shoot(rays), size, renderer.statistics().tolerance};
    const Renumbering renumbering(renderer, regions);
    for (RayPartitions& answer : shot.found) renumbering.apply(answer);
    return shot;
}

inline Counts check(const stress::StressScene& made, const Settings& settings) {
    Counts counts;
    counts.scenes = 1;
    counts.rays = made.rays.size();
    const std::vector<Expected> expected = expected_of(made);
    const auto [found, size, fused] = shoot(made.scene, made.objects, made.objects, made.rays, settings);
    std::vector<Sequence> base;
    for (std::size_t i = 0; i < found.size(); ++i) {
        base.push_back(sequence_of(found[i]));
        if (expected[i].tie) {
            ++counts.ties;
            continue;
        }
        const Compared compared = compare(found[i], expected[i], made.rays[i], fused);
        if (!compared.regions) {
            if (counts.wrong++ == 0) keep_finding("wrong", made, made.scene, made.rays[i]);
            continue;
        }
        if (!compared.overlaps && counts.overlaps++ == 0) keep_finding("overlaps", made, made.scene, made.rays[i]);
        counts.worst = std::max(counts.worst, compared.worst);
        if (compared.worst > 1 && counts.far++ == 0) keep_finding("far", made, made.scene, made.rays[i]);
    }
    for (std::size_t c = 0; c < changes.size(); ++c) {
        const Changed other = changed(made, c, size, base);
        const std::vector<RayPartitions> again =
            shoot(other.scene, other.objects, made.objects, other.rays, settings).found;
        for (std::size_t i = 0; i < again.size(); ++i) {
            if (expected[i].tie) continue;
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
