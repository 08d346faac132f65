// The files from which libFuzzer begins (tests/fuzz/seeds): a little of everything, so that a change anywhere meets
// some reader; and such changes.
#pragma once

#include <algorithm>
#include <iterator>
#include <random>
#include <string>

#include "catch.hpp"
#include "folder.hpp"
#include "integration/scenes.hpp"

namespace csgrt::test {

inline std::string read_seed(const std::string& name) {
    const std::string bytes = read_file(folder("CSGRT_SCENES") + "/../tests/fuzz/seeds/" + name);
    REQUIRE(!bytes.empty());
    return bytes;
}

/// Up to `changes` changes at random places, of `longest` bytes at most, by which some of `fragments` come in.
template <class Fragments>
std::string changed_at_random(std::string bytes, const Fragments& fragments, std::size_t changes, std::size_t longest,
                              std::mt19937& random) {
    const auto below = [&](std::size_t n) { return n == 0 ? 0 : static_cast<std::size_t>(random()) % n; };
    for (std::size_t i = 0, count = 1 + below(changes); i < count && !bytes.empty(); ++i) {
        const std::size_t at = below(bytes.size()), length = below(std::min(longest, bytes.size() - at));
        const std::string& fragment = fragments[below(std::size(fragments))];
        switch (below(8)) {
            case 0:
                bytes.erase(at, length);
                break;
            case 1:
                bytes.insert(at, fragment);
                break;
            case 2:
                bytes.replace(at, length, fragment);
                break;
            case 3:
                bytes[at] = static_cast<char>(random());
                break;
            case 4:
                bytes.insert(below(bytes.size()), bytes.substr(at, length));
                break;
            case 5:
                if (const std::size_t digit = bytes.find_first_of("0123456789", at); digit != std::string::npos)
                    bytes[digit] = static_cast<char>('0' + below(10));
                break;
            case 6:  // one bit, so that lengths and counts of binary files stay near what they were
                bytes[at] = static_cast<char>(bytes[at] ^ (1 << below(8)));
                break;
            default:
                if (below(4) == 0) bytes.resize(at);
                break;
        }
    }
    return bytes;
}

}  // namespace csgrt::test
