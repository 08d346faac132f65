// Pictures: channels of floats, each with a name. Reading and writing picture files is a component of its own
// (csgrt::image), so that the core needs no image library.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <new>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <csgrt/error.hpp>

namespace csgrt {

class Watch;

/// The values of several channels: the same number of floats or of 32-bit whole numbers for each. All channels are in
/// one block of memory, one after the other, so that a GPU can copy a part of all channels at once. Copies are deep.
/// Several threads may read at the same time, and may write to different values.
class CSGRT_API Channels {
public:
    /// An object without channels.
    Channels() = default;
    /// Makes as many channels as `values` has elements, each of `size` floats. All floats of channel i are values[i].
    /// Several threads write large channels. Throws std::bad_alloc.
    Channels(std::size_t size, std::span<const float> values);
    /// A copy of these channels. Throws Error (usage) if two channels have different numbers of values.
    Channels(const std::vector<std::vector<float>>& channels);  // NOLINT: converts between two forms of the same data
    Channels(Channels&& other) noexcept { *this = std::move(other); }
    Channels(const Channels& other);
    Channels& operator=(Channels&& other) noexcept;
    Channels& operator=(const Channels& other) { return *this = Channels(other); }

    /// The number of channels.
    std::size_t size() const noexcept { return count_; }
    bool empty() const noexcept { return count_ == 0; }
    /// The values of one channel; `channel` is less than size(). The span is valid until the object is assigned to,
    /// moved from or destroyed.
    std::span<float> operator[](std::size_t channel) noexcept { return {values_.get() + channel * size_, size_}; }
    std::span<const float> operator[](std::size_t channel) const noexcept {
        return {values_.get() + channel * size_, size_};
    }
    /// The values of one channel as whole numbers.
    std::span<std::uint32_t> ids(std::size_t channel) noexcept {
        return {reinterpret_cast<std::uint32_t*>(values_.get() + channel * size_), size_};
    }
    std::span<const std::uint32_t> ids(std::size_t channel) const noexcept {
        return {reinterpret_cast<const std::uint32_t*>(values_.get() + channel * size_), size_};
    }

    /// True if the sizes are the same and all floats are equal. A NaN equals nothing.
    CSGRT_API friend bool operator==(const Channels& a, const Channels& b) noexcept;

private:
    friend class Framebuffer;
    static constexpr std::align_val_t alignment{64};  // a processor's cache line, which a GPU writes at once
    struct Free {
        void operator()(float* values) const noexcept { ::operator delete(values, alignment); }
    };
    Channels(std::size_t size, std::span<const float> values, const Watch* watch);
    void allocate(std::size_t count, std::size_t size);

    std::size_t count_ = 0, size_ = 0;
    std::unique_ptr<float[], Free> values_;
};

/// A picture. Each channel has width x height values, row by row; the first is the TOP left pixel. Values are floats,
/// except for ids. A Renderer makes these channels, in this order, if View::channels has their group:
///
///     R G B           linear light, 0 to 1, more in highlights; the background where the ray hits nothing
///     A               1; with View::transparent 0 where the ray hits nothing, as R, G and B there
///     Z               distance along the ray in millimetres, infinity where it hits nothing; from the eye, or in an
///                     orthographic view from the plane on which its rays start (see the matrix worldToCamera)
///     N.X N.Y N.Z     unit normal of the surface, outward from the region, in the model's coordinates
///     region solid    ids: index into Model::regions() or Model::solids(), plus 1; 0 where the ray hits nothing
///     depth           number of segments along the ray: its intervals inside single solids
///     partitions      number of intervals between neighbouring boundaries that are inside any solid
///     overlap         number of these intervals that several regions claim (see Overlap)
///     RGBA8           ids: the colour for a display (display_pixels()), a byte each from the lowest byte on
///     ghost           ids: as region, of the first ghost (State) before the visible surface
///
/// Several threads may read one Image at the same time.
struct Image {
    int width = 0, height = 0;            ///< pixels
    std::vector<std::string> names = {};  ///< the names of the channels
    std::vector<bool> are_ids = {};  ///< for each channel, true if it holds whole numbers, not floats; missing: false
    Channels channels = {};
    /// True: R G B are display values (sRGB), as Settings::display_shading makes them. False: linear light.
    bool display_values = false;
    std::map<std::string, std::string> attributes = {};       ///< text for the file's header, by name
    std::map<std::string, std::vector<float>> matrices = {};  ///< 4 x 4, row-major, p' = M p, for the header, by name

    /// Whether the picture has a channel of this name.
    CSGRT_API bool has_channel(std::string_view name) const noexcept;
    /// The values of a channel by its name. The Image must exist while the values are used, so a temporary Image, such
    /// as the result of a call, has no such function. Throws Error (usage) if there is no such channel, or it holds
    /// ids; the message names the picture's channels.
    CSGRT_API std::span<const float> channel(std::string_view name) const&;
    std::span<const float> channel(std::string_view name) const&& = delete;
    /// The ids of a channel by its name, under the same rules.
    CSGRT_API std::span<const std::uint32_t> ids(std::string_view name) const&;
    std::span<const std::uint32_t> ids(std::string_view name) const&& = delete;
    bool holds_ids(std::size_t channel) const noexcept { return channel < are_ids.size() && are_ids[channel]; }
};

/// The colours of a picture for a display: R G B A of each pixel, one byte each, row by row from the top left. They are
/// encoded as sRGB, cut off at 0 and 1, and rounded; A is 255 if the picture has no such channel. Alpha is
/// unassociated, as in PNG: R, G and B are not multiplied by A. Throws Error (usage) if a channel of R, G and B is
/// missing. Any thread.
CSGRT_API std::vector<unsigned char> display_pixels(const Image& image);

/// Writes a picture file by the extension of `path`: .exr (every channel, as 32-bit floats, ids as 32-bit unsigned
/// integers; R G B in linear light) or .png (display_pixels(), without A if all pixels are opaque; its header says
/// sRGB). The file has a temporary name until it is complete. "-" writes to standard output, in `format` ("exr" or
/// "png"); so do the names of pipes and devices. Throws Error: usage if the picture lacks channels that the format
/// needs or the format is unknown, file if the file cannot be written. `progress` is called with the written part, 0 to
/// 1; if it returns false, nothing is written, and Error (interrupted) is thrown. Any thread. In csgrt::image.
CSGRT_API void write_image(const Image& image, const std::string& path, const std::string& format = "exr",
                           const std::function<bool(double)>& progress = {});

/// Reads an .exr with all its channels as 32-bit floats (R G B in linear light), unsigned integers as ids, its text
/// attributes and its matrices. Channels have csgrt's order; others follow. Throws Error (file). Any thread. In
/// csgrt::image.
CSGRT_API Image read_image(const std::string& path);

}  // namespace csgrt
