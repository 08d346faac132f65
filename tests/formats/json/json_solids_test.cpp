// The solids of a scene file: what each key becomes, and what scales with the file's unit.
#include "catch.hpp"

#include <numbers>

#include "formats/json/write/writer.hpp"
#include "formats/json/parse_text.hpp"
#include "formats/same_scene.hpp"
#include "scene/make_scene.hpp"
#include "scene/vector.hpp"

using namespace csgrt;

namespace {

template <class Kind>
Kind read(const std::string& solid) {
    return std::get<Kind>(shape_of(solid, "cm"));
}

/// What a scene with this solid says: the first finding's message.
std::string complaint(const std::string& solid) {
    const auto found = findings_of(R"({"csgrt": 1, "solids": {"s": )" + solid + "}}");
    return found.empty() ? "" : found[0].message + "; " + found[0].suggestion;
}

}  // namespace

TEST_CASE("json solids: each key in its place, lengths in the file's unit, shares and directions not") {
    const std::pair<const char*, Shape> solids[] = {
        {R"("sphere", "center": [1, 2, 3], "radius": 4)", Ell{{10, 20, 30}, {40, 0, 0}, {0, 40, 0}, {0, 0, 40}}},
        {R"("ell", "center": [1, 0, 2], "a": [1, 0, 0], "b": [0, 2, 0], "c": [0, 0, 3])",
         Ell{{10, 0, 20}, {10, 0, 0}, {0, 20, 0}, {0, 0, 30}}},
        {R"("tgc", "base": [1, 0, 0], "height": [0, 0, 2], "a": [3, 0, 0], "b": [0, 4, 0], "c": [5, 0, 0],
             "d": [0, 6, 0])",
         Tgc{{10, 0, 0}, {0, 0, 20}, {30, 0, 0}, {0, 40, 0}, {50, 0, 0}, {0, 60, 0}}},
        {R"("box", "low": [0, 0, 0], "high": [1, 2, 3])",
         Arb{{{{10, 0, 0}, {10, 20, 0}, {10, 20, 30}, {10, 0, 30}, {0, 0, 0}, {0, 20, 0}, {0, 20, 30}, {0, 0, 30}}}}},
        // The distance is along the normal, whatever its length.
        {R"("half", "normal": [0, 0, 5], "distance": 7)", Half{{{0, 0, 1}, 70}}},
        {R"("arbn", "planes": [{"normal": [3, 4, 0], "distance": 1}])", Arbn{{{{0.6, 0.8, 0}, 10}}}},
        {R"("tor", "center": [0, 0, 1], "axis": [0, 0, 9], "radius": 3, "tube": 2)",
         Tor{{0, 0, 10}, {0, 0, 9}, 30, 20}},
        {R"("ehy", "base": [0, 0, 1], "height": [0, 0, 2], "a": [2, 0, 0], "r1": 3, "r2": 4, "c": 5)",
         Ehy{{0, 0, 10}, {0, 0, 20}, {1, 0, 0}, 30, 40, 50}},
        {R"("part", "base": [1, 0, 0], "height": [0, 0, 2], "radius": 3, "top_radius": 4)",
         Part{{10, 0, 0}, {0, 0, 20}, 30, 40}},
        {R"("epa", "base": [1, 0, 0], "height": [0, 0, 2], "a": [3, 0, 0], "r1": 4, "r2": 5)",
         Epa{{10, 0, 0}, {0, 0, 20}, {1, 0, 0}, 40, 50}},
        {R"("rhc", "base": [1, 0, 0], "height": [0, 2, 0], "b": [0, 0, 3], "half_width": 4, "c": 5)",
         Rhc{{10, 0, 0}, {0, 20, 0}, {0, 0, 30}, 40, 50}},
        {R"("eto", "center": [1, 0, 0], "axis": [0, 0, 2], "radius": 9, "c": [0, 0, 3], "d": 4)",
         Eto{{10, 0, 0}, {0, 0, 2}, {0, 0, 30}, 90, 40}},
        {R"("hyp", "base": [0, 0, 0], "height": [0, 0, 2], "a": [3, 0, 0], "b": 4, "neck": 0.5)",
         Hyp{{0, 0, 0}, {0, 0, 20}, {30, 0, 0}, 40, 0.5}},
        {R"("superell", "center": [0, 0, 0], "a": [1, 0, 0], "b": [0, 1, 0], "c": [0, 0, 1], "n": 0.5)",
         Superell{{0, 0, 0}, {10, 0, 0}, {0, 10, 0}, {0, 0, 10}, 0.5, 1}},
        {R"("metaball", "method": "blob", "threshold": 2, "points": [{"position": [1, 0, 0], "strength": 3}])",
         Metaball{Metaball::Method::blob, 2, {{{10, 0, 0}, 30, 1}}}},
        {R"("pipe", "points": [{"position": [1, 0, 0], "outer": 4, "inner": 2, "bend": 3},
             {"position": [2, 0, 0], "outer": 4}])",
         Pipe{{{{10, 0, 0}, 40, 20, 30}, {{20, 0, 0}, 40, 0, 0}}}},
        {R"("unsupported", "was": "pipe")", Unsupported{"pipe"}},
    };
    for (const auto& [text, expected] : solids) {
        const Shape found = shape_of(std::string(R"({"type": )") + text + "}", "cm");
        INFO(text << " is\n" << json_scene_text(make_scene({solid("s", found)})));
        CHECK(same_shape(found, expected));
    }
}

TEST_CASE("json solids: a mesh's thickness is one number, or one a face", "[promise:scenes]") {
    const std::string mesh = R"("vertices": [[0, 0, 0], [1, 0, 0], [0, 1, 0]], "faces": [[0, 1, 2], [2, 1, 0]])";
    const Bot volume = read<Bot>(R"({"type": "bot", )" + mesh + "}");
    CHECK(volume.mode == Bot::Mode::volume);
    CHECK(volume.vertices.at(1) == Vec3{10, 0, 0});
    CHECK(volume.faces.at(1) == std::array<std::uint32_t, 3>{2, 1, 0});
    CHECK(volume.append.empty());
    const Bot plate = read<Bot>(R"({"type": "bot", "mode": "plate", "thickness": 2, )" + mesh + "}");
    CHECK(plate.thickness == std::vector<double>{20, 20});
    CHECK(plate.append.empty());
    CHECK(read<Bot>(R"({"type": "bot", "mode": "plate", "append": 1, )" + mesh + "}").append ==
          std::vector<std::uint8_t>{1, 1});
    const Bot plates =
        read<Bot>(R"({"type": "bot", "mode": "plate_nocos", "thickness": [1, 2], "append": [0, 1], )" + mesh + "}");
    CHECK(plates.thickness == std::vector<double>{10, 20});
    CHECK(plates.append == std::vector<std::uint8_t>{0, 1});
    CHECK(test::says(complaint(R"({"type": "bot", "mode": "plates", )" + mesh + "}"), "did you mean 'plate'?"));
    CHECK(test::says(complaint(R"({"type": "bot", "vertices": [[0, 0, true]], "faces": []})"),
                     "expected a number, found true"));
    CHECK(test::says(complaint(R"({"type": "bot", "vertices": [], "faces": [[0, 1, -1]]})"),
                     "must be from 0 to 4294967295"));
    CHECK(
        test::says(complaint(R"({"type": "bot", "vertices": [], "faces": [[0, 1, 0.5]]})"), "expected a whole number"));
}

TEST_CASE("json solids: a face is a loop, or several") {
    const Nmg nmg = read<Nmg>(
        R"({"type": "nmg", "vertices": [[1, 2, 3]], "faces": [[0, 1, 2], [[0, 1, 2, 3], [4, 5, 6]], [], [[]]]})");
    CHECK(nmg.vertices.at(0) == Vec3{10, 20, 30});
    CHECK(nmg.faces == std::vector<std::vector<Nmg::Loop>>{{{0, 1, 2}}, {{0, 1, 2, 3}, {4, 5, 6}}, {}, {{}}});
}

TEST_CASE("json solids: cells are marks or numbers, in rows or not", "[promise:scenes]") {
    const auto ebm = [](const std::string& cells) {
        return read<Ebm>(R"({"type": "ebm", "width": 3, "depth": 2, "height": 4, "cells": )" + cells + "}");
    };
    const std::vector<std::uint8_t> expected = {255, 0, 7, 0, 0, 255};
    CHECK(ebm(R"(["#.7", "..#"])").cells == expected);
    CHECK(ebm(R"("#.7..#")").cells == expected);
    CHECK(ebm(R"(["255 0 7", "0 0 255"])").cells == expected);
    CHECK(ebm(R"(["", " # . 7 0  .#", ""])").cells == expected);
    CHECK(ebm("[]").cells.empty());
    CHECK(ebm("[]").height == 40);
    const std::string head = R"({"type": "ebm", "width": 1, "depth": 1, "height": 1, "cells": )";
    CHECK(test::says(complaint(head + R"("256"})"), "character 1 begins no cell: expected numbers from 0 to 255"));
    CHECK(test::says(complaint(head + R"(["1", "12 -1"]})"), "character 4 begins no cell"));
    CHECK(test::says(complaint(head + R"("99999999999999999999999"})"), "character 1 begins no cell"));
    CHECK(test::says(complaint(head + R"([1]})"), "expected a string, found a number"));
    CHECK(test::says(complaint(head + "7}"), "expected an array, found a number"));
    const Dsp dsp =
        read<Dsp>(R"({"type": "dsp", "width": 2, "depth": 2, "heights": ["0 65535", "1 2"], "cut": "upper_left"})");
    CHECK(dsp.heights == std::vector<std::uint16_t>{0, 65535, 1, 2});
    CHECK(dsp.cut == Dsp::Cut::upper_left);
    CHECK(test::says(complaint(R"({"type": "dsp", "width": 2, "depth": 2, "heights": "#"})"), "from 0 to 65535"));
}

TEST_CASE("json solids: matrices of cells", "[promise:scenes]") {
    const std::string matrix = R"("matrix": [2, 0, 0, 5, 0, 3, 0, 6, 0, 0, 4, 7, 0, 0, 0, 1]})";
    // Cells become lengths, and so do steps of height; lengths stay what they are.
    const Matrix counts = {20, 0, 0, 50, 0, 30, 0, 60, 0, 0, 40, 70, 0, 0, 0, 1};
    const Matrix layers = {20, 0, 0, 50, 0, 30, 0, 60, 0, 0, 4, 70, 0, 0, 0, 1};
    const Matrix lengths = {2, 0, 0, 50, 0, 3, 0, 60, 0, 0, 4, 70, 0, 0, 0, 1};
    const std::string ebm = R"({"type": "ebm", "width": 1, "depth": 1, "height": 1, "cells": "#")";
    const std::string vol =
        R"({"type": "vol", "width": 1, "depth": 1, "height": 1, "cell": [1, 2, 3], "low": 1, "cells": "#")";
    const std::string dsp = R"({"type": "dsp", "width": 2, "depth": 2, "heights": "1 2 3 4")";
    CHECK(read<Ebm>(ebm + ", " + matrix).matrix == layers);
    CHECK(read<Vol>(vol + ", " + matrix).matrix == lengths);
    CHECK(read<Vol>(vol + ", " + matrix).cell == Vec3{10, 20, 30});
    CHECK(read<Dsp>(dsp + ", " + matrix).matrix == counts);
    // Not given: a cell is as long as the unit.
    CHECK(read<Ebm>(ebm + "}").matrix == Matrix{10, 0, 0, 0, 0, 10, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1});
    CHECK(read<Vol>(vol + "}").matrix == identity);
    CHECK(read<Dsp>(dsp + "}").matrix == Matrix{10, 0, 0, 0, 0, 10, 0, 0, 0, 0, 10, 0, 0, 0, 0, 1});
}

TEST_CASE("json solids: sketches", "[promise:scenes]") {
    const Shape extrude = read<Extrude>(R"({"type": "extrude", "base": [1, 0, 0], "height": [0, 0, 2], "b": [0, 2, 0],
        "sketch": {"vertices": [[1, 2], [3, 4], [5, 6]],
            "curves": [{"line": [0, 1]}, {"circle": [0, 1], "reversed": true},
        {"arc": [1, 2], "radius": 3, "clockwise": true}, {"arc": [1, 2], "radius": -1, "center_left": true},
        {"bezier": [0, 2, 1]},
        {"nurb": [0, 1], "order": 2, "knots": [0, 0, 1, 1], "weights": [1, 2]}]}})");
    const Sketch sketch{
        "",
        {{10, 20}, {30, 40}, {50, 60}},
        {Sketch::Line{0, 1}, Sketch::Arc{1, 0, -1, false, false}, Sketch::Arc{1, 2, 30, false, true},
         Sketch::Arc{1, 2, -10, true, false}, Sketch::Bezier{{0, 2, 1}}, Sketch::Nurb{2, {0, 0, 1, 1}, {0, 1}, {1, 2}}},
        {0, 1, 0, 0, 0, 0}};
    CHECK(same_shape(extrude, Extrude{{10, 0, 0}, {0, 0, 20}, {1, 0, 0}, {0, 2, 0}, sketch}));
    const std::string head =
        R"({"type": "extrude", "base": [0, 0, 0], "height": [0, 0, 1], "sketch": {"vertices": [], "curves": [)";
    CHECK(test::says(complaint(head + R"({"line": [0, 1, 2]}]}})"), "expected 2 indices of vertices, found 3"));
    CHECK(test::says(complaint(head + R"({"lines": [0, 1]}]}})"), "none of the keys that name one"));
    CHECK(test::says(complaint(head + R"([0, 1]]}})"), "expected a curve, found an array"));
    CHECK(test::says(complaint(head + R"({"line": [0, 1], "arc": [1, 2]}]}})"), "unknown key 'arc'"));
}

TEST_CASE("json solids: angles are degrees where those give the bits") {
    const std::string head = R"({"type": "revolve", "base": [0, 0, 0], "axis": [0, 0, 1], "r": [1, 0, 0], )";
    const std::string sketch = R"("sketch": {"vertices": [], "curves": []}})";
    CHECK(read<Revolve>(head + sketch).angle == 2 * std::numbers::pi);
    CHECK(read<Revolve>(head + R"("angle": 90, )" + sketch).angle == std::numbers::pi / 2);
    CHECK(read<Revolve>(head + R"("radians": 1.5, )" + sketch).angle == 1.5);
    CHECK(test::says(complaint(head + R"("radians": 1.5, "angle": 90, )" + sketch), "not both"));
    const auto text = [](double angle) {
        Revolve revolve{.angle = angle};
        return json_scene_text(make_scene({solid("s", revolve)}));
    };
    CHECK(test::says(text(2 * std::numbers::pi), "\"angle\": 360"));
    CHECK(test::says(text(2.2689280275926285), "\"angle\": 130"));
}
