// The functions of csgrt.h share this code: failures, arguments, and structs that grow from version to version.
#pragma once

#include <cstring>
#include <optional>
#include <span>
#include <string>
#include <type_traits>
#include <unordered_set>
#include <utility>
#include <vector>

#include <csgrt/csgrt.h>
#include <csgrt/csgrt.hpp>

// ---- The handles ----
struct csgrt_scene {
    csgrt::Scene scene = {};
    std::unordered_set<std::string> names = {};  ///< of the objects; the first call that adds an object fills it
};
struct csgrt_model {
    csgrt::Model model;
};
struct csgrt_partitions {
    csgrt::Partitions own = {};
    const csgrt::Partitions* shown = &own;  ///< for a batch, the renderer's own arrays
};
struct csgrt_image {
    csgrt::Framebuffer frame = {};
};
struct csgrt_renderer {
    csgrt::Renderer renderer;
    // Answers, before they are copied into the caller's memory.
    csgrt::Hits hits = {};
    csgrt::Array<std::uint8_t> flags = {};
    csgrt::Array<std::int32_t> ids = {};
};
struct csgrt_edit {
    csgrt::Edit edit;
};

namespace csgrt::c {

/// Keeps the exception that is being handled for csgrt_last_error().
csgrt_status keep_failure() noexcept;
/// A call of csgrt.h: no exception leaves it.
template <class Body>
csgrt_status call(Body body) noexcept {
    try {
        body();
        return CSGRT_OK;
    } catch (...) {
        return keep_failure();
    }
}

[[noreturn]] void refuse(const std::string& message, std::string suggestion = {});

/// The object of a pointer. Throws if the pointer is NULL.
#define CSGRT_NEED(argument) csgrt::c::needed(argument, #argument)
template <class T>
T& needed(T* argument, const char* name) {
    if (!argument) refuse(std::string(name) + " is NULL");
    return *argument;
}
/// An array of `count` elements. Throws if the pointer is NULL and `count` is not 0.
template <class T>
std::span<T> needed(T* first, std::size_t count, const char* name) {
    if (count > 0) needed(first, name);
    return {first, count};
}
inline const char* text_or_empty(const char* text) { return text ? text : ""; }
std::vector<std::string> texts(const char* const* first, std::size_t count, const char* name);

/// The size of the caller's struct. Throws unless it can be a version's size: earlier versions lack the last members.
template <class T>
std::size_t known_size(const T& given, const char* name) {
    if (given.size < sizeof(std::size_t) || given.size > sizeof(T) || given.size % alignof(T) != 0) {
        refuse(
            std::string(name) + "->size is " + std::to_string(given.size) + ", expected " + std::to_string(sizeof(T)),
            "begin with the struct's defaults in csgrt.h, CSGRT_VIEW for csgrt_view; the library is version " +
                std::string(version()));
    }
    return given.size;
}
/// The caller's struct. Members that the caller's version lacks have the defaults.
template <class T>
T read(const T* given, T defaults, const char* name) {
    std::memcpy(&defaults, given, known_size(needed(given, name), name));
    return defaults;
}
/// Fills the caller's struct with the members that the caller's version has.
template <class T>
void fill(T* wanted, T values, const char* name) {
    values.size = known_size(needed(wanted, name), name);
    std::memcpy(wanted, &values, values.size);
}

template <class List>
const auto& item(const List& list, std::size_t index) {
    if (index >= list.size()) {
        refuse("the index " + std::to_string(index) + " is too large: there are " + std::to_string(list.size()));
    }
    return list[index];
}

/// A call that makes a handle of the result of `body`. If it fails, the handle is NULL.
template <class Handle, class Body>
csgrt_status make(Handle** handle, Body body) noexcept {
    return call([&] {
        needed(handle, "the pointer to where the new handle goes") = nullptr;
        *handle = new Handle{body()};
    });
}

/// An enum class's value by its number, 0 to `last`.
template <class Enum>
Enum choice(int value, Enum last, const char* name) {
    if (value < 0 || value > static_cast<int>(last)) {
        refuse(std::string(name) + " is " + std::to_string(value) + ", expected 0 to " +
               std::to_string(static_cast<int>(last)));
    }
    return static_cast<Enum>(value);
}

// ---- Records of the same layout ----

template <class To, class From>
To* same_layout(From* from) {
    static_assert(sizeof(To) == sizeof(From) && alignof(To) == alignof(From) && std::is_standard_layout_v<To>);
    return reinterpret_cast<To*>(from);
}
inline Vec3 of(const csgrt_vec3& v) { return {v.x, v.y, v.z}; }
inline csgrt_vec3 of(const Vec3& v) { return {v.x, v.y, v.z}; }
inline csgrt_box of(const Box& box) { return {of(box.low), of(box.high)}; }
inline Box of(const csgrt_box& box) { return {of(box.low), of(box.high)}; }
inline csgrt_ray of(const Ray& ray) { return {of(ray.origin), of(ray.direction)}; }
inline csgrt_estimate of(const Estimate& e) { return {e.value, e.half_width}; }
inline std::optional<Vec3> of(const csgrt_vec3* v) { return v ? std::optional(of(*v)) : std::nullopt; }
inline const csgrt_vec3* of(const std::optional<Vec3>& v) { return v ? same_layout<const csgrt_vec3>(&*v) : nullptr; }

// ---- Structs ----

Settings settings_of(const csgrt_settings* settings);
Camera camera_of(const csgrt_camera* camera);
Finish finish_of(const csgrt_finish* finish);
std::vector<Light> lights_of(const csgrt_light* lights, std::size_t count);
View view_of(const csgrt_view* view);
Matrix matrix_of(const double* matrix);
csgrt_diagnostic diagnostic_of(const Warning& warning);

}  // namespace csgrt::c
