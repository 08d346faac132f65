// Which name a misspelt one was meant to be.
#include "catch.hpp"

#include "scene/nearest.hpp"

using namespace csgrt;

TEST_CASE("nearest: one letter put in, left out, replaced or swapped") {
    const std::vector<std::string_view> known = {"radius", "center", "height"};
    CHECK(did_you_mean("radus", known) == "did you mean 'radius'?");
    CHECK(did_you_mean("raadius", known) == "did you mean 'radius'?");
    CHECK(did_you_mean("ravius", known) == "did you mean 'radius'?");
    CHECK(did_you_mean("raduis", known) == "did you mean 'radius'?");
    CHECK(did_you_mean("Center", known) == "did you mean 'center'?");
}

TEST_CASE("nearest: the closest one, and a start before nothing") {
    CHECK(did_you_mean("ball.x", {"ball", "ball.r"}) == "did you mean 'ball.r'?");
    CHECK(did_you_mean("torus", {"tgc", "tor"}) == "did you mean 'tor'?");
    CHECK(did_you_mean("intersect", {"union", "intersection"}) == "did you mean 'intersection'?");
}

TEST_CASE("nearest: no guess where nothing is close") {
    CHECK(did_you_mean("matrix", {"radius", "center"}).empty());
    CHECK(did_you_mean("x", {"a", "b"}).empty());
    CHECK(did_you_mean("x", {}).empty());
    CHECK(did_you_mean(std::string(1000, 'x'), {std::string_view("xxx")}).empty());
}
