// The methods that are charted: each differs from the default in one thing. The last two run on the CPU, for
// comparison.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include <csgrt/renderer.hpp>

#include "base/laboratory.hpp"

namespace csgrt::bench {

struct Variant {
    std::string name;
    Settings settings;
    /// The reference computes it to the device's last bit (tests/pipeline), so it may answer in the device's place.
    bool on_reference() const { return !laboratory(settings).contraction; }
};

inline std::vector<Variant> variants() {
    std::vector<Variant> all;
    const auto add = [&](std::string_view name) -> Settings& {
        all.push_back({std::string(name), {}});
        return all.back().settings;
    };
    add("default");
    add("single").precision = Precision::single;
    add("single-world") = with_methods({.single_world = true});
    for (const auto& [name, quartic] : quartic_names)
        if (quartic != Quartic::bracketed) add(name) = with_methods({.quartic = quartic});
    add("tolerance 0.0005 mm").tolerance = 0.0005;  // BRL-CAD's
    add("tolerance surfaces").tolerance_rule = Tolerance::surfaces;
    add("tolerance relative").tolerance_rule = Tolerance::relative;
    add("tolerance none").tolerance_rule = Tolerance::none;
    add("contraction") = with_methods({.contraction = true});
    add("reference").reference = true;
    Settings& quad = add("113 bits");
    quad.reference = true;
    quad.precision = Precision::quad;
    return all;
}

}  // namespace csgrt::bench
