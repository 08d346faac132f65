// Texts that nobody would write: each is read, or refused with an Error; nothing else may happen. Fixed seeds.
#include "catch.hpp"

#include <random>

#include "formats/json/parse_text.hpp"
#include "formats/json/writer.hpp"
#include "formats/same_scene.hpp"
#include "sanitized.hpp"

using namespace csgrt;

namespace {

/// A little of everything, so that a change anywhere meets some reader.
const std::string everything = R"({
  "csgrt": 1, "title": "t \u00e9", "units": "in", "ambient": 0.4, "background": [0, 0.5, 1], "tolerance": 1e-4,
  "camera": {"azimuth": 35, "elevation": -25.5, "perspective": 0, "center": [0, 0, 1e3], "size": 3},
  "lights": [{"position": [1, 2, 3], "color": [1, 1, 1], "intensity": 1}],
  "materials": {"red": {"color": [1, 0, 0], "shine": 3, "shader": "plastic", "specular": 0.5}},
  "solids": {
    "s": {"type": "sphere", "center": [0, 0, 0], "radius": 1},
    "e": {"type": "ell", "center": [0, 0, 0], "a": [1, 0, 0], "b": [0, 1, 0], "c": [0, 0, 1]},
    "k": {"type": "cone", "base": [0, 0, 0], "height": [0, 1, 1], "radius": 1, "top_radius": 0.5},
    "b": {"type": "box", "low": [0, 0, 0], "high": [1, 1, 1]},
    "p": {"type": "arb4", "vertices": [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]]},
    "h": {"type": "half", "normal": [0, 0, 1], "distance": -2},
    "n": {"type": "arbn",
        "planes": [{"normal": [1, 1, 1], "distance": 1}, {"normal": [-1, 0, 0], "distance": 1},
        {"normal": [0, -1, 0], "distance": 0}, {"normal": [0, 0, -1], "distance": 0}]},
    "t": {"type": "tor", "center": [0, 0, 0], "axis": [0, 0, 1], "radius": 2, "tube": 1},
    "y": {"type": "ehy", "base": [0, 0, 0], "height": [0, 0, 1], "a": [1, 0, 0], "r1": 1, "r2": 1, "c": 1},
    "u": {"type": "unsupported", "was": "grip"},
    "pa": {"type": "part", "base": [0, 0, 0], "height": [0, 0, 3], "radius": 2, "top_radius": 1},
    "ea": {"type": "epa", "base": [0, 0, 0], "height": [0, 0, 3], "a": [1, 0, 0], "r1": 2, "r2": 1},
    "rp": {"type": "rpc", "base": [0, 0, 0], "height": [0, 3, 0], "b": [0, 0, 2], "half_width": 1},
    "rh": {"type": "rhc", "base": [0, 0, 0], "height": [0, 3, 0], "b": [0, 0, 2], "half_width": 1, "c": 0.5},
    "et": {"type": "eto", "center": [0, 0, 0], "axis": [0, 0, 1], "radius": 5, "c": [1, 0, 2], "d": 1},
    "hy": {"type": "hyp", "base": [0, 0, 0], "height": [0, 0, 3], "a": [2, 0, 0], "b": 1, "neck": 0.5},
    "su": {"type": "superell", "center": [0, 0, 0], "a": [1, 0, 0], "b": [0, 1, 0], "c": [0, 0, 1], "n": 0.5, "e": 0.3},
    "hr": {"type": "hrt", "center": [0, 0, 0], "x": [1, 0, 0], "y": [0, 1, 0], "z": [0, 0, 1], "d": 1},
    "me": {"type": "metaball", "method": "blob", "threshold": 1,
        "points": [{"position": [0, 0, 0], "strength": 1, "softness": 2}, {"position": [1, 0, 0], "strength": 2}]},
    "pi": {"type": "pipe",
        "points": [{"position": [0, 0, 0], "outer": 2, "inner": 1, "bend": 3},
        {"position": [9, 0, 0], "outer": 2, "bend": 3}, {"position": [9, 9, 0], "outer": 2}]},
    "cl": {"type": "cline", "base": [0, 0, 0], "height": [0, 0, 3], "radius": 2, "thickness": 0.5},
    "bo": {"type": "bot", "mode": "plate", "orientation": "clockwise",
        "vertices": [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]], "faces": [[0, 1, 2], [0, 3, 1]], "thickness": [1, 2],
        "append": [0, 1], "normals": [[0, 0, 1]], "face_normals": [[0, 0, 0]]},
    "ar": {"type": "ars",
        "curves": [[[0, 0, 0], [0, 0, 0], [0, 0, 0]], [[1, 0, 1], [0, 1, 1], [-1, 0, 1]],
        [[0, 0, 2], [0, 0, 2], [0, 0, 2]]]},
    "nm": {"type": "nmg", "vertices": [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]],
        "faces": [[0, 2, 1], [[0, 1, 3]], [1, 2, 3], [2, 0, 3]]},
    "eb": {"type": "ebm", "width": 3, "depth": 2, "height": 5, "cells": ["#.#", "1 0 255"],
        "matrix": [2, 0, 0, 0, 0, 2, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1], "file": "f"},
    "vo": {"type": "vol", "width": 2, "depth": 1, "height": 2, "cell": [1, 2, 3], "low": 9, "high": 200,
        "cells": ["10 20", "0 7"]},
    "ds": {"type": "dsp", "width": 3, "depth": 2, "smooth": true, "cut": "upper_left",
        "heights": ["1 20 300", "0 65535 7"]},
    "ex": {"type": "extrude", "base": [0, 0, 0], "height": [0, 0, 3], "a": [1, 0, 0], "b": [0, 1, 0],
        "sketch": {"name": "sk", "vertices": [[0, 0], [4, 0], [4, 4], [0, 4], [2, 2]],
      "curves": [{"line": [0, 1]}, {"arc": [1, 2], "radius": 3, "clockwise": true, "reversed": true},
          {"bezier": [2, 3, 4, 0]}, {"circle": [4, 1]}]}},
    "re": {"type": "revolve", "base": [0, 0, 0], "axis": [0, 0, 1], "r": [1, 0, 0], "angle": 90,
        "sketch": {"vertices": [[0, 0], [2, 0], [2, 2], [0, 3]],
      "curves": [{"line": [0, 1]},
          {"nurb": [1, 2, 3], "order": 3, "knots": [0, 0, 0, 1, 1, 1], "weights": [1, 0.5, 1]}]}}
  },
  "combinations": {
    "c": {"tree": {"difference": ["s", {"union": ["e", {"not": "k"}], "translate": [1, 2, 3]}, {"xor": ["b", "p"]}]},
        "region": true, "id": 7},
    "d": {"tree": {"intersection": [{"object": "c", "rotate": {"axis": [1, 0, 0], "angle": 90}, "scale": -2},
        {"object": "n", "matrix": [1, 0, 0, 5, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1]}]}, "material": "red",
        "inherit": ["color"]},
    "f": {"tree": {"postfix": ["c", "d", {"operator": "union", "operands": 2}]}},
    "g": {"tree": null, "material": {"diffuse": 1}}
  },
  "objects": ["f", "g", "pa", "ea", "rp", "rh", "et", "hy", "su", "hr", "me", "pi", "cl", "bo", "ar", "nm", "eb", "vo",
      "ds", "ex", "re"], "region_colors": [{"low": 0, "high": 9, "color": [0, 0, 1]}]
})";

const char* const fragments[] = {"{",
                                 "}",
                                 "[",
                                 "]",
                                 ",",
                                 ":",
                                 "\"",
                                 "null",
                                 "true",
                                 "-",
                                 "1e999",
                                 "NaN",
                                 "0",
                                 "1e308",
                                 "-0",
                                 "\\u0000",
                                 "\\ud800",
                                 "\xff",
                                 "\"not\": ",
                                 "{\"not\": ",
                                 "\"s\"",
                                 "\"c\"",
                                 "\"f\"",
                                 "[[[[[[[[",
                                 "1e-400",
                                 "{\"object\": \"f\"}",
                                 "\"type\": \"tgc\"",
                                 "9999999999999999999999",
                                 "\n",
                                 "//",
                                 "\"\""};

std::string mutated(std::mt19937& random) {
    std::string text = everything;
    const auto below = [&](std::size_t n) { return static_cast<std::size_t>(random()) % n; };
    for (std::size_t i = 0, changes = 1 + below(3); i < changes; ++i) {
        const std::size_t at = below(text.size()), length = below(std::min<std::size_t>(40, text.size() - at));
        switch (below(7)) {
            case 0:
                text.erase(at, length);
                break;
            case 1:
                text.insert(at, fragments[below(std::size(fragments))]);
                break;
            case 2:
                text.replace(at, length, fragments[below(std::size(fragments))]);
                break;
            case 3:
                text[at] = static_cast<char>(random());
                break;
            case 4:
                text.insert(below(text.size()), text.substr(at, length));
                break;
            case 5: {
                const std::size_t digit = text.find_first_of("0123456789", at);
                if (digit != std::string::npos) text[digit] = static_cast<char>('0' + below(10));
                break;
            }
            default:
                text.resize(at + 1);
                break;
        }
    }
    return text;
}

/// A number, name or bracket for another: far more of these are still JSON, and reach the readers behind the parser.
std::string swapped_token(std::mt19937& random) {
    std::vector<std::pair<std::size_t, std::size_t>> tokens;
    for (std::size_t i = 0; i < everything.size();) {
        const std::size_t begin = i;
        if (everything[i] == '"') {
            i = everything.find('"', i + 1) + 1;
        } else if (std::string_view("-0123456789.e").find(everything[i]) != std::string_view::npos) {
            i = everything.find_first_not_of("-0123456789.e", i);
        } else {
            ++i;
            continue;
        }
        tokens.emplace_back(begin, i - begin);
    }
    std::string text = everything;
    for (int change = 0; change < 2; ++change) {
        const auto [to, to_length] = tokens[random() % tokens.size()];
        const auto [from, from_length] = tokens[random() % tokens.size()];
        if (text.size() == everything.size() || to < from) text.replace(to, to_length, everything, from, from_length);
    }
    return text;
}

/// Whether the text was read. Anything but an Error escapes, and fails the test.
bool survives(const std::string& text) {
    try {
        const Scene scene = scene_of(text);
        for (const Diagnostic& finding : validate(scene)) CHECK_FALSE(finding.message.empty());
        CHECK(same_scene(scene, scene_of(json_scene_text(scene))));
        return true;
    } catch (const Error& error) {
        CHECK(error.status() == Status::scene);
        REQUIRE_FALSE(error.diagnostics().empty());
        for (const Diagnostic& finding : error.diagnostics()) {
            CHECK_FALSE(finding.message.empty());
            CHECK(finding.place.file == "scene.json");
            CHECK(finding.place.line > 0);
            CHECK(finding.place.column > 0);
        }
        return false;
    }
}

}  // namespace

TEST_CASE("json fuzz: the text that is changed is sound") {
    CHECK(survives(everything));
    for (const Diagnostic& finding : validate(scene_of(everything))) FAIL_CHECK(format(finding));
}

TEST_CASE("json fuzz: bytes changed, put in, left out") {
    std::mt19937 random(20240607);
    int read = 0;
    constexpr int rounds = test::tries(2000);
    for (int i = 0; i < rounds; ++i) {
        const std::string text = mutated(random);
        INFO(text);
        read += survives(text);
    }
    CHECK(read > rounds / 100);  // some changes only change a number
    CHECK(read < rounds / 2);
}

TEST_CASE("json fuzz: values in each other's places") {
    std::mt19937 random(7);
    int read = 0;
    constexpr int rounds = test::tries(2000);
    for (int i = 0; i < rounds; ++i) {
        const std::string text = swapped_token(random);
        INFO(text);
        read += survives(text);
    }
    CHECK(read > rounds / 20);
    CHECK(read < rounds - rounds / 20);
}

TEST_CASE("json fuzz: cut off at every byte") {
    for (std::size_t length = 0; length < everything.size(); length += 7) {
        INFO(length);
        CHECK_FALSE(survives(everything.substr(0, length)));
    }
}
