// Commands that draw a picture again.
#pragma once

#include <string>

#include <csgrt/method.hpp>
#include <csgrt/settings.hpp>

namespace csgrt {

/// The options that choose a method other than the default, on which a picture's bits depend, but for the tolerance:
/// " --precision single".
inline std::string method_options(const Settings& settings) {
    std::string text;
    if (settings.precision != Precision::double_)
        text.append(" --precision ").append(name_of(precision_names, settings.precision));
    if (settings.quartic != Quartic::bracketed)
        text.append(" --quartic ").append(name_of(quartic_names, settings.quartic));
    if (settings.contraction) text += " --contraction on";
    return text;
}

}  // namespace csgrt
