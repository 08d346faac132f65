#include "image/encode.hpp"

#include <memory>

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include "image/matrix.hpp"

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

/// Pixel by pixel, as image files want it.
std::vector<float> interleave(const Image& image) {
    const std::size_t count = image.channels.size();
    std::vector<float> pixels(count * image.channels[0].size());
    for (std::size_t c = 0; c < count; ++c) {
        for (std::size_t i = 0; i < image.channels[c].size(); ++i) pixels[i * count + c] = image.channels[c][i];
    }
    return pixels;
}

/// R G B in 8 bits, linear, as BRL-CAD writes them: 0..1 becomes 0..255, rounded.
std::vector<unsigned char> quantize(const Image& image, const std::string& name) {
    std::vector<unsigned char> pixels(3 * image.channels[0].size());
    for (std::size_t c = 0; c < 3; ++c) {
        const std::string color(1, "RGB"[c]);
        if (!image.has_channel(color))
            throw Error(Status::usage, name + ": the picture has no channel " + color + ", which a PNG needs");
        const std::span<const float> channel = image.channel(color);
        for (std::size_t i = 0; i < channel.size(); ++i) {
            const float value = channel[i];
            const float clamped = value > 0 ? (value < 1 ? value : 1) : 0;  // NaN is 0
            pixels[3 * i + c] = static_cast<unsigned char>(static_cast<double>(255 * clamped) + 0.5);
        }
    }
    return pixels;
}

void describe(OIIO::ImageSpec& spec, const Image& image, bool every_channel) {
    for (const auto& [key, text] : image.attributes) {
        const bool of_numbers = key == "csgrt:regions" || key == "csgrt:solids";  // of channels that a PNG has not
        if (every_channel || !of_numbers) spec.attribute(key, text);
    }
    for (const auto& [key, matrix] : image.matrices) {
        const std::vector<float> transposed = transpose(matrix);
        spec.attribute(key, OIIO::TypeMatrix, transposed.data());
    }
}

}  // namespace

std::vector<unsigned char> encode(const Image& image, const std::string& format, const std::string& name) {
    if (format != "exr" && format != "png") {
        throw Error(Status::usage, name + ": pictures are written as exr or png, not as \"" + format + '"');
    }
    check_form(image, name);
    const bool exr = format == "exr";
    const std::vector<float> floats = exr ? interleave(image) : std::vector<float>();
    const std::vector<unsigned char> colors = exr ? std::vector<unsigned char>() : quantize(image, name);

    OIIO::ImageSpec spec(image.width, image.height, exr ? static_cast<int>(image.names.size()) : 3,
                         exr ? OIIO::TypeFloat : OIIO::TypeUInt8);
    if (exr) {
        spec.channelnames = image.names;
        spec.attribute("compression", "zip");
        spec.attribute("DateTime", "");  // else OpenImageIO writes the time of day, and no two files are the same
    }
    describe(spec, image, exr);

    std::vector<unsigned char> bytes;
    OIIO::Filesystem::IOVecOutput sink(bytes);
    const std::unique_ptr<OIIO::ImageOutput> output = OIIO::ImageOutput::create(format, &sink);
    if (!output) throw Error(Status::file, name + ": OpenImageIO cannot write " + format + ": " + OIIO::geterror());
    const auto check = [&](bool good) {
        if (!good) throw Error(Status::file, name + ": cannot be encoded: " + output->geterror());
    };
    check(output->open("csgrt." + format, spec));
    check(exr ? output->write_image(OIIO::TypeFloat, floats.data())
              : output->write_image(OIIO::TypeUInt8, colors.data()));
    check(output->close());
    return bytes;
}

}  // namespace csgrt
