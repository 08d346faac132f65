// Lists of rays and of partitions as BRL-CAD's answers come: text, packed with gzip.
#pragma once

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include <csgrt/renderer.hpp>

namespace csgrt::test {

/// The file unpacked. gzip is part of every Debian and Ubuntu, so no library is needed for this.
inline std::string unpacked(const std::string& path) {
    const std::unique_ptr<std::FILE, int (*)(std::FILE*)> pipe(popen(("gzip -dc '" + path + "'").c_str(), "r"), pclose);
    if (!pipe) throw std::runtime_error("cannot run gzip");
    std::string text;
    char block[65536];
    for (std::size_t n; (n = std::fread(block, 1, sizeof block, pipe.get())) > 0;) text.append(block, n);
    if (text.empty()) throw std::runtime_error("nothing in " + path);
    return text;
}

struct RayFile {
    double view_size = 0;
    std::vector<Ray> rays;
};

inline RayFile read_rays(const std::string& path) {
    RayFile file;
    std::istringstream text(unpacked(path));
    for (std::string line; std::getline(text, line);) {
        if (line.starts_with("#")) {
            const std::size_t at = line.find("viewsize ");
            if (at != line.npos) file.view_size = std::stod(line.substr(at + 9));
            continue;
        }
        std::istringstream numbers(line);
        Ray r;
        numbers >> r.origin.x >> r.origin.y >> r.origin.z >> r.direction.x >> r.direction.y >> r.direction.z;
        if (!numbers) throw std::runtime_error("no ray: " + line);
        file.rays.push_back(r);
    }
    return file;
}

/// A partition as far as it is compared: the region's own name, without the path to it.
struct Stretch {
    std::string region;
    double in = 0, out = 0;
    std::string in_solid, out_solid, in_type, out_type;
};
using Stretches = std::vector<Stretch>;  // of one ray, front to back

inline std::string last_name(const std::string& path) { return path.substr(path.rfind('/') + 1); }

struct PartitionFile {
    double box_diagonal = 0;
    std::vector<Stretches> rays;
};

inline PartitionFile read_partitions(const std::string& path) {
    PartitionFile file;
    std::istringstream text(unpacked(path));
    for (std::string line; std::getline(text, line);) {
        std::istringstream words(line);
        std::string first, second;
        words >> first;
        if (first == "#") {
            words >> second;
            double box[6] = {};
            if (second == "box") {
                for (double& value : box) words >> value;
                file.box_diagonal = std::hypot(box[3] - box[0], box[4] - box[1], box[5] - box[2]);
            }
        } else if (first == "ray") {
            std::size_t number = 0;
            words >> number;
            if (number < file.rays.size()) throw std::runtime_error("out of order: " + line);
            file.rays.resize(number + 1);
        } else if (!first.empty() && first != "overlap" && first != "seg") {
            std::string in, out;
            words >> in >> out;
            Stretch s{
                last_name(first), std::strtod(in.c_str(), nullptr), std::strtod(out.c_str(), nullptr), {}, {}, {}, {}};
            for (int normals = 0; normals < 6; ++normals) words >> in;
            words >> s.in_solid >> s.out_solid >> s.in_type >> s.out_type;
            if (!words || file.rays.empty()) throw std::runtime_error("no partition: " + line);
            file.rays.back().push_back(s);
        }
    }
    return file;
}

}  // namespace csgrt::test
