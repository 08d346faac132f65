// What is measured, defined once: models, objects, and the figures that others have published or that were measured of
// them (milliseconds a frame at 1024 x 1024).
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace csgrt::bench {

struct Workload {
    std::string name;
    std::string file;  ///< relative to the models' folder, or to scenes/ if it ends in .json; none: generated
    std::vector<std::string> objects;
    /// BRL-CAD 7.32.6, first hits, shooting time only: 2 CPU cores; its OpenCL path on PoCL with 2 cores, and on an
    /// H200.
    double brlcad_cpu_ms = 0, brlcad_pocl_ms = 0, brlcad_h200_ms = 0;
    std::uint32_t parts = 0;  ///< solids of a generated scene, see parts.hpp
};

/// BRL-CAD 7.45 (August 2026; -O3 -march=native, link-time optimization), shooting time of `rt -R` in C, and csgrt
/// 7e9eb58, native, first hits of colours alone, in turn on a quiet Xeon with AVX-512 (2026-11-28): wall milliseconds
/// with 2 and with 16 threads. And on another Xeon the processor time of `rt -P1` in times of csgrt's.
struct BesideBrlcad {
    std::string workload;
    double rt_2, csgrt_2, rt_16, csgrt_16, one_thread;
};
inline const std::vector<BesideBrlcad>& beside_brlcad() {
    static const std::vector<BesideBrlcad> all = {
        {"boolean-ops", 83, 6.5, 22, 1.7, 8.4}, {"operators", 101, 17.5, 26, 3.6, 4.6},
        {"truck", 94, 14.5, 24, 2.9, 4.7},      {"tank_car", 227, 30, 44, 5.5, 6.6},
        {"havoc", 397, 46, 76, 6.2, 11.7},      {"goliath", 247, 54, 40, 6.0, 5.7},
    };
    return all;
}

inline const std::vector<Workload>& workloads() {
    static const std::vector<Workload> all = {
        {"boolean-ops", "boolean-ops.asc", {"all"}, 59, 113, 50},
        {"operators", "operators.asc", {"operators"}, 73, 172, 55},
        {"truck", "truck.asc", {"g1", "g2", "g4"}, 70, 401, 133},
        {"tank_car", "tank_car.asc", {"tank_car"}, 182, 625, 191},
        {"tank_car+track", "tank_car.asc", {"tank_car", "track"}},
        {"havoc", "havoc.asc", {"havoc"}, 340, 505, 307},
        {"goliath", "goliath.g", {"Goliath.c"}, 169, 814, 324},
        {"scene operators", "operators.json", {}},
        {"scene solids", "solids.json", {}},
        {"scene quadrics", "quadrics.json", {}},
        {"scene polyhedra", "polyhedra.json", {}},
        {"scene pipes", "pipes.json", {}},
        {"scene sketches", "sketches.json", {}},
        {"scene meshes", "meshes.json", {}},
        {"scene gear", "gear.json", {}},
        {"scene onion", "onion.json", {}},
        {"scene overlap", "overlap.json", {}},
        {"parts 10^2", "", {}, 0, 0, 0, 100},
        {"parts 10^3", "", {}, 0, 0, 0, 1'000},
        {"parts 10^4", "", {}, 0, 0, 0, 10'000},
        {"parts 10^5", "", {}, 0, 0, 0, 100'000},
        {"parts 10^6", "", {}, 0, 0, 0, 1'000'000},
    };
    return all;
}

}  // namespace csgrt::bench
