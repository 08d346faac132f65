// FNV-1a: a hash function, which makes one number of many bytes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace csgrt {

/// Computes the hash by words of 8 bytes. The high half of each product is folded into the low half, because otherwise
/// high bits would never affect low ones.
class Fnv1a {
public:
    template <class T>
    void add(const T& value) {
        add_bytes(&value, sizeof(T));
        static_assert(std::is_trivially_copyable_v<T> && !std::is_pointer_v<T> && !std::is_same_v<T, std::string_view>);
    }
    template <class T>
    void add_all(const std::vector<T>& values) {
        static_assert(std::is_trivially_copyable_v<T>);
        add(static_cast<std::uint64_t>(values.size()));
        add_bytes(values.data(), values.size() * sizeof(T));
    }
    void add_text(std::string_view text) {
        add(static_cast<std::uint64_t>(text.size()));
        add_bytes(text.data(), text.size());
    }
    std::uint64_t state() const { return state_; }

private:
    void add_bytes(const void* data, std::size_t size) {
        const auto* bytes = static_cast<const unsigned char*>(data);
        for (; size > 0; bytes += 8) {
            const std::size_t part = size < 8 ? size : 8;
            std::uint64_t word = 0;
            std::memcpy(&word, bytes, part);
            state_ = (state_ ^ word) * 1099511628211u;
            state_ ^= state_ >> 32;
            size -= part;
        }
    }

    std::uint64_t state_ = 14695981039346656037u;
};

/// A hash as text: 16 digits.
inline std::string hexadecimal(std::uint64_t number) {
    char digits[17];
    std::snprintf(digits, sizeof digits, "%016llx", static_cast<unsigned long long>(number));
    return digits;
}

}  // namespace csgrt
