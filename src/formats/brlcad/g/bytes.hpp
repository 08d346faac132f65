// Bytes of a binary database, and a reader of big-endian values in them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include <csgrt/scene.hpp>

#include "formats/source.hpp"

namespace csgrt {

constexpr std::size_t word_size = 4, real_size = 8;  // bytes of a whole number and of a double

/// A binary file in memory. Findings give byte offsets.
class ByteSource : public Source {
public:
    /// `name`: the file's name in diagnostics.
    ByteSource(std::string name, std::string bytes) : name_(std::move(name)), bytes_(std::move(bytes)) {}

    const std::string& name() const noexcept { return name_; }
    std::string_view bytes() const noexcept { return bytes_; }

    Place place(std::size_t offset, std::string object = {}) const override;
    std::string excerpt(std::size_t) const override { return {}; }

private:
    std::string name_;
    std::string bytes_;
};

/// Reads one value after another from a part of a file. A missing or wrong value is a Fault that names it (`what`).
class ByteReader {
public:
    ByteReader(std::string_view bytes, std::size_t offset) : bytes_(bytes), offset_(offset) {}

    std::size_t left() const noexcept { return bytes_.size(); }
    std::size_t offset() const noexcept { return offset_; }

    std::string_view take(std::uint64_t count, const char* what);
    std::uint8_t byte(const char* what) { return static_cast<std::uint8_t>(take(1, what)[0]); }

    /// A whole number of 1, 2, 4 or 8 bytes, for `width` 0, 1, 2 or 3.
    std::uint64_t number(unsigned width, const char* what);
    /// A whole number of 1, 2, 4 or 8 bytes whose highest bit is a sign.
    std::int64_t signed_number(unsigned width, const char* what);

    /// A number of 4 bytes.
    std::uint32_t word(const char* what) { return static_cast<std::uint32_t>(number(2, what)); }
    /// A word that is a number of items of `size` bytes each. A Fault if the rest of the bytes cannot hold so many.
    std::uint32_t count(std::size_t size, const char* what);
    /// A word that is less than `end`.
    std::uint32_t index(std::size_t end, const char* what);

    /// A finite double.
    double real(const char* what);
    Vec3 vec3(const char* what);

    /// The next byte, without taking it. There must be a byte.
    char peek() const { return bytes_.front(); }

    /// A text that a zero byte ends, without this byte.
    std::string_view text(const char* what);
    /// A text that is not empty.
    std::string_view name(const char* what);

private:
    std::string_view bytes_;
    std::size_t offset_;
};

}  // namespace csgrt
