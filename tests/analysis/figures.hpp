// The figures of a measure in one order, and what they are of a known body.
#pragma once

#include <csgrt/measure.hpp>

#include "bodies.hpp"

namespace csgrt::test {

/// Volume, area, centroid, moments about the origin and about the centroid: 17.
inline std::vector<Estimate> estimates_of(const Measured& m) {
    std::vector<Estimate> all = {m.volume, m.area};
    all.insert(all.end(), m.centroid.begin(), m.centroid.end());
    all.insert(all.end(), m.origin.begin(), m.origin.end());
    all.insert(all.end(), m.central.begin(), m.central.end());
    return all;
}
inline std::vector<double> truths_of(const Body& body) {
    std::vector<double> all = {body.volume, body.area, body.centroid.x, body.centroid.y, body.centroid.z};
    for (const Tensor& second : {body.second, central(body)})
        for (const double moment : inertia_of(second)) all.push_back(moment);
    return all;
}

}  // namespace csgrt::test
