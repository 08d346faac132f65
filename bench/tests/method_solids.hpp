// A scene of solids side by side, each a region, for the tests of the laboratory: one of every type that has a closed
// form, stretched and turned.
#pragma once

#include <random>
#include <string>
#include <vector>

#include "compile/compiled_scene.hpp"
#include "compile/model.hpp"

namespace csgrt::test {

/// `all`: those without a bound of their distance, too.
inline Scene closed_forms(bool all) {
    std::vector<std::pair<std::string, Shape>> shapes = {
        {"ell", Ell{{}, {2, 0, 0}, {0.3, 1, 0}, {0, 0.2, 0.5}}},
        {"cylinder", Tgc{{}, {0.5, 0, 2}, {1, 0, 0}, {0, 0.5, 0}, {1, 0, 0}, {0, 0.5, 0}}},
        {"cone", Tgc{{}, {0, 0, 2}, {1, 0, 0}, {0, 1, 0}, {0, 0, 0}, {0, 0, 0}}},
        {"frustum", Tgc{{}, {0, 0, 1}, {0.4, 0, 0}, {0, 0.8, 0}, {1, 0, 0}, {0, 2, 0}}},
        {"tapers", Tgc{{}, {0, 0, 2}, {1, 0, 0}, {0, 1, 0}, {0.5, 0, 0}, {0, 0.8, 0}}},
        {"edge", Tgc{{}, {0, 0, 2}, {1, 0, 0}, {0, 0.3, 0}, {0, 0, 0}, {0, 1, 0}}},
        {"box", block_shape({-1, -1, -1}, {1, 0.5, 2})},
        {"tor", Tor{{}, {0, 1, 2}, 1.5, 0.4}},
        {"ehy", Ehy{{}, {0, 0, 2}, {1, 0, 0}, 1, 0.5, 0.7}},
        {"epa", Epa{{}, {0, 0, 2}, {1, 0, 0}, 1, 0.5}},
        {"rpc", Rpc{{}, {0, 2, 0}, {0, 0, 1.5}, 0.8}},
        {"rhc", Rhc{{}, {0, 2, 0}, {0, 0, 1.5}, 0.8, 0.4}},
        {"hyp", Hyp{{}, {0, 0, 2}, {1, 0, 0}, 0.7, 0.5}},
        {"eto", Eto{{}, {0, 0, 1}, {0.3, 0, 0.5}, 1.5, 0.25}},
        {"part", Part{{}, {0, 0, 2}, 0.9, 0.4}},
        {"ball in ball", Part{{}, {0, 0, 0.1}, 0.9, 0.4}},
        {"superell", Superell{{}, {1, 0, 0}, {0, 2, 0}, {0, 0, 1}, 1.4, 0.6}},
    };
    if (all) {
        shapes.push_back({"star", Superell{{}, {1, 0, 0}, {0, 2, 0}, {0, 0, 1}, 2.5, 1.5}});
        shapes.push_back({"hrt", Hrt{{}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, 0.2}});
    }
    Scene made;
    Matrix placed = askew(0.7);
    placed[0] *= 1.5;  // no similarity
    placed[3] = 0;
    for (const auto& [name, shape] : shapes) {
        const bool round = name == "tor" || name == "part" || name == "ball in ball";
        const double at = placed[3];
        made.objects.emplace_back(solid("s." + name, shape));
        Matrix leg_matrix = round ? moved(at, 0, 0) : placed;
        made.objects.emplace_back(region(name, {leg("s." + name, leg_matrix)}));
        placed[3] += 10;
    }
    return made;
}

/// A point in a solid's box, grown by a half.
inline Vec3 point_near(const Box& box, std::mt19937_64& random) {
    const auto in = [&](double low, double high) {
        const double part = static_cast<double>(random() >> 11) * 0x1p-53;
        return low + (high - low) * (2 * part - 0.5);
    };
    Vec3 p;
    p.x = in(box.low.x, box.high.x);
    p.y = in(box.low.y, box.high.y);
    p.z = in(box.low.z, box.high.z);
    return p;
}

}  // namespace csgrt::test
