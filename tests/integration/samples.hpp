// A solid of every type and form, small and at the origin, for promises that hold for all of them.
#pragma once

#include <string>

#include <csgrt/scene.hpp>

#include "formats/json/parse_text.hpp"

namespace csgrt::test {

struct Sample {
    const char *name, *solid;  ///< the solid as a scene in JSON has it
};

/// Each with its centre, or the middle of its base, at the origin, and numbers that rays on a grid meet exactly.
inline const Sample samples[] = {
    {"ell", R"({"type": "ell", "center": [0, 0, 0], "a": [1, 0, 0], "b": [0, 2, 0], "c": [0, 0, 0.5]})"},
    {"sphere", R"({"type": "sphere", "center": [0, 0, 0], "radius": 1})"},
    {"cylinder", R"({"type": "cylinder", "base": [0, 0, -1], "height": [0, 0, 2], "radius": 1})"},
    {"cone", R"({"type": "cone", "base": [0, 0, 0], "height": [0, 0, 2], "radius": 1, "top_radius": 0})"},
    {"tgc", R"({"type": "tgc", "base": [0, 0, -1], "height": [0, 1, 2], "a": [1, 0, 0], "b": [0, 2, 0],
        "c": [0.5, 0, 0],
        "d": [0, 1.5, 0]})"},
    {"box", R"({"type": "box", "low": [-1, -0.5, -2], "high": [1, 0.5, 2]})"},
    {"arb6", R"({"type": "arb6",
        "vertices": [[-1, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0], [0, -1, 1], [0, 1, 1]]})"},
    {"arbn", R"({"type": "arbn", "planes": [{"normal": [1, 1, 1], "distance": 1}, {"normal": [-1, 1, 1], "distance": 1},
        {"normal": [1, -1, 1], "distance": 1}, {"normal": [1, 1, -1], "distance": 1},
        {"normal": [-1, -1, 1], "distance": 1},
        {"normal": [-1, 1, -1], "distance": 1}, {"normal": [1, -1, -1], "distance": 1},
        {"normal": [-1, -1, -1], "distance": 1}]})"},
    {"half", R"({"type": "half", "normal": [0, 0, 1], "distance": 0})"},
    {"tor", R"({"type": "tor", "center": [0, 0, 0], "axis": [0, 0, 1], "radius": 1.5, "tube": 0.5})"},
    {"horn", R"({"type": "tor", "center": [0, 0, 0], "axis": [0, 0, 1], "radius": 1, "tube": 1})"},
    {"ehy", R"({"type": "ehy", "base": [0, 0, 0], "height": [0, 0, 2], "a": [1, 0, 0], "r1": 2, "r2": 1, "c": 0.5})"},
    {"part", R"({"type": "part", "base": [0, 0, 0], "height": [0, 0, 1], "radius": 1, "top_radius": 0.5})"},
    {"epa", R"({"type": "epa", "base": [0, 0, 0], "height": [0, 0, 2], "a": [1, 0, 0], "r1": 2, "r2": 1})"},
    {"hyp", R"({"type": "hyp", "base": [0, 0, -1], "height": [0, 0, 2], "a": [2, 0, 0], "b": 1, "neck": 0.5})"},
    {"rpc", R"({"type": "rpc", "base": [0, 0, -0.5], "height": [0, 0, 1], "b": [0, 0.5, 0], "half_width": 1})"},
    {"rhc", R"({"type": "rhc", "base": [0, 0, -0.5], "height": [0, 0, 1], "b": [0, 0.5, 0], "half_width": 0.4,
        "c": 0.2})"},
    {"eto", R"({"type": "eto", "center": [0, 0, 0], "axis": [0, 0, 1], "radius": 1.5, "c": [0.25, 0, 0.5],
        "d": 0.25})"},
    {"crossed", R"({"type": "eto", "center": [0, 0, 0], "axis": [0, 0, 1], "radius": 1, "c": [0.9, 0, 0.9],
        "d": 0.8})"},
    {"superell", R"({"type": "superell", "center": [0, 0, 0], "a": [1, 0, 0], "b": [0, 2, 0], "c": [0, 0, 1], "n": 0.5,
        "e": 1.5})"},
    {"hrt", R"({"type": "hrt", "center": [0, 0, 0], "x": [1, 0, 0], "y": [0, 1, 0], "z": [0, 0, 1]})"},
    {"metaball", R"({"type": "metaball", "points": [{"position": [0, -0.5, 0], "strength": 0.5},
        {"position": [0, 0.5, 0], "strength": 0.5}]})"},
    {"blob", R"({"type": "metaball", "method": "blob",
        "points": [{"position": [-0.5, 0, 0], "strength": 1, "softness": 2},
        {"position": [0.5, 0, 0], "strength": 1, "softness": 2}]})"},
    {"pipe", R"({"type": "pipe", "points": [{"position": [0, 0, 0], "outer": 1, "inner": 0.5, "bend": 1},
        {"position": [2, 0, 0], "outer": 1, "inner": 0.5, "bend": 1},
        {"position": [2, 2, 0], "outer": 1, "inner": 0.5, "bend": 1}]})"},
    {"cline", R"({"type": "cline", "base": [0, 0, -1], "height": [0, 0, 2], "radius": 1, "thickness": 0.25})"},
    {"bot", R"({"type": "bot", "vertices": [[1, 0, 0], [-1, 0, 0], [0, 1, 0], [0, -1, 0], [0, 0, 1], [0, 0, -1]],
        "faces": [[0, 2, 4], [2, 1, 4], [1, 3, 4], [3, 0, 4], [2, 0, 5], [1, 2, 5], [3, 1, 5], [0, 3, 5]]})"},
    {"plates", R"({"type": "bot", "mode": "plate",
        "vertices": [[1, 0, 0], [-1, 0, 0], [0, 1, 0], [0, -1, 0], [0, 0, 1]],
        "faces": [[0, 2, 4], [2, 1, 4], [1, 3, 4], [3, 0, 4]], "thickness": 0.25})"},
    {"ars", R"({"type": "ars",
        "curves": [[[0, 0, 0], [0, 0, 0], [0, 0, 0], [0, 0, 0]], [[1, 0, 0.5], [0, 1, 0.5], [-1, 0, 0.5],
        [0, -1, 0.5]], [[0, 0, 1], [0, 0, 1], [0, 0, 1], [0, 0, 1]]]})"},
    {"nmg", R"({"type": "nmg",
        "vertices": [[-1, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0], [-1, -1, 1], [1, -1, 1], [1, 1, 1],
        [-1, 1, 1]], "faces": [[0, 3, 2, 1], [4, 5, 6, 7], [0, 1, 5, 4], [1, 2, 6, 5], [2, 3, 7, 6], [3, 0, 4, 7]]})"},
    {"ebm", R"({"type": "ebm", "width": 4, "depth": 4, "height": 1, "cells": ["####", "#..#", "#.##", "####"],
        "matrix": [1, 0, 0, -2, 0, 1, 0, -2, 0, 0, 1, -0.5, 0, 0, 0, 1]})"},
    {"vol", R"({"type": "vol", "width": 2, "depth": 2, "height": 2, "cell": [1, 1, 1], "low": 1,
        "cells": ["##", "#.", ".#", "##"],
        "matrix": [1, 0, 0, -1, 0, 1, 0, -1, 0, 0, 1, -1, 0, 0, 0, 1]})"},
    {"dsp", R"({"type": "dsp", "width": 3, "depth": 3, "heights": ["1 1 1", "1 2 1", "1 1 1"],
        "matrix": [1, 0, 0, -1, 0, 1, 0, -1, 0, 0, 1, -1, 0, 0, 0, 1]})"},
    {"extrude", R"({"type": "extrude", "base": [0, 0, -1], "height": [0, 0, 2],
        "sketch": {"vertices": [[-1, -1], [1, -1], [1, 1],
        [0, 0.5], [-1, 1], [-1, 0]], "curves": [{"line": [0, 1]}, {"line": [1, 2]}, {"arc": [2, 4], "radius": 2},
        {"bezier": [4, 5, 0]}]}})"},
    {"straight", R"({"type": "extrude", "base": [0, 0, -1], "height": [0, 0, 2],
        "sketch": {"vertices": [[-1, 0], [-0.5, 0], [0.5, 0],
        [1, 0], [1, 1], [0, 1], [-1, 1]], "curves": [{"bezier": [0, 1, 2, 3]}, {"bezier": [3, 4, 5]}, {"line": [5, 6]},
        {"line": [6, 0]}]}})"},
    {"revolve", R"({"type": "revolve", "base": [0, 0, 0], "axis": [0, 0, 1], "r": [1, 0, 0],
        "sketch": {"vertices": [[0, -1], [1, -1],
        [2, 0], [1, 1], [0, 1]], "curves": [{"line": [0, 1]}, {"bezier": [1, 2, 3]}, {"line": [3, 4]}]}})"},
    {"slice", R"({"type": "revolve", "base": [0, 0, 0], "axis": [0, 0, 1], "r": [1, 0, 0], "angle": 90,
        "sketch": {"vertices": [[0.5, -1],
        [1, -1], [1, 1], [0.5, 1]], "curves": [{"line": [0, 1]}, {"line": [1, 2]}, {"arc": [2, 3], "radius": 0.25},
        {"line": [3, 0]}]}})"},
};

/// The samples' solids, and one that keeps a half-space to itself where others stand beside it.
inline Scene scene_of_samples() {
    std::string solids;
    for (const Sample& sample : samples) solids += '"' + std::string(sample.name) + "\": " + sample.solid + ",\n";
    return csgrt::scene_of(R"({"csgrt": 1,
        "solids": {)" + solids +
                           R"("limits": {"type": "box", "low": [-2, -2, -2], "high": [2, 2, 2]}}})");
}

}  // namespace csgrt::test
