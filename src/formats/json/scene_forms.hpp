// Forms of a scene file's parts besides solids. Members that are not in a struct (`nothing`) are read and written by
// hand.
#pragma once

#include <optional>

#include "form/names.hpp"
#include "form/requests.hpp"

namespace csgrt {

/// The rotation of a tree's leaf.
struct Rotation {
    Vec3 axis = {};
    double degrees = 0;
};

namespace form {

inline constexpr Words<10> units{{"nm", "um", "mm", "cm", "m", "km", "in", "ft", "yd", "mi"}};

inline constexpr Words states = words_of(state_names);

constexpr Bounds beam = {0,    180, true,
                         true, "",  "must be an angle from 0 to 180 degrees, between the beam's axis and its edge"};
inline constexpr const char* beam_help = "Degrees between the beam's axis and its edge.";

template <>
inline constexpr auto of<Light> = Form{
    plain("light"),
    required("position", &Light::position, lengths),
    filled("color", &Light::color, color),
    filled("intensity", &Light::intensity, number, not_negative()),
    optional("infinite", &Light::infinite, flag,
             "true: as far away as the sun, in the direction from the origin to the position."),
    optional("angle", &Light::angle, number, beam, beam_help),
    optional("direction", &Light::direction, axis, "Along the beam's axis; [0, 0, -1] if not given."),
};

template <>
inline constexpr auto of<Emission> = Form{
    plain("emission", "What a region of the shader 'light' sends out from the centre of its box."),
    optional("intensity", &Emission::intensity, number, positive(), "In proportion to the brightest light's."),
    optional("fraction", &Emission::fraction, number, not_negative(),
             "Of full brightness, in place of the intensity; 0: not given."),
    optional("angle", &Emission::angle, number, beam, beam_help),
    optional("target", &Emission::target, lengths, "A point on the beam's axis."),
    optional("direction", &Emission::direction, axis, "Along the beam's axis; down if not given."),
    optional("infinite", &Emission::infinite, flag,
             "true: as far away as the sun, in the direction from the origin to the region."),
    optional("visible", &Emission::visible, flag, "false: the region is not drawn."),
    optional("shadows", &Emission::shadows, Whole{0, integer.high}, "Kept for conversion."),
};

template <>
inline constexpr auto of<Finish> = Form{
    plain("material", "A colour, a finish, or both. There is a finish if any key but 'color' is given."),
    optional("color", nothing, color),
    filled("shader", &Finish::shader, text, "BRL-CAD's name of the shader; kept for conversion."),
    optional("specular", &Finish::specular, number, not_negative()),
    optional("diffuse", &Finish::diffuse, number, not_negative()),
    optional("ambient", &Finish::ambient, number, not_negative(), "Scales the scene's ambient light."),
    optional("shine", &Finish::shine, Whole{0, Limits::shine}, "Exponent of the highlight."),
    optional("transmit", &Finish::transmit, number, not_negative(), "Kept for conversion."),
    optional("reflect", &Finish::reflect, number, not_negative(), "Kept for conversion."),
    optional("light", nothing, object<Emission>, "Of the shader 'light'."),
};

template <>
inline constexpr auto of<RegionColor> = Form{
    plain("region_color", "Regions with low <= id <= high have the colour."),
    required("low", &RegionColor::low, integer),
    required("high", &RegionColor::high, integer),
    required("color", &RegionColor::color, color),
};

template <>
inline constexpr auto of<Density> = Form{
    plain("density", "Regions of the material, or at the path, have the density. The later of two counts."),
    optional("material_id", &Density::material_id, integer, "If there is no path."),
    optional("path", &Density::path, text, "As csgrt info shows it, or the beginning of such paths up to a '/'."),
    required("density", &Density::density, number, not_negative(), "g/cm^3"),
    optional("name", &Density::name, text, "Of the material."),
};

template <>
inline constexpr auto of<Look> = Form{
    plain("look", "What the regions at a path have in place of what their combinations say."),
    required("path", &Look::path, name, "As csgrt info shows it, or the beginning of such paths up to a '/'."),
    optional("material", nothing,
             Other{R"({"oneOf": [{"$ref": "#/$defs/name", "description": "A name from 'materials'."},
                 {"$ref": "#/$defs/material"}]})"}),
    optional("state", nothing, states, "Whether pictures show them."),
};

template <>
inline constexpr auto of<Combination> = Form{
    plain("combination"),
    required("tree", nothing,
             Other{R"({"oneOf": [{"type": "null", "description": "The empty set."}, {"$ref": "#/$defs/tree"},
                 {"$ref": "#/$defs/postfix"}]})"}),
    optional("region", &Combination::region, flag, "One piece of material."),
    optional("id", &Combination::region_id, integer),
    optional("air", &Combination::air, integer, "0: solid. Others are kinds of air, left out of pictures."),
    optional("fastgen", &Combination::fastgen, words_of<1>(fastgen_names),
             "A region of FASTGEN: it yields to regions that are none, and a volume to a plate."),
    optional("material_id", &Combination::material_id, integer),
    optional("los", &Combination::los, integer),
    optional("material", nothing,
             Other{R"({"oneOf": [{"$ref": "#/$defs/name", "description": "A name from 'materials'."},
                 {"$ref": "#/$defs/material"}]})"}),
    optional("inherit", nothing, List{Words<2>{{"color", "finish"}}},
             "What overrides the materials of the combinations below."),
};

inline constexpr auto model_units = Form{
    plain(
        "model_units",
        "The units that the model was made in, where the file's numbers stand in others (csgrt convert writes this)."),
    required("name", &Scene::units, text),
    required("millimetres", &Scene::unit_length, number, positive()),
};

template <>
inline constexpr auto of<Scene> = Form{
    plain("scene"),
    required("csgrt", nothing, Other{R"({"const": 1})"}, "Version of the format."),
    optional("$schema", nothing, text, "Where an editor finds this schema; csgrt does not look at it."),
    optional("title", nothing, text),
    optional("units", nothing, units, "Of every length in the file; mm if not given."),
    optional("model_units", nothing, Other{R"({"$ref": "#/$defs/model_units"})"}),
    optional("camera", nothing, object<Camera>),
    optional("lights", &Scene::lights, List{object<Light>}, "None: one light by the eye."),
    optional("ambient", &Scene::ambient, number, not_negative(), "Intensity of the ambient light."),
    optional("background", &Scene::background, color),
    optional("tolerance", &Scene::tolerance, length, not_negative(),
             "Ends of segments closer than this along a ray are one. 0: those on one surface."),
    optional("materials", nothing,
             Other{R"({"type": "object", "additionalProperties": {"$ref": "#/$defs/material"}})"}),
    optional("solids", nothing, Other{R"({"type": "object", "propertyNames": {"$ref": "#/$defs/name"},
                 "additionalProperties": {"$ref": "#/$defs/solid"}})"}),
    optional("combinations", nothing, Other{R"({"type": "object", "propertyNames": {"$ref": "#/$defs/name"},
                 "additionalProperties": {"$ref": "#/$defs/combination"}})"}),
    optional("objects", nothing, List{Other{R"({"oneOf": [{"$ref": "#/$defs/name"}, {"$ref": "#/$defs/placed"}]})"}},
             "What to render, as it stands or placed; every object that no other uses if not given."),
    optional("order", nothing, Other{R"({"type": "array", "items": {"$ref": "#/$defs/name"}, "uniqueItems": true})"},
             "All objects in the order of the regions, if that is not the order of the file."),
    optional("region_colors", &Scene::region_colors, List{object<RegionColor>}),
    optional("densities", &Scene::densities, List{object<Density>}, "What csgrt measure makes masses of."),
    optional("looks", nothing, List{object<Look>}, "Of two that concern one region the later counts."),
};

// ---- Trees ----

template <>
inline constexpr auto of<Rotation> = Form{
    plain("rotation"),
    required("axis", &Rotation::axis, vector, nonzero(), "Through the origin; of any length but 0."),
    required("angle", &Rotation::degrees, number, "Degrees, counterclockwise seen from the tip of the axis."),
};

/// A node of a tree: its kind, and its transform.
constexpr auto node(const char* called, std::string_view key, auto kind, const char* about = "", auto... more) {
    return Form{
        plain(called, about),
        required(key, nothing, kind),
        optional("matrix", nothing, Other{R"({"$ref": "#/$defs/matrix"})"}, "Not together with the three others."),
        optional("translate", nothing, lengths, "Third."),
        optional("rotate", nothing, object<Rotation>, "Second."),
        optional("scale", nothing, Other{R"({"$ref": "#/$defs/scale"})"}, "First."),
        more...,
    };
}
inline constexpr Other one_or_more{R"({"type": "array", "items": {"$ref": "#/$defs/tree"}, "minItems": 1})"},
    two_or_more{R"({"type": "array", "items": {"$ref": "#/$defs/tree"}, "minItems": 2})"},
    one{R"({"oneOf": [{"$ref": "#/$defs/tree"},
        {"type": "array", "items": {"$ref": "#/$defs/tree"}, "minItems": 1, "maxItems": 1}]})"};
inline constexpr auto leaf =
    node("leaf", "object", name, "",
         optional("name", nothing, name,
                  "In paths; that of the object, with a number from its second leaf on, if not given."));
inline constexpr auto placed = node("placed", "object", name, "A top object in another place.");
inline constexpr auto union_ = node("union", "union", one_or_more, "In any of them.");
inline constexpr auto intersection = node("intersection", "intersection", one_or_more, "In all of them.");
inline constexpr auto difference =
    node("difference", "difference", two_or_more, "In the first and in none of the others.");
inline constexpr auto xor_ = node("xor", "xor", one_or_more, "In an odd number of them.");
inline constexpr auto not_ = node("not", "not", one, "Outside of it.");

inline constexpr auto postfix = Form{
    plain("postfix", "A whole tree, operators behind their operands: for trees too deep to nest."),
    required("postfix", nothing,
             Other{R"({"type": "array", "items": {"oneOf": [{"$ref": "#/$defs/name"}, {"$ref": "#/$defs/leaf"},
                 {"$ref": "#/$defs/postfix_operator"}]}, "minItems": 1})"}),
};
inline constexpr auto postfix_operator = Form{
    plain("postfix_operator"),
    required("operator", nothing, words_of<1>(operator_names)),
    required("operands", nothing, Whole{1, integer.high}),
};

}  // namespace form

}  // namespace csgrt
