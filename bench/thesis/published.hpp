// What Domingues 2017 publishes of its six models: tables 4.1 and 4.2, and figure 4.2, whose times figure 4.1 draws.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace csgrt::bench {

struct Published {
    std::string name, file;            ///< file: in the folder of BRL-CAD's models
    std::vector<std::string> objects;  ///< none: the top objects
    double view_size = 0;              ///< millimetres; 0: csgrt's default, BRL-CAD's view of the model
    std::string workload;              ///< of workloads.hpp, with what was measured of BRL-CAD
    int primitives = 0, regions = 0;
    int segments = 0, partitions = 0, allocated = 0;
    double megabytes = 0;
    /// Milliseconds a frame of 1024 x 1024, in the order of published_columns.
    std::vector<double> ms;
};

/// Processor or GPU, and what ran on it.
inline const std::vector<std::pair<std::string, std::string>> published_columns = {
    {"Core i5-4790k", "BRL-CAD"},    {"Core i5-4790k", "Intel's OpenCL"}, {"Core i5-4790k", "AMD's OpenCL"},
    {"Ryzen 5 1600", "BRL-CAD"},     {"Ryzen 5 1600", "Intel's OpenCL"},  {"Ryzen 5 1600", "AMD's OpenCL"},
    {"GTX 1060", "NVIDIA's OpenCL"}, {"GTX Titan", "NVIDIA's OpenCL"},
};

/// The objects and views are those that give the thesis's numbers of regions and, but for a thousandth, its segments.
inline const std::vector<Published>& published() {
    // clang-format off
    static const std::vector<Published> all = {
        {"Boolean Ops", "boolean-ops.asc", {"aUbUc"}, 6, "boolean-ops", 3, 1, 433443, 573728, 866886, 379.5,
         {70, 110, 150, 50, 340, 340, 40, 50}},
        {"Operators", "operators.asc", {"operators"}, 0, "operators", 32, 20, 405319, 516066, 810638, 356.1,
         {120, 130, 180, 60, 280, 230, 50, 60}},
        {"Truck", "truck.asc", {}, 0, "truck", 182, 146, 796168, 1010303, 1592336, 697.2,
         {80, 200, 290, 50, 350, 360, 80, 90}},
        {"Tank Car", "tank_car.asc", {"tank_car", "track"}, 0, "tank_car", 787, 180, 651742, 915691, 1303484, 581.3,
         {280, 260, 330, 160, 350, 350, 120, 110}},
        {"Havoc", "havoc.asc", {"havoc"}, 0, "havoc", 2427, 308, 701340, 958081, 1402680, 650.0,
         {520, 300, 320, 290, 270, 270, 520, 290}},
        {"Goliath", "goliath.g", {"Goliath.c"}, 0, "goliath", 3861, 1411, 1710913, 1875823, 3421826, 1642.7,
         {500, 460, 650, 310, 880, 870, 300, 370}},
    };
    // clang-format on
    return all;
}

}  // namespace csgrt::bench
