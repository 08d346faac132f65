#include "formats/brlcad/g/bytes.hpp"

#include <bit>
#include <cmath>

namespace csgrt {

Place ByteSource::place(std::size_t offset, std::string object) const {
    Place place;
    place.file = name_;
    place.offset = static_cast<std::int64_t>(offset);
    place.pointer = std::move(object);
    return place;
}

std::string_view ByteReader::take(std::uint64_t count, const char* what) {
    if (count > bytes_.size()) {
        throw Fault{offset_,
                    std::string(what) + ": " + std::to_string(count) + " bytes are needed, but only " +
                        std::to_string(bytes_.size()) + " are left",
                    {}};
    }
    const auto size = static_cast<std::size_t>(count);
    const std::string_view taken = bytes_.substr(0, size);
    bytes_.remove_prefix(size);
    offset_ += size;
    return taken;
}

std::uint64_t ByteReader::number(unsigned width, const char* what) {
    std::uint64_t value = 0;
    for (const char c : take(std::uint64_t{1} << width, what)) value = value << 8 | static_cast<std::uint8_t>(c);
    return value;
}

std::int64_t ByteReader::signed_number(unsigned width, const char* what) {
    const unsigned unused = 64 - (8u << width);
    // The number is shifted up so that its sign is the highest bit, and down again with the sign.
    return static_cast<std::int64_t>(number(width, what) << unused) >> unused;
}

std::uint32_t ByteReader::count(std::size_t size, const char* what) {
    const std::size_t at = offset_;
    const std::uint32_t value = word(what);
    if (value > left() / size) {
        throw Fault{at,
                    std::string(what) + ": " + std::to_string(value) + " of " + std::to_string(size) +
                        " bytes each do not fit into the " + std::to_string(left()) + " bytes that are left",
                    {}};
    }
    return value;
}

std::uint32_t ByteReader::index(std::size_t end, const char* what) {
    const std::size_t at = offset_;
    const std::uint32_t value = word(what);
    if (value >= end) {
        throw Fault{at,
                    std::string(what) + ": there is no number " + std::to_string(value) + ", only " +
                        std::to_string(end) + ", counted from 0",
                    {}};
    }
    return value;
}

double ByteReader::real(const char* what) {
    constexpr unsigned eight_bytes = 3;
    const std::size_t at = offset_;
    const double value = std::bit_cast<double>(number(eight_bytes, what));
    if (!std::isfinite(value)) throw Fault{at, std::string(what) + " is not a finite number", {}};
    return value;
}

Vec3 ByteReader::vec3(const char* what) {
    const double x = real(what), y = real(what), z = real(what);
    return {x, y, z};
}

std::string_view ByteReader::text(const char* what) {
    const std::size_t length = bytes_.find('\0');
    if (length == std::string_view::npos) {
        throw Fault{offset_, std::string(what) + " does not end: it has no zero byte", {}};
    }
    return take(length + 1, what).substr(0, length);
}

std::string_view ByteReader::name(const char* what) {
    const std::size_t begin = offset_;
    const std::string_view name = text(what);
    if (name.empty()) throw Fault{begin, std::string(what) + " is empty", {}};
    return name;
}

}  // namespace csgrt
