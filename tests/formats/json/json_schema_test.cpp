// The schema in the tree is the one that is made of the descriptions, and the reader acts on each key of it.
#include "catch.hpp"

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <iterator>

#include <nlohmann/json.hpp>

#include "formats/json/parse_text.hpp"
#include "formats/json/scene_forms.hpp"
#include "formats/json/write/schema.hpp"
#include "formats/json/solids.hpp"
#include "folder.hpp"

using namespace csgrt;
using nlohmann::json;

namespace {

std::string schema_file() {
    const char* scenes = std::getenv("CSGRT_SCENES");
    return scenes == nullptr ? "" : std::string(scenes) + "/csgrt.schema.json";
}

struct Form {
    std::string name;
    std::vector<std::string> keys, required;
};
/// The definitions that are objects, each the form of a struct.
const std::vector<Form>& forms() {
    static const std::vector<Form> all = [] {
        std::vector<Form> found;
        const json schema = json::parse(json_schema_text());
        for (const auto& [name, definition] : schema.at("$defs").items()) {
            if (definition.value("type", "") != "object") continue;
            found.push_back({name, {}, definition.value("required", std::vector<std::string>())});
            for (const auto& [key, value] : definition.at("properties").items()) found.back().keys.push_back(key);
        }
        return found;
    }();
    return all;
}

/// The smallest object of each form that is sound.
const json& sound_example(const std::string& form) {
    static const json examples = json::parse(R"({
        "scene": {"csgrt": 1, "solids": {"s": {"type": "sphere", "center": [0, 0, 0], "radius": 1}}},
        "model_units": {"name": "cubit", "millimetres": 457},
        "camera": {}, "light": {"position": [0, 0, 0]}, "emission": {}, "material": {},
        "look": {"path": "/c/s", "state": "hidden"},
        "region_color": {"low": 0, "high": 1, "color": [0, 0, 0]}, "density": {"density": 7.85},
        "combination": {"tree": "s"},
        "leaf": {"object": "s"}, "placed": {"object": "s"}, "union": {"union": ["s"]},
        "intersection": {"intersection": ["s"]},
        "difference": {"difference": ["s", "s"]}, "xor": {"xor": ["s"]}, "not": {"not": "s"},
        "postfix": {"postfix": ["s"]}, "postfix_operator": {"operator": "not", "operands": 1},
        "rotation": {"axis": [0, 0, 1], "angle": 0}, "plane": {"normal": [0, 0, 1], "distance": 0},
        "sphere": {"type": "sphere", "center": [0, 0, 0], "radius": 1},
        "ell": {"type": "ell", "center": [0, 0, 0], "a": [1, 0, 0], "b": [0, 1, 0], "c": [0, 0, 1]},
        "cylinder": {"type": "cylinder", "base": [0, 0, 0], "height": [0, 0, 1], "radius": 1},
        "cone": {"type": "cone", "base": [0, 0, 0], "height": [0, 0, 1], "radius": 1},
        "tgc": {"type": "tgc", "base": [0, 0, 0], "height": [0, 0, 1], "a": [1, 0, 0], "b": [0, 1, 0], "c": [1, 0, 0],
            "d": [0, 1, 0]},
        "box": {"type": "box", "low": [0, 0, 0], "high": [1, 1, 1]},
        "arb4": {"type": "arb4", "vertices": [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]]},
        "arb5": {"type": "arb5", "vertices": [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [0, 0, 1]]},
        "arb6": {"type": "arb6", "vertices": [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [0, 0, 1], [0, 1, 1]]},
        "arb7": {"type": "arb7",
            "vertices": [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [0, 0, 1], [1, 0, 1], [1, 1, 1]]},
        "arb8": {"type": "arb8",
            "vertices": [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [0, 0, 1], [1, 0, 1], [1, 1, 1], [0, 1, 1]]},
        "arbn": {"type": "arbn", "planes": []},
        "half": {"type": "half", "normal": [0, 0, 1], "distance": 0},
        "tor": {"type": "tor", "center": [0, 0, 0], "axis": [0, 0, 1], "radius": 2, "tube": 1},
        "ehy": {"type": "ehy", "base": [0, 0, 0], "height": [0, 0, 1], "a": [1, 0, 0], "r1": 1, "r2": 1, "c": 1},
        "metaball_point": {"position": [0, 0, 0], "strength": 1}, "pipe_point": {"position": [9, 0, 0], "outer": 1},
        "sketch": {"vertices": [[0, 0]], "curves": []},
        "line": {"line": [0, 1]}, "arc": {"arc": [0, 1], "radius": 2}, "circle": {"circle": [0, 1]},
        "bezier": {"bezier": [0, 1]},
        "nurb": {"nurb": [0, 1], "order": 2, "knots": [0, 0, 1, 1]},
        "part": {"type": "part", "base": [0, 0, 0], "height": [0, 0, 1], "radius": 1, "top_radius": 0},
        "epa": {"type": "epa", "base": [0, 0, 0], "height": [0, 0, 1], "a": [1, 0, 0], "r1": 1, "r2": 1},
        "rpc": {"type": "rpc", "base": [0, 0, 0], "height": [0, 0, 1], "b": [1, 0, 0], "half_width": 1},
        "rhc": {"type": "rhc", "base": [0, 0, 0], "height": [0, 0, 1], "b": [1, 0, 0], "half_width": 1, "c": 1},
        "eto": {"type": "eto", "center": [0, 0, 0], "axis": [0, 0, 1], "radius": 3, "c": [1, 0, 0], "d": 1},
        "hyp": {"type": "hyp", "base": [0, 0, 0], "height": [0, 0, 1], "a": [1, 0, 0], "b": 1, "neck": 0.5},
        "superell": {"type": "superell", "center": [0, 0, 0], "a": [1, 0, 0], "b": [0, 1, 0], "c": [0, 0, 1]},
        "hrt": {"type": "hrt", "center": [0, 0, 0], "x": [1, 0, 0], "y": [0, 1, 0], "z": [0, 0, 1]},
        "metaball": {"type": "metaball", "points": []},
        "pipe": {"type": "pipe", "points": []},
        "cline": {"type": "cline", "base": [0, 0, 0], "height": [0, 0, 1], "radius": 1},
        "bot": {"type": "bot", "vertices": [[0, 0, 0]], "faces": [[0, 0, 0]]},
        "ars": {"type": "ars", "curves": []},
        "nmg": {"type": "nmg", "vertices": [], "faces": [[0, 1, 2]]},
        "ebm": {"type": "ebm", "width": 1, "depth": 1, "height": 1, "cells": "#"},
        "vol": {"type": "vol", "width": 1, "depth": 1, "height": 1, "cell": [1, 1, 1], "low": 1, "cells": ["255"]},
        "dsp": {"type": "dsp", "width": 2, "depth": 1, "heights": "1 2"},
        "extrude": {"type": "extrude", "base": [0, 0, 0], "height": [0, 0, 1],
            "sketch": {"vertices": [], "curves": []}},
        "revolve": {"type": "revolve", "base": [0, 0, 0], "axis": [0, 0, 1], "r": [1, 0, 0],
            "sketch": {"vertices": [], "curves": []}},
        "unsupported": {"type": "unsupported", "was": "grip"}
    })");
    return examples.at(form);
}

/// A whole scene with an object of a form at its place.
std::string scene_with(const std::string& form, const json& object) {
    if (form == "scene") return object.dump();
    json scene = sound_example("scene");
    const auto tree = [&](const json& t) { scene["combinations"]["c"] = {{"tree", t}}; };
    const auto solids = json_solid_types();
    if (form == "model_units" || form == "camera")
        scene[form] = object;
    else if (form == "light")
        scene["lights"] = json::array({object});
    else if (form == "material")
        scene["materials"]["m"] = object;
    else if (form == "emission")
        scene["materials"]["m"] = {{"light", object}};
    else if (form == "region_color")
        scene["region_colors"] = json::array({object});
    else if (form == "density")
        scene["densities"] = json::array({object});
    else if (form == "look")
        scene["looks"] = json::array({object});
    else if (form == "combination")
        scene["combinations"]["c"] = object;
    else if (form == "postfix_operator")
        tree({{"postfix", {"s", object}}});
    else if (form == "placed")
        scene["objects"] = json::array({object});
    else if (form == "rotation")
        tree({{"object", "s"}, {"rotate", object}});
    else if (form == "plane")
        scene["solids"]["t"] = {{"type", "arbn"}, {"planes", json::array({object})}};
    else if (form == "metaball_point" || form == "pipe_point")
        scene["solids"]["t"] = {{"type", form.substr(0, form.find('_'))}, {"points", json::array({object})}};
    else if (form == "sketch")
        scene["solids"]["t"] = {{"type", "extrude"}, {"base", {0, 0, 0}}, {"height", {0, 0, 1}}, {"sketch", object}};
    else if (form == "line" || form == "arc" || form == "circle" || form == "bezier" || form == "nurb")
        return scene_with("sketch", {{"vertices", json::array()}, {"curves", json::array({object})}});
    else if (std::find(solids.begin(), solids.end(), form) != solids.end())
        scene["solids"]["t"] = object;
    else
        tree(object);
    return scene.dump();
}

}  // namespace

TEST_CASE("json schema: the file is what the descriptions make", "[promise:scenes]") {
    if (schema_file().empty()) {
        WARN("CSGRT_SCENES is not set: the schema is not read");
        return;
    }
    INFO("cmake --build build --target schema makes it anew");
    CHECK((test::read_file(schema_file()) == json_schema_text()));
}

TEST_CASE("json schema: made anew", "[.schema]") { std::ofstream(schema_file()) << json_schema_text(); }

TEST_CASE("json schema: refers to definitions that are there, to each of them") {
    const std::string text = json_schema_text();
    const json schema = json::parse(text);
    for (const auto& [name, definition] : schema.at("$defs").items()) {
        INFO(name);
        CHECK(text.find("\"#/$defs/" + name + "\"") != std::string::npos);
    }
    const std::string start = "\"#/$defs/";
    for (std::size_t at = text.find(start); at != std::string::npos; at = text.find(start, at + 1)) {
        const std::size_t name = at + start.size();
        CHECK(schema.at("$defs").contains(text.substr(name, text.find('"', name) - name)));
    }
}

TEST_CASE("json schema: every example of a form is sound", "[promise:scenes]") {
    for (const Form& form : forms()) {
        const auto found = findings_of(scene_with(form.name, sound_example(form.name)));
        INFO(form.name << ": " << (found.empty() ? "" : format(found[0])));
        CHECK(found.empty());
    }
}

TEST_CASE("json schema: the reader looks at every key of every form", "[promise:scenes]") {
    for (const Form& form : forms()) {
        for (const std::string& key : form.keys) {
            if (key == "$schema") continue;  // for editors
            INFO(form.name << "." << key);
            json object = sound_example(form.name);
            object[key] = {{"no key", "expects such a value"}};
            CHECK_FALSE(findings_of(scene_with(form.name, object)).empty());
        }
        for (const std::string& key : form.required) {
            INFO(form.name << " without " << key);
            json object = sound_example(form.name);
            object.erase(key);
            CHECK_FALSE(findings_of(scene_with(form.name, object)).empty());
        }
        json object = sound_example(form.name);
        object["surplus"] = 1;
        CHECK_FALSE(findings_of(scene_with(form.name, object)).empty());
    }
}

TEST_CASE("json schema: every unit is known", "[promise:scenes]") {
    for (const std::string_view unit : form::units.words) {
        CHECK(findings_of(R"({"csgrt": 1, "units": ")" + std::string(unit) +
                          R"(", "combinations": {"c": {"tree": null}}})")
                  .empty());
    }
}
