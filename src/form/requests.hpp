// Descriptions of the public structs that callers fill. Each sentence is in the C++ header, too
// (tests/form/requests_test.cpp compares them). The lines have the order of C's members, so new lines come last.
#pragma once

#include <csgrt/scene_io.hpp>
#include <csgrt/settings.hpp>
#include <csgrt/view.hpp>

#include <string>

#include "form/names.hpp"

namespace csgrt::form {

template <>
inline constexpr auto of<LoadOptions> = Form{
    plain("load_options"),
    optional("strict", &LoadOptions::strict, flag,
             "A BRL-CAD database in which anything is missing or broken is refused, as a .json always is.",
             {.concern = Concern::model, .name = "--strict", .absent = "what is broken is left out, with a warning,"}),
    optional("file_folders", &LoadOptions::file_folders, texts,
             "Folders below which the scene may name files (the cells of an ebm, vol or dsp), besides its own.",
             {.concern = Concern::model, .name = "--allow-files", .value = "FOLDER"}),
};

template <>
inline constexpr auto of<Settings> = Form{
    plain("settings"),
    optional("device", &Settings::device, text,
             "Which device: its number in the list of devices, its type (\"cpu\", \"gpu\"), or part of its name or "
             "platform; several with commas between them, or all \"gpus\", share the work.",
             {.concern = Concern::work,
              .name = "--device",
              .value = "NAME|cpu|gpu|N|gpus",
              .absent = "a GPU if there is one, else this processor,",
              .excludes = "--reference",
              .changes_answers = false}),
    optional("reference", &Settings::reference, flag, "The CPU reference computes, not a device.",
             {.concern = Concern::work, .name = "--reference", .changes_answers = false}),
    optional(
        "wait_for_device", &Settings::wait_for_device, flag,
        "Calls wait until a GPU's kernels are compiled; else this processor computes until then, with the same bits.",
        {.concern = Concern::either, .name = "--wait-for-device", .excludes = "--reference", .changes_answers = false}),
    optional("device_timeout", &Settings::device_timeout, number, not_negative(),
             "Seconds that a device may take for an answer before it is given up; 0: no limit.",
             {.concern = Concern::work,
              .name = "--device-timeout",
              .value = "S",
              .absent = "60 for a GPU and no limit for a processor",
              .expected = "a number of seconds, 0 or more",
              .excludes = "--reference",
              .changes_answers = false}),
    optional("max_memory", &Settings::max_memory, bytes,
             "Bytes of memory to use on each device; a frame that needs more is drawn in batches.",
             {.concern = Concern::work,
              .name = "--max-memory",
              .value = "SIZE",
              .absent = "what the device has",
              .expected = "a number of bytes such as 800000, 512M or 2G",
              .changes_answers = false}),
    optional(
        "max_instances", &Settings::max_instances, Amount{1, Limits::most_instances},
        "The largest number of instances: a solid that the trees use n times counts n times. They are counted before "
        "any is made.",
        {.concern = Concern::model, .name = "--max-instances", .value = "N", .absent = "what docs/limits.md says"}),
    optional("precision", &Settings::precision, Named{&every_precision, &precision_names},
             "Number type of the geometry; single precision is relative to the eye.",
             {.concern = Concern::work, .name = "--precision", .absent = "double"}),
    optional("tolerance_rule", &Settings::tolerance_rule, Named{&every_tolerance, &tolerance_names},
             "The rule by which boundaries of segments along a ray count as one point.", {.concern = Concern::work}),
    optional("tolerance", &Settings::tolerance, number,
             "Millimetres along a ray, if tolerance_rule is a length; negative: the scene's.",
             {.concern = Concern::work}),
    optional("air", &Settings::air, flag, "Regions of air are part of the model.",
             {.concern = Concern::model, .name = "--air"}),
    optional("skip_unsupported", &Settings::skip_unsupported, flag,
             "Solids of types that csgrt does not know are left out, with a warning, as they always are in a BRL-CAD "
             "database that is not read strictly.",
             {.concern = Concern::model, .name = "--skip-unsupported"}),
    optional("display_shading", &Settings::display_shading, flag,
             "The model's colours are shaded as they are, as BRL-CAD does; else they are decoded from sRGB to linear "
             "light first.",
             {.concern = Concern::picture, .name = "--display-shading"}),
    optional("check", &Settings::check, Amount{1, std::numeric_limits<unsigned>::max()},
             "The CPU reference traces the first batch of rays and every N-th after it as well, and a call whose bits "
             "differ fails.",
             {.concern = Concern::either,
              .name = "--check",
              .value = "N",
              .absent = "none",
              .excludes = "--reference",
              .changes_answers = false}),
    optional("threads", &Settings::threads, Amount{1, 4096},
             "Threads that work on processors at a time, for all calls together.",
             {.concern = Concern::work,
              .name = "--threads",
              .value = "N",
              .absent = "one for each processor",
              .changes_answers = false}),
    optional("progress", &Settings::progress, special,
             "A function that is called with the done fraction, and ends the call if it returns false."),
};

template <>
inline constexpr auto of<Camera> = Form{
    plain("camera"),
    optional("azimuth", &Camera::azimuth, number,
             "Degrees of the direction from the model to the eye: from +x about z.",
             {.name = "--azimuth", .value = "DEG", .absent = "the scene's, or 35,", .expected = "an angle in degrees"}),
    optional(
        "elevation", &Camera::elevation, number, "Degrees of the same direction above the xy plane.",
        {.name = "--elevation", .value = "DEG", .absent = "the scene's, or 25,", .expected = "an angle in degrees"}),
    optional("perspective", &Camera::perspective, number,
             Bounds{0, 180, true, false, "", "must be 0 (parallel), or an angle below 180 degrees"},
             "Degrees of the angle of view across the picture's height, below 180; 0: parallel.",
             {.name = "--perspective",
              .value = "DEG",
              .absent = "the scene's, or 0,",
              .expected = "an angle in degrees, from 0 to less than 180"}),
    optional("center", &Camera::center, lengths,
             "The middle of the picture; the middle of the model's box if not given.",
             {.name = "--center", .value = "X,Y,Z"}),
    optional(Key{"size", "", "view_size"}, &Camera::view_size, length, positive(),
             "Height of the view at the middle of the picture; the diagonal of the model's box if not given. A "
             "parallel view, however small, shows everything before its plane.",
             {.name = "--view-size", .value = "MM", .expected = "a length in millimetres, greater than 0"}),
    optional(
        "eye", &Camera::eye, lengths,
        "The position of the eye, in place of azimuth and elevation, which have no effect then. With a perspective the "
        "eye gives the size of the view, too; a parallel view takes only its direction from the eye.",
        {.name = "--eye", .value = "X,Y,Z"}),
    optional("look_at", &Camera::look_at, lengths, "Another name of the picture's middle.",
             {.name = "--look-at", .value = "X,Y,Z"}),
    optional("up", &Camera::up, axis,
             "The direction that points up in the picture; +z if not given, or in a view straight down or up the "
             "direction that azimuth 0 has.",
             {.name = "--up", .value = "X,Y,Z", .expected = "a direction"}),
};

template <>
inline constexpr auto of<View> = Form{
    plain("view"),
    optional("width", &View::width, Whole{1, 32768}, "Pixels."),
    optional("height", &View::height, Whole{1, 32768}, "Pixels."),
    optional("camera", &View::camera, object<Camera>),
    optional("every_partition", &View::every_partition, flag,
             "Everything along each ray is computed; else first hits alone, several times faster, without the channels "
             "depth, partitions and overlap.",
             {.name = "--first-hit", .is_off = true}),
    optional("channels", &View::channels, special, "The groups of channels that the picture has, a bit each."),
    optional("clip", &View::clip, planes, "Up to six planes, which cut away everything beyond them.",
             {.name = "--clip", .value = "AXIS:OFFSET"}),
    optional("part", &View::part, special, "The only pixels that are drawn, each as in the whole picture."),
    optional("samples", &View::samples, Whole{1, 256}, "Rays a pixel; the colours are their mean.",
             {.name = "--samples", .value = "N", .absent = "1"}),
    optional("transparent", &View::transparent, flag,
             "No background: red, green, blue and alpha are 0 where a ray hits nothing.", {.name = "--transparent"}),
    optional("edges", &View::edges, flag,
             "Black lines where the region, the surface's direction or its depth changes from pixel to pixel.",
             {.name = "--edges"}),
    optional("light", &View::light, Named{&lighting_names}, "Where light comes from.",
             {.name = "--light", .absent = "model"}),
};

/// A member's sentence, with its bounds and with the meaning of the number that stands for "not given".
template <class Member, class Value>
std::string whole_sentence(const Member& member, const Value& usual) {
    std::string sentence = member.help;
    using Kind = std::remove_cvref_t<decltype(member.kind)>;
    std::string bounds;
    if constexpr (std::is_same_v<Kind, Whole> || std::is_same_v<Kind, Amount>) {
        const bool has_end = static_cast<std::uint64_t>(member.kind.high) < static_cast<std::uint64_t>(integer.high);
        if (member.kind.low > 0 && has_end)
            bounds = std::to_string(member.kind.low) + " to " + std::to_string(member.kind.high);
    }
    constexpr bool is_number = std::is_arithmetic_v<Value> && !std::is_same_v<Value, bool>;
    if constexpr (is_number || std::is_same_v<Value, std::array<std::uint32_t, 3>>) {
        if (*member.option.absent && usual <= Value{} && member.option.concern != Concern::picture)
            bounds +=
                (bounds.empty() ? "" : "; ") + std::string(usual < Value{} ? "-1: " : "0: ") + member.option.absent;
    }
    if (!bounds.empty()) sentence += " " + bounds + ".";
    return sentence;
}

}  // namespace csgrt::form
