// Pictures: float channels by name. Writing them is a component of its own (csgrt::image), the core needs no image library.
#pragma once

#include <cstddef>
#include <map>
#include <memory>
#include <new>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <csgrt/error.hpp>

namespace csgrt {

/// The values of several channels, of each as many floats: channel by channel in one piece of memory, so that a GPU copies a part of
/// all of them at once.
class CSGRT_API Channels {
public:
    Channels() = default;
    /// `size` values of each channel, all as `values` says of it. Much memory is first touched by all processors.
    Channels(std::size_t size, std::span<const float> values);
    /// The same values. Throws Error (usage) if a channel has not as many as the first.
    Channels(const std::vector<std::vector<float>>& channels);  // NOLINT: it is the same in another form
    Channels(Channels&& other) noexcept { *this = std::move(other); }
    Channels(const Channels& other);
    Channels& operator=(Channels&& other) noexcept;
    Channels& operator=(const Channels& other) { return *this = Channels(other); }

    std::size_t size() const noexcept { return count_; }  ///< of channels
    bool empty() const noexcept { return count_ == 0; }
    std::span<float> operator[](std::size_t channel) noexcept { return {values_.get() + channel * size_, size_}; }
    std::span<const float> operator[](std::size_t channel) const noexcept { return {values_.get() + channel * size_, size_}; }

    CSGRT_API friend bool operator==(const Channels& a, const Channels& b) noexcept;

private:
    static constexpr std::align_val_t alignment{64};  // a line of a processor's cache, which a GPU writes at once
    struct Free {
        void operator()(float* values) const noexcept { ::operator delete(values, alignment); }
    };
    void allocate(std::size_t count, std::size_t size);

    std::size_t count_ = 0, size_ = 0;
    std::unique_ptr<float[], Free> values_;
};

/// Channels in the order R G B A Z N.X N.Y N.Z region solid depth partitions overlap, as far as the view wants them; each
/// width x height floats, row by row from the TOP left. Z is the distance along the ray in millimetres (infinity: nothing hit),
/// from the eye, or of an orthographic view from the plane on which its rays start, which the matrix worldToCamera tells;
/// region and solid are index + 1 (0: nothing), depth the number of segments on the ray.
struct Image {
    int width = 0, height = 0;
    std::vector<std::string> names;
    Channels channels;
    std::map<std::string, std::string> attributes;          ///< text for the header
    std::map<std::string, std::vector<float>> matrices;     ///< 4x4, row-major, p' = M p, for the header

    /// The channel of that name, if there is one.
    std::optional<std::span<const float>> channel(const std::string& name) const {
        for (std::size_t i = 0; i < names.size(); ++i) {
            if (names[i] == name) return channels[i];
        }
        return std::nullopt;
    }
};

/// Writes .exr (every channel, 32-bit float) or .png (R G B, 8 bits), by extension, to a temporary name that is
/// renamed when whole. "-" writes `format` ("exr" or "png") to standard output. Throws Error (file, usage).
CSGRT_API void write_image(const Image& image, const std::string& path, const std::string& format = "exr");

/// Reads an .exr with all its float channels, text attributes and matrices. Throws Error (file).
CSGRT_API Image read_image(const std::string& path);

}  // namespace csgrt
