// Cameras of which only some members are given: these replace members of the scene's view_size, which the eye
// contradicts camera that contradict them.
#pragma once

#include <string>
#include <string_view>
#include <type_traits>

#include "form/requests.hpp"

namespace csgrt {

/// Two members of a camera that exclude each other, and the reason. `in_perspective`: only if the camera is
/// perspective.
struct CameraConflict {
    std::string_view member, other;
    const char* reason;
    bool in_perspective = false;
};
inline constexpr CameraConflict camera_conflicts[] = {
    {"eye", "azimuth", "the eye and what it looks at give the direction"},
    {"eye", "elevation", "the eye and what it looks at give the direction"},
    {"look_at", "center", "they are one point, the middle of the picture"},
    {"view_size", "eye", "the eye and the perspective give the size of the view", true},
};

inline std::string text_of(const CameraConflict& conflict) {
    return std::string(conflict.member) + " cannot be combined with " + std::string(conflict.other) + ": " +
           conflict.reason;
}

/// The first conflict among the members for which is_given(name) is true, or null.
template <class IsGiven>
const CameraConflict* conflict_of(const Camera& given, const IsGiven& is_given) {
    for (const CameraConflict& conflict : camera_conflicts)
        if (is_given(conflict.member) && is_given(conflict.other) &&
            (!conflict.in_perspective || given.perspective > 0))
            return &conflict;
    return nullptr;
}
/// The first conflict among the optional members that have values. Angles always have values, and do not count.
inline const CameraConflict* conflict_of(const Camera& camera) {
    return conflict_of(camera, [&](std::string_view name) {
        bool is_given = false;
        form::for_members(form::of<Camera>, [&](const auto& member) {
            if constexpr (!std::is_same_v<std::remove_cvref_t<decltype(camera.*member.at)>, double>)
                is_given |= member.key.member == name && (camera.*member.at).has_value();
        });
        return is_given;
    });
}

/// `camera`, with the members of `given` for which is_given(name) is true, and without members that contradict them.
template <class IsGiven>
Camera merged(Camera camera, const Camera& given, const IsGiven& is_given) {
    const bool angles = is_given("azimuth") || is_given("elevation");
    if (angles) camera.eye.reset();
    if (angles || is_given("eye")) camera.up.reset();  // then the camera is upright
    if (is_given("center") || is_given("look_at")) {
        camera.center.reset();
        camera.look_at.reset();
    }
    form::for_members(form::of<Camera>, [&](const auto& member) {
        if (is_given(member.key.member)) camera.*member.at = given.*member.at;
    });
    if (camera.eye && camera.perspective > 0 && !is_given("view_size")) camera.view_size.reset();  // the scene's
    return camera;
}

}  // namespace csgrt
