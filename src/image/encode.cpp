#include "image/encode.hpp"

#include <algorithm>
#include <memory>
#include <thread>

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include "base/srgb.hpp"
#include "image/matrix.hpp"
#include "image/threads.hpp"
#include "image/whole.hpp"

namespace csgrt {

namespace {

void check_form(const Image& image, const std::string& name) {
    const auto refuse = [&](const std::string& why) { throw Error(Status::usage, name + ": the picture " + why); };
    if (image.width <= 0 || image.height <= 0) {
        refuse("has the size " + std::to_string(image.width) + " x " + std::to_string(image.height));
    }
    if (image.names.empty() || image.names.size() != image.channels.size()) {
        refuse("has " + std::to_string(image.names.size()) + " names for " + std::to_string(image.channels.size()) +
               " channels");
    }
    const std::size_t pixels = static_cast<std::size_t>(image.width) * image.height;
    if (image.channels[0].size() != pixels)
        refuse("has channels of " + std::to_string(image.channels[0].size()) + " values, not " +
               std::to_string(pixels));
    for (const auto& [key, matrix] : image.matrices) {
        if (matrix.size() != 16)
            refuse("has " + std::to_string(matrix.size()) + " numbers in matrix " + key + ", not 16");
    }
}

/// The pixels [first, end) one by one, in the order of image files. R G B are linear light.
void interleave(const Image& image, std::size_t first, std::size_t end, std::vector<float>& pixels) {
    const std::size_t count = image.channels.size();
    pixels.resize(count * (end - first));
    for (std::size_t c = 0; c < count; ++c)
        for (std::size_t i = first; i < end; ++i) pixels[(i - first) * count + c] = image.channels[c][i];
    if (!image.display_values) return;
    std::span<const float> alpha;
    if (image.has_channel("A")) alpha = image.channel("A");
    for (std::size_t c = 0; c < count; ++c) {
        if (image.names[c] != "R" && image.names[c] != "G" && image.names[c] != "B") continue;
        for (std::size_t i = first; i < end; ++i) {
            float& value = pixels[(i - first) * count + c];
            const double weight = !alpha.empty() && alpha[i] > 0 ? alpha[i] : 1;
            value = static_cast<float>(weight * linear_of_display(value / weight));
        }
    }
}

void describe(OIIO::ImageSpec& spec, const Image& image, bool every_channel) {
    for (const auto& [key, text] : image.attributes) {
        const bool of_numbers = key == "csgrt:regions" || key == "csgrt:solids" ||
                                key == "csgrt:overlaps";  // about channels that PNG lacks
        if (every_channel || !of_numbers) spec.attribute(key, text);
    }
    for (const auto& [key, matrix] : image.matrices) {
        const std::vector<float> transposed = transpose(matrix);
        spec.attribute(key, OIIO::TypeMatrix, transposed.data());
    }
}

}  // namespace

std::vector<unsigned char> encode(const Image& image, const std::string& format, const std::string& name,
                                  const std::function<bool(double)>& progress) {
    if (format != "exr" && format != "png") {
        throw Error(Status::usage, name + ": pictures are written as exr or png, not as \"" + format + '"');
    }
    check_form(image, name);
    const bool exr = format == "exr";
    for (const char* color : {"R", "G", "B"})
        if (!exr && !image.has_channel(color))
            throw Error(Status::usage, name + ": the picture has no channel " + color + ", which a PNG needs");
    const std::vector<unsigned char> colors = exr ? std::vector<unsigned char>() : display_pixels(image);
    bool opaque = true;
    for (std::size_t i = 3; i < colors.size(); i += 4) opaque = opaque && colors[i] == 255;

    const int count = exr ? static_cast<int>(image.names.size()) : opaque ? 3 : 4;
    OIIO::ImageSpec spec(image.width, image.height, count, exr ? OIIO::TypeFloat : OIIO::TypeUInt8);
    if (exr) {
        spec.channelnames = image.names;
        for (std::size_t c = 0; c < image.names.size(); ++c)
            spec.channelformats.push_back(image.holds_ids(c) ? OIIO::TypeUInt32 : OIIO::TypeFloat);
        spec.attribute("compression", "zip");
        spec.attribute("DateTime", "");  // without it, OpenImageIO would write the current time
    } else {
        spec.attribute("oiio:ColorSpace", "sRGB");
        spec.attribute("oiio:UnassociatedAlpha", 1);  // the pixels given to OpenImageIO have unassociated alpha
    }
    describe(spec, image, exr);

    std::vector<unsigned char> bytes;
    OIIO::Filesystem::IOVecOutput sink(bytes);
    const std::unique_ptr<OIIO::ImageOutput> output = OIIO::ImageOutput::create(format, &sink);
    if (!output) throw Error(Status::file, name + ": OpenImageIO cannot write " + format + ": " + OIIO::geterror());
    const auto check = [&](bool good) {
        if (!good) throw_from(name + ": cannot be encoded: ", output->geterror());
    };
    check(output->open("csgrt." + format, spec));
    if (!exr) check(output->write_image(OIIO::TypeUInt8, colors.data(), 4));
    std::vector<float> floats;
    // One thread compresses 16 rows together.
    const int rows_at_once =
        progress ? 16 * static_cast<int>(std::max(1u, std::thread::hardware_concurrency())) : image.height;
    for (int row = 0, end = 0; exr && row < image.height; row = end) {
        if (progress && !progress(static_cast<double>(row) / image.height))
            throw Error(Status::interrupted, "interrupted");
        end = std::min(row + rows_at_once, image.height);
        const auto width = static_cast<std::size_t>(image.width);
        interleave(image, width * static_cast<std::size_t>(row), width * static_cast<std::size_t>(end), floats);
        check(output->write_scanlines(row, end, 0, OIIO::TypeUnknown, floats.data()));
    }
    check(output->close());
    if (exr && !is_whole(bytes, image))
        throw Error(Status::file, name + ": OpenImageIO has left the picture unfinished: is there enough memory?");
    return bytes;
}

}  // namespace csgrt
