// What the tests of csgrt.h share: handles that free themselves, and calls that must not fail.
#pragma once

#include <cstring>

#include <csgrt/csgrt.h>
#include <csgrt/csgrt.hpp>

#include "catch.hpp"

namespace csgrt::test {

template <class Handle, auto free>
struct Owned {
    Handle* handle = nullptr;
    Owned() = default;
    Owned(const Owned&) = delete;
    ~Owned() { free(handle); }
    operator Handle*() const { return handle; }
    Handle** operator&() {  // NOLINT: as C's own pointers are used
        free(handle);
        return &handle;
    }
};
using OwnedScene = Owned<csgrt_scene, csgrt_scene_free>;
using OwnedModel = Owned<csgrt_model, csgrt_model_free>;
using OwnedRenderer = Owned<csgrt_renderer, csgrt_renderer_free>;
using OwnedPartitions = Owned<csgrt_partitions, csgrt_partitions_free>;
using OwnedImage = Owned<csgrt_image, csgrt_image_free>;
using OwnedEdit = Owned<csgrt_edit, csgrt_edit_free>;
using OwnedVerifier = Owned<csgrt_verifier, csgrt_verifier_free>;

#define REQUIRE_OK(call)             \
    do {                             \
        const int status = call;     \
        INFO(csgrt_last_error());    \
        REQUIRE(status == CSGRT_OK); \
    } while (false)

/// Fails, and `words` are in the text.
#define CHECK_REFUSED(call, expected, words)                      \
    do {                                                          \
        CHECK(call == expected);                                  \
        CHECK_THAT(csgrt_last_error(), ContainsSubstring(words)); \
    } while (false)

inline constexpr const char* wheels = R"({"csgrt": 1,
    "solids": {"ball": {"type": "sphere", "center": [0, 0, 0], "radius": 10},
               "box": {"type": "box", "low": [-4, -4, -30], "high": [4, 4, 30]}},
    "combinations": {
        "hub.r": {"region": true, "id": 1, "tree": "ball"},
        "rim.r": {"region": true, "id": 2, "tree": {"difference": ["box", "ball"]}},
        "wheel": {"tree": {"union": ["hub.r", "rim.r"]}},
        "all": {"tree": {"union": ["wheel", {"object": "wheel", "translate": [60, 0, 0]},
                                   {"object": "wheel", "translate": [5, 40, 0]},
                                   {"object": "hub.r", "translate": [5, 0, 0]}]}}}})";

/// The scene of wheels, its model, and a renderer of it.
struct Wheels {
    OwnedScene scene = {};
    OwnedModel model = {};
    OwnedRenderer renderer = {};

    explicit Wheels(const csgrt_settings* settings = nullptr) {
        REQUIRE_OK(csgrt_parse_scene(wheels, std::strlen(wheels), "wheels.json", nullptr, &scene));
        REQUIRE_OK(csgrt_model_create(scene, nullptr, 0, nullptr, &model));
        REQUIRE_OK(csgrt_renderer_create(model, settings, &renderer));
    }
};

/// An empty list of partitions.
struct NewPartitions : OwnedPartitions {
    NewPartitions() { REQUIRE_OK(csgrt_partitions_create(&*this)); }
};
struct NewImage : OwnedImage {
    NewImage() { REQUIRE_OK(csgrt_image_create(&*this)); }
};

}  // namespace csgrt::test
