// Values of options, for the programs of bench/.
#pragma once

#include <charconv>
#include <cstdio>
#include <sstream>
#include <string>
#include <system_error>
#include <type_traits>
#include <vector>

#include <csgrt/error.hpp>

namespace csgrt::bench {

/// Throws Error (usage), which names the option, if the text is no such number.
template <class Number>
Number parse_number(const std::string& option, const std::string& text, Number least, Number most) {
    Number value{};
    const auto [end, fault] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (fault != std::errc() || end != text.data() + text.size() || !(value >= least && value <= most)) {
        char range[80];
        std::snprintf(range, sizeof range, "%g to %g", static_cast<double>(least), static_cast<double>(most));
        throw Error(Status::usage, option + ": needs a " + (std::is_integral_v<Number> ? "whole number" : "number") +
                                       " from " + range + ", not \"" + text + "\"");
    }
    return value;
}

/// The parts between commas.
inline std::vector<std::string> split_list(const std::string& list) {
    std::vector<std::string> parts;
    std::istringstream in(list);
    for (std::string part; std::getline(in, part, ',');) parts.push_back(part);
    return parts;
}

}  // namespace csgrt::bench
