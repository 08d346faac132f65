#include "compare.hpp"

#ifdef CSGRT_HAVE_IMAGE

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <limits>

#include <csgrt/image.hpp>

#include "cli/output.hpp"

namespace csgrt::cli {

namespace {

struct ChannelDifference {
    std::size_t pixels = 0;    ///< that differ
    double largest = -1;       ///< infinite where only one of the two is a finite number
    std::size_t position = 0;  ///< of the largest
};

ChannelDifference difference(std::span<const float> a, std::span<const float> b, std::optional<double> tolerance) {
    ChannelDifference result;
    for (std::size_t i = 0; i < a.size(); ++i) {
        if (std::bit_cast<std::uint32_t>(a[i]) == std::bit_cast<std::uint32_t>(b[i])) continue;
        if (tolerance && std::isnan(a[i]) && std::isnan(b[i])) continue;
        double apart = std::abs(static_cast<double>(a[i]) - static_cast<double>(b[i]));
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

/// A line for each channel that only `a` has.
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
        if (!b.has_channel(a.names[c])) continue;
        const std::span<const float> other = b.channel(a.names[c]);
        ++common;
        ChannelDifference found = difference(a.channels[c], other, arguments.tolerance);
        differs |= found.pixels > 0;
        char line[256];
        if (found.pixels == 0) {
            std::snprintf(line, sizeof line, "%-10s  equal\n", a.names[c].c_str());
        } else {
            std::size_t at = found.position, width = static_cast<std::size_t>(a.width);
            std::snprintf(
                line, sizeof line, "%-10s  %s (%.3g %%) differ, by at most %.9g at x %zu y %zu: %.9g and %.9g\n",
                a.names[c].c_str(), counted(found.pixels, "pixel").c_str(),
                100.0 * static_cast<double>(found.pixels) / static_cast<double>(pixels), found.largest, at % width,
                at / width, static_cast<double>(a.channels[c][at]), static_cast<double>(other[at]));
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
