#include <algorithm>
#include <array>
#include <iterator>
#include <memory>
#include <numeric>

#include <OpenImageIO/imageio.h>

#include <csgrt/image.hpp>

#include "image/matrix.hpp"
#include "image/threads.hpp"

namespace csgrt {

namespace {

/// The order of channels in csgrt. The file itself keeps its channels in alphabetic order.
constexpr std::array channel_order = {"R",   "G",      "B",     "A",     "Z",          "N.X",    "N.Y",
                                      "N.Z", "region", "solid", "depth", "partitions", "overlap"};

std::size_t rank(const std::string& name) {
    return static_cast<std::size_t>(std::find(channel_order.begin(), channel_order.end(), name) -
                                    channel_order.begin());
}

Image read(const std::string& path) {
    if (path.find('\0') != path.npos)
        throw Error(Status::file, std::string(path.c_str()) + ": cannot read: the name of a file has no NUL");
    const std::unique_ptr<OIIO::ImageInput> input = OIIO::ImageInput::open(path);
    if (!input) throw_from(path + ": cannot read: ", OIIO::geterror());
    if (std::string(input->format_name()) != "openexr") throw Error(Status::file, path + ": is no EXR file");

    const OIIO::ImageSpec& spec = input->spec();
    if (spec.depth > 1 || spec.deep) throw Error(Status::file, path + ": is no flat picture");
    const std::size_t count = spec.channelnames.size();
    const std::size_t pixels = static_cast<std::size_t>(spec.width) * spec.height;
    std::vector<float> interleaved(count * pixels);
    const auto read_as = [&](OIIO::TypeDesc type, std::size_t first, std::size_t end, void* to) {
        if (!input->read_image(0, 0, static_cast<int>(first), static_cast<int>(end), type, to))
            throw_from(path + ": cannot read: ", input->geterror());
    };
    const auto holds_ids = [&](std::size_t c) { return spec.channelformat(static_cast<int>(c)) == OIIO::TypeUInt32; };
    // Ids are read again as whole numbers below, because as floats they become fractions of the largest whole number.
    read_as(OIIO::TypeFloat, 0, count, interleaved.data());

    std::vector<std::size_t> order(count);
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
        return rank(spec.channelnames[a]) < rank(spec.channelnames[b]);
    });

    Image image;
    image.width = spec.width;
    image.height = spec.height;
    image.channels = Channels(pixels, std::vector<float>(count));
    for (std::size_t i = 0; i < count; ++i) {
        image.names.push_back(spec.channelnames[order[i]]);
        image.are_ids.push_back(holds_ids(order[i]));
        if (image.are_ids.back()) {
            read_as(OIIO::TypeUInt32, order[i], order[i] + 1, image.channels.ids(i).data());
            continue;
        }
        const std::span<float> channel = image.channels[i];
        for (std::size_t p = 0; p < pixels; ++p) channel[p] = interleaved[p * count + order[i]];
    }
    for (const OIIO::ParamValue& attribute : spec.extra_attribs) {
        const std::string name = attribute.name().string();
        if (name == "compression" || name.starts_with("oiio:")) continue;  // a property of the file, not of the picture
        if (attribute.type() == OIIO::TypeString) {
            image.attributes[name] = attribute.get_string();
        } else if (attribute.type() == OIIO::TypeMatrix) {
            const float* values = static_cast<const float*>(attribute.data());
            image.matrices[name] = transpose(std::vector<float>(values, values + 16));
        }
    }
    return image;
}

}  // namespace

Image read_image(const std::string& path) {
    return with_image_threads(path, [&path] { return read(path); });
}

}  // namespace csgrt
