// The files from which libFuzzer begins (tests/fuzz/seeds): a little of everything, so that a change anywhere meets
// some reader.
#pragma once

#include <fstream>
#include <iterator>
#include <string>

#include "catch.hpp"
#include "integration/scenes.hpp"

namespace csgrt::test {

inline std::string read_seed(const std::string& name) {
    std::ifstream file(folder("CSGRT_SCENES") + "/../tests/fuzz/seeds/" + name, std::ios::binary);
    REQUIRE(file);
    return {std::istreambuf_iterator<char>(file), {}};
}

}  // namespace csgrt::test
