#include "compare.hpp"

#ifdef CSGRT_HAVE_IMAGE

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <limits>

#include <csgrt/image.hpp>

#include "cli/output.hpp"

namespace csgrt::cli {

namespace {

struct ChannelDifference {
    std::size_t pixels = 0;    ///< number of different pixels
    double largest = -1;       ///< infinite if a differing value is not a finite number; -1: no pixel differs
    std::size_t position = 0;  ///< index of the pixel with the largest difference
};

/// A channel's values, and their meaning.
struct Values {
    const Image& image;
    std::size_t channel;

    std::uint32_t bits(std::size_t i) const { return image.channels.ids(channel)[i]; }
    double at(std::size_t i) const {
        if (image.holds_ids(channel)) return image.channels.ids(channel)[i];
        return static_cast<double>(image.channels[channel][i]);
    }
};

ChannelDifference difference(const Values& a, const Values& b, std::size_t pixels, std::optional<double> tolerance) {
    ChannelDifference result;
    for (std::size_t i = 0; i < pixels; ++i) {
        if (a.bits(i) == b.bits(i)) continue;
        if (tolerance && std::isnan(a.at(i)) && std::isnan(b.at(i))) continue;
        double apart = std::abs(a.at(i) - b.at(i));
        if (std::isnan(apart)) apart = std::numeric_limits<double>::infinity();
        if (tolerance && apart <= *tolerance) continue;
        ++result.pixels;
        if (apart > result.largest) {
            result.largest = apart;
            result.position = i;
        }
    }
    return result;
}

std::string shape(const Image& image) {
    return std::to_string(image.width) + "x" + std::to_string(image.height) + " pixels";
}

/// Lines for the channels that only `a` has.
std::string missing(const Image& a, const Image& b, const std::string& path) {
    std::string text;
    for (const std::string& name : a.names)
        if (!b.has_channel(name)) text += "channel " + name + ": only in " + path + "\n";
    return text;
}

}  // namespace

Status compare_images(const CompareArguments& arguments) {
    Image a = read_image(arguments.first), b = read_image(arguments.second);
    if (a.width != b.width || a.height != b.height) {
        print("sizes differ: " + arguments.first + " has " + shape(a) + ", " + arguments.second + " has " + shape(b) +
              "\n");
        return Status::differs;
    }
    std::string text = missing(a, b, arguments.first) + missing(b, a, arguments.second);
    bool differs = !text.empty();
    std::size_t pixels = static_cast<std::size_t>(a.width) * static_cast<std::size_t>(a.height), common = 0;
    for (std::size_t c = 0; c < a.names.size(); ++c) {
        const auto in_b = std::ranges::find(b.names, a.names[c]);
        if (in_b == b.names.end()) continue;
        const Values own{a, c}, other{b, static_cast<std::size_t>(in_b - b.names.begin())};
        ++common;
        ChannelDifference found = difference(own, other, pixels, arguments.tolerance);
        differs |= found.pixels > 0;
        char line[256];
        if (found.pixels == 0) {
            std::snprintf(line, sizeof line, "%-10s  equal\n", a.names[c].c_str());
        } else {
            std::size_t at = found.position, width = static_cast<std::size_t>(a.width);
            std::snprintf(line, sizeof line,
                          "%-10s  %s (%.3g %%) differ, by at most %.9g at x %zu y %zu: %.9g and %.9g\n",
                          a.names[c].c_str(), counted(found.pixels, "pixel").c_str(),
                          100.0 * static_cast<double>(found.pixels) / static_cast<double>(pixels), found.largest,
                          at % width, at / width, own.at(at), other.at(at));
        }
        text += line;
    }
    if (!differs) text = "equal: " + counted(common, "channel") + " of " + shape(a) + "\n";
    print(text);
    return differs ? Status::differs : Status::ok;
}

}  // namespace csgrt::cli

#else

namespace csgrt::cli {

Status compare_images(const CompareArguments&) {
    throw Error(Status::usage, "this csgrt was built without OpenImageIO and reads no pictures");
}

}  // namespace csgrt::cli

#endif
