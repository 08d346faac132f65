// Shader strings in both notations, and what becomes of those that csgrt does not know.
#include "catch.hpp"

#include <algorithm>
#include <string>

#include "formats/brlcad/shader.hpp"

using namespace csgrt;

TEST_CASE("shader: defaults of BRL-CAD's Phong model", "[shader]") {
    for (const char* name : {"plastic", "phong", "default"}) {
        const Finish finish = read_finish(name);
        CHECK(finish.shader == name);
        CHECK(finish.shine == 10);
        CHECK(finish.specular == 0.7);
        CHECK(finish.diffuse == 0.3);
        CHECK(finish.transmit == 0);
        CHECK(finish.reflect == 0);
    }
    const Finish mirror = read_finish("mirror");
    CHECK(mirror.shine == 4);
    CHECK(mirror.specular == 0.6);
    CHECK(mirror.diffuse == 0.4);
    CHECK(mirror.reflect == 0.75);
    const Finish glass = read_finish("glass");
    CHECK(glass.shine == 4);
    CHECK(glass.specular == 0.7);
    CHECK(glass.diffuse == 0.3);
    CHECK(glass.transmit == 0.8);
    CHECK(glass.reflect == 0.1);
}

TEST_CASE("shader: the same parameters in every notation", "[shader]") {
    const Finish finishes[] = {
        read_finish("plastic", "sh=5 di=.9 sp=0.1 re=0.2 tr=.25"),
        read_finish("plastic", "shine=5.0 diffuse=.9 specular=0.1 reflect=0.2 transmit=.25"),
        read_finish("plastic {sh 5 di .9 sp 0.1 re 0.2 tr .25}"),
        read_finish("{plastic {sh 5 di .9 sp 0.1 re 0.2 tr .25}}"),
        read_finish("plastic sh=5 di=.9 sp=0.1 re=0.2 tr=.25"),
    };
    for (const Finish& finish : finishes) {
        CHECK(finish.shader == "plastic");
        CHECK(finish.shine == 5);
        CHECK(finish.diffuse == 0.9);
        CHECK(finish.specular == 0.1);
        CHECK(finish.reflect == 0.2);
        CHECK(finish.transmit == 0.25);
    }
}

TEST_CASE("shader: others keep their name and look like plastic", "[shader]") {
    const Finish light = read_finish("light", "inten=5000 sh=1");
    CHECK(light.shader == "light");
    CHECK(light.shine == 10);
    CHECK(light.specular == 0.7);
    CHECK(read_finish("").shader.empty());
}

TEST_CASE("shader: a stack looks like its last Phong shader", "[shader]") {
    const Finish old = read_finish("stack", "camo o=2 s=100; plastic sp=.1 di=.7; turbump sp=9");
    CHECK(old.shader == "stack");
    CHECK(old.specular == 0.1);
    CHECK(old.diffuse == 0.7);
    const Finish tcl = read_finish("stack {{glass {tr 0.5 re .1}} {fbmbump {o 4 tr 1 di 5}}}");
    CHECK(tcl.shader == "stack");
    CHECK(tcl.shine == 4);
    CHECK(tcl.transmit == 0.5);
    CHECK(tcl.diffuse == 0.3);
    CHECK(read_finish("stack {{camo {s 5}} {noise {s 1}}}").shine == 10);
}

TEST_CASE("shader: what is malformed is passed over", "[shader]") {
    const Finish finish = read_finish("plastic", "tr-0.2 di=x sp .5 re=nan sh=1e99 {{{{ tr");
    CHECK(finish.transmit == 0);
    CHECK(finish.diffuse == 0.3);
    CHECK(finish.specular == 0.5);
    CHECK(finish.reflect == 0);
    CHECK(finish.shine == 10'000);
    CHECK(read_finish("plastic", "sh=-3").shine == 0);
    const std::string braces(1'000'000, '{');
    CHECK(read_finish("stack " + braces + std::string(1'000'000, '}')).shine == 10);
    CHECK(read_finish("stack " + braces).shine == 10);
}

TEST_CASE("shader light: BRL-CAD's keys and defaults, in both notations") {
    const Finish plain = read_finish("light");
    REQUIRE(plain.light);
    CHECK(plain.light->intensity == 1);
    CHECK(plain.light->fraction == 0);
    CHECK(plain.light->angle == 180);
    CHECK(plain.light->shadows == 1);
    CHECK(plain.light->visible);
    CHECK_FALSE(plain.light->infinite);
    CHECK_FALSE(plain.light->target);
    for (const Finish& finish :
         {read_finish("light {b 2.5 f .5 a 30 t {1 -2 3} s 16 i 1 v 0}"),
          read_finish("light", "inten=2.5 fract=.5 angle=30 aim=1,-2,3 shadows=16 infinite=1 invisible=1"),
          read_finish("light bright 2.5 fract 0.5 angle 30 target 1 -2 3 shadows 16 infinite 1 visible 0")}) {
        REQUIRE(finish.light);
        CHECK(finish.light->intensity == 2.5);
        CHECK(finish.light->fraction == 0.5);
        CHECK(finish.light->angle == 30);
        CHECK(finish.light->target == Vec3{1, -2, 3});
        CHECK(finish.light->shadows == 16);
        CHECK(finish.light->infinite);
        CHECK_FALSE(finish.light->visible);
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
        Combination region;
        region.name = "r" + std::to_string(scene.objects.size());
        region.finish = read_finish(shader);
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
