// Writes binary databases byte by byte, right ones and wrong ones.
#pragma once

#include <bit>
#include <cstdint>
#include <initializer_list>
#include <string>
#include <string_view>
#include <vector>

namespace csgrt::g_test {

inline const std::string zero(1, '\0');

/// A whole number of 1 << width bytes, highest first.
inline std::string number(std::uint64_t value, unsigned width) {
    std::string out;
    for (unsigned bits = 8u << width; bits > 0; bits -= 8) out += static_cast<char>(value >> (bits - 8) & 0xFF);
    return out;
}

inline std::string reals(const std::vector<double>& values) {
    std::string out;
    for (const double value : values) out += number(std::bit_cast<std::uint64_t>(value), 3);
    return out;
}

/// first, first + 1, ...: as many numbers as a solid needs.
inline std::string counted_reals(double first, int count) {
    std::string out;
    for (int i = 0; i < count; ++i) out += reals({first + i});
    return out;
}

/// Keys and values with their zero bytes, and the one that ends them.
inline std::string attributes(std::initializer_list<std::string_view> keys_and_values) {
    std::string out;
    for (const std::string_view text : keys_and_values) out += std::string(text) + zero;
    return out + zero;
}

struct WrittenObject {
    int major = 1, minor = 0;
    std::string name{};        ///< without its zero byte; none if empty
    std::string body{};        ///< none if empty
    std::string attributes{};  ///< none if empty
    int kind = 0;              ///< 0 data, 1 header, 2 free
    int compression = 0;       ///< of attributes and body
    unsigned width = 0;        ///< of all lengths

    std::string bytes() const {
        const unsigned present = 0x20;
        const auto byte = [](unsigned value) { return number(value, 0); };
        const auto block = [&](const std::string& text) {
            return text.empty() ? "" : number(text.size(), width) + text;
        };
        const auto flags = [&](const std::string& text) {
            return byte(text.empty() ? 0 : width << 6 | present | static_cast<unsigned>(compression));
        };
        const unsigned named = name.empty() ? 0 : width << 3 | present;
        const std::string head = byte(0x76) + byte(width << 6 | named | static_cast<unsigned>(kind)) +
                                 flags(attributes) + flags(body) + byte(static_cast<unsigned>(major)) +
                                 byte(static_cast<unsigned>(minor));
        const std::string parts = (name.empty() ? "" : block(name + zero)) + block(attributes) + block(body);
        const std::size_t size = head.size() + (std::size_t{1} << width) + parts.size() + 1;
        const std::size_t units = (size + 7) / 8;
        return head + number(units, width) + parts + std::string(units * 8 - size, '\0') + byte(0x35);
    }
};

inline const std::string header = WrittenObject{.major = 0, .kind = 1}.bytes();

/// The body of a combination. What is not given is counted.
struct Members {
    struct Leaf {
        std::string name;
        std::int64_t matrix = -1;
    };
    std::vector<Leaf> leaves{};
    std::string expression{};
    std::vector<std::vector<double>> matrices{};
    unsigned width = 0;
    std::int64_t matrix_count = -1, leaf_count = -1, leaf_bytes = -1, expression_length = -1;

    std::string bytes() const {
        const auto count = [&](std::int64_t given, std::size_t counted) {
            return number(given >= 0 ? static_cast<std::uint64_t>(given) : counted, width);
        };
        std::string names, numbers;
        for (const Leaf& leaf : leaves) {
            names += leaf.name + zero + number(static_cast<std::uint64_t>(leaf.matrix), width);
        }
        for (const auto& matrix : matrices) numbers += reals(matrix);
        return number(width, 0) + count(matrix_count, matrices.size()) + count(leaf_count, leaves.size()) +
               count(leaf_bytes, names.size()) + count(expression_length, expression.size()) + number(9, width) +
               numbers + names + expression;
    }
};

inline std::string combination(const std::string& name, const Members& members, const std::string& keys = {}) {
    return WrittenObject{.minor = 31, .name = name, .body = members.bytes(), .attributes = keys}.bytes();
}

inline std::string sphere(const std::string& name) {
    return WrittenObject{.minor = 3, .name = name, .body = reals({0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1})}.bytes();
}

}  // namespace csgrt::g_test
