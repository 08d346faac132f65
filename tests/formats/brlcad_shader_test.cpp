// Shader strings in both notations, and what becomes of those that csgrt does not know.
#include "catch.hpp"
#include "formats/brlcad_shader.hpp"

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
