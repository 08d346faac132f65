// Shader strings in both notations, and what becomes of those that csgrt does not know.
#include "catch.hpp"

#include <algorithm>
#include <string>

#include "formats/brlcad/shader.hpp"
#include "formats/same_scene.hpp"

using namespace csgrt;

namespace {

bool same(const Finish& a, const Finish& b) { return same_attributes({.finish = a}, {.finish = b}); }

}  // namespace

TEST_CASE("shader: defaults of BRL-CAD's Phong model", "[shader]") {
    for (const char* name : {"plastic", "phong", "default"}) {
        CHECK(same(read_finish(name), {.shader = name, .specular = 0.7, .diffuse = 0.3, .shine = 10}));
    }
    CHECK(same(read_finish("mirror"),
               {.shader = "mirror", .specular = 0.6, .diffuse = 0.4, .shine = 4, .reflect = 0.75}));
    CHECK(same(read_finish("glass"),
               {.shader = "glass", .specular = 0.7, .diffuse = 0.3, .shine = 4, .transmit = 0.8, .reflect = 0.1}));
}

TEST_CASE("shader: the same parameters in every notation", "[shader]") {
    for (const Finish& finish : {read_finish("plastic", "sh=5 di=.9 sp=0.1 re=0.2 tr=.25"),
                                 read_finish("plastic", "shine=5.0 diffuse=.9 specular=0.1 reflect=0.2 transmit=.25"),
                                 read_finish("plastic {sh 5 di .9 sp 0.1 re 0.2 tr .25}"),
                                 read_finish("{plastic {sh 5 di .9 sp 0.1 re 0.2 tr .25}}"),
                                 read_finish("plastic sh=5 di=.9 sp=0.1 re=0.2 tr=.25")}) {
        CHECK(same(finish, {.specular = 0.1, .diffuse = 0.9, .shine = 5, .transmit = 0.25, .reflect = 0.2}));
    }
}

TEST_CASE("shader: others keep their name and look like plastic", "[shader]") {
    CHECK(same(read_finish("light", "inten=5000 sh=1"), {.shader = "light", .light = Emission{.intensity = 5000}}));
    CHECK(read_finish("").shader.empty());
}

TEST_CASE("shader: a stack looks like its last Phong shader", "[shader]") {
    CHECK(same(read_finish("stack", "camo o=2 s=100; plastic sp=.1 di=.7; turbump sp=9"),
               {.shader = "stack", .specular = 0.1, .diffuse = 0.7}));
    CHECK(same(read_finish("stack {{glass {tr 0.5 re .1}} {fbmbump {o 4 tr 1 di 5}}}"),
               {.shader = "stack", .shine = 4, .transmit = 0.5, .reflect = 0.1}));
    CHECK(read_finish("stack {{camo {s 5}} {noise {s 1}}}").shine == 10);
}

TEST_CASE("shader: what is malformed is passed over", "[shader]") {
    CHECK(same(read_finish("plastic", "tr-0.2 di=x sp .5 re=nan sh=1e99 {{{{ tr"), {.specular = 0.5, .shine = 10'000}));
    CHECK(read_finish("plastic", "sh=-3").shine == 0);
    const std::string braces(1'000'000, '{');
    CHECK(read_finish("stack " + braces + std::string(1'000'000, '}')).shine == 10);
    CHECK(read_finish("stack " + braces).shine == 10);
}

TEST_CASE("shader light: BRL-CAD's keys and defaults, in both notations") {
    const Finish plain{.shader = "light", .light = Emission{.intensity = 1, .fraction = 0, .angle = 180, .shadows = 1}};
    CHECK(same(read_finish("light"), plain));
    for (const Finish& finish :
         {read_finish("light {b 2.5 f .5 a 30 t {1 -2 3} s 16 i 1 v 0}"),
          read_finish("light", "inten=2.5 fract=.5 angle=30 aim=1,-2,3 shadows=16 infinite=1 invisible=1"),
          read_finish("light bright 2.5 fract 0.5 angle 30 target 1 -2 3 shadows 16 infinite 1 visible 0")}) {
        CHECK(same(finish, {.shader = "light",
                            .light = Emission{.intensity = 2.5,
                                              .fraction = 0.5,
                                              .angle = 30,
                                              .target = Vec3{1, -2, 3},
                                              .infinite = true,
                                              .visible = false,
                                              .shadows = 16}}));
    }
    // aet.g's: an angle beyond a half turn, and a direction.
    const Finish old = read_finish("light {a 270 d  {1 0 0} s 16 v 0}");
    CHECK(old.light->angle == 180);
    CHECK(old.light->direction == Vec3{1, 0, 0});
    // What is no number is passed over, as everywhere.
    CHECK(read_finish("light {b nan a x t {1 2} b -3}").light->intensity == 1);
    CHECK_FALSE(read_finish("plastic {i 1}").light);
}

TEST_CASE("one warning for each shader that is drawn as plastic, with how many have it", "[promise:databases]") {
    Scene scene;
    for (const char* shader :
         {"cloud", "glass tr=.5", "plastic", "cloud {thresh 1}", "light", "light {s 0}", "cloud"}) {
        Combination region{.name = "r" + std::to_string(scene.objects.size()), .finish = read_finish(shader)};
        scene.objects.push_back(region);
    }
    warn_of_shaders(scene);
    REQUIRE(scene.warnings.size() == 3);
    const auto has = [&](const char* object, const char* part, std::uint64_t count) {
        return std::any_of(scene.warnings.begin(), scene.warnings.end(), [&](const Warning& w) {
            return w.object == object && w.reason.find(part) != std::string::npos && w.count == count;
        });
    };
    CHECK(has("r0", "the shader 'cloud' is drawn as plastic", 3));
    CHECK(has("r1", "'glass' is drawn opaque", 1));
    CHECK(has("r4", "casts no shadows", 1));
}
