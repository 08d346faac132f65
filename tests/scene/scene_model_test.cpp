// Names and places of objects, and which of them are on top.
#include "catch.hpp"

#include "scene/make_scene.hpp"

using namespace csgrt;

TEST_CASE("scene model: objects are found by name") {
    const Scene scene = make_scene({ball("a"), combination("b", union_of({"a"}))});
    REQUIRE(scene.find("b") != nullptr);
    CHECK(name_of(*scene.find("b")) == "b");
    CHECK(scene.find("c") == nullptr);
}

TEST_CASE("scene model: a shape has BRL-CAD's name", "[promise:shoot]") {
    CHECK(type_name(Shape(Ell{})) == std::string("ell"));
    CHECK(type_name(Shape(Half{})) == std::string("half"));
    CHECK(type_name(Shape(Unsupported{"pipe"})) == std::string("pipe"));
}

TEST_CASE("scene model: what no combination uses is on top, in the order of the file", "[promise:scenes]") {
    Scene scene = make_scene(
        {ball("z"), ball("a"), combination("c", union_of({"a"})), combination("b", union_of({"c", "gone"}))});
    CHECK(top_objects(scene) == std::vector<std::string>{"z", "b"});
    scene.top = {"a"};
    CHECK(top_objects(scene) == std::vector<std::string>{"a"});
}
