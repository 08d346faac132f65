// Which meshes and grids of cells enclose something, and what is said of those that do not.
#include "catch.hpp"

#include "scene/faults/check_faults.hpp"

using namespace csgrt;

namespace {

Bot plates() {
    Bot bot = tetrahedron();
    bot.mode = Bot::Mode::plate;
    bot.thickness = {1, 0, 2, 3};
    bot.append = {0, 1, 0, 1};
    return bot;
}

template <class Solid, class Change>
Solid changed(Solid solid, Change change) {
    change(solid);
    return solid;
}

Ars spindle() {
    return {{{{0, 0, 0}, {0, 0, 0}, {0, 0, 0}}, {{1, 0, 1}, {0, 1, 1}, {-1, 0, 1}}, {{0, 0, 2}, {0, 0, 2}, {0, 0, 2}}}};
}

Nmg pyramid() {
    return {{{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {0, 4, 0}, {2, 2, 5}},
            {{{0, 3, 2, 1}}, {{0, 1, 4}}, {{1, 2, 4}}, {{2, 3, 4}}, {{3, 0, 4}}}};
}

}  // namespace

TEST_CASE("solid faults: triangle meshes", "[promise:refusals]") {
    check_sound(tetrahedron());
    check_sound(changed(tetrahedron(), [](Bot& b) { b.faces.pop_back(); }));  // open, and allowed
    check_sound(changed(tetrahedron(), [](Bot& b) { b.mode = Bot::Mode::surface; }));
    check_sound(changed(tetrahedron(), [](Bot& b) { b.faces[0] = {1, 1, 1}; }));
    check_sound(plates());
    check_fault(Bot{}, "no faces");
    check_fault(changed(tetrahedron(), [](Bot& b) { b.faces[2][1] = 4; }), "face 2 uses vertex 4, but there are only");
    check_fault(changed(tetrahedron(), [](Bot& b) { b.vertices.clear(); }), "there are no vertices");
    check_fault(changed(tetrahedron(), [](Bot& b) { b.vertices[3].z = not_a_number; }), "vertex 3 has a number that");
    check_fault(changed(tetrahedron(), [](Bot& b) { b.vertices[3].z = 1e200; }), "vertex 3 lies too far away");
    check_fault(changed(tetrahedron(), [](Bot& b) { b.faces = {{0, 1, 1}, {2, 3, 2}}; }), "none of its faces");
}

TEST_CASE("solid faults: meshes of plates") {
    check_fault(changed(plates(), [](Bot& b) { b.thickness.pop_back(); }), "found 3 and 4");
    check_sound(changed(plates(), [](Bot& b) { b.append.clear(); }));  // half on each side
    check_fault(changed(plates(), [](Bot& b) { b.thickness[1] = -1; }), "the thickness of face 1");
    check_fault(changed(plates(), [](Bot& b) { b.thickness[1] = infinite; }), "the thickness of face 1");
    check_fault(changed(plates(), [](Bot& b) { b.append[3] = 2; }), "the side of face 3");
    check_sound(changed(plates(), [](Bot& b) {
        b.mode = Bot::Mode::volume;
        b.append[3] = 2;  // says nothing there
    }));
}

TEST_CASE("solid faults: waterlines") {
    check_sound(spindle());
    check_sound(changed(spindle(), [](Ars& a) { a.curves.pop_back(); }));  // open, and allowed
    check_fault(changed(spindle(), [](Ars& a) { a.curves.resize(1); }), "fewer than 2 curves");
    check_fault(Ars{}, "fewer than 2 curves");
    check_fault(changed(spindle(), [](Ars& a) { a.curves[0].pop_back(); }), "fewer than 3 points");
    check_fault(changed(spindle(), [](Ars& a) { a.curves[2].pop_back(); }), "curve 2 has 2 points, and curve 0 has 3");
    check_fault(changed(spindle(), [](Ars& a) { a.curves[1][2].x = infinite; }), "curve 1: point 2 has a number");
    check_fault(changed(spindle(), [](Ars& a) { a.curves[1] = a.curves[0]; }), "there is no surface");
}

TEST_CASE("solid faults: polyhedra of loops") {
    check_sound(pyramid());
    check_sound(changed(pyramid(), [](Nmg& n) { n.vertices[2].z = 1; }));  // not flat, and cut into triangles
    check_fault(Nmg{}, "no faces");
    check_fault(changed(pyramid(), [](Nmg& n) { n.faces[3].clear(); }), "face 3 has no outline");
    check_fault(changed(pyramid(), [](Nmg& n) { n.faces[3] = {{2, 3}}; }), "face 3 has a loop of fewer than 3");
    check_sound(changed(pyramid(), [](Nmg& n) { n.faces[3] = {{2, 3, 3}}; }));
    check_fault(changed(pyramid(), [](Nmg& n) { n.faces = {{{2, 3, 3}}}; }), "none of its faces has an area");
    check_fault(changed(pyramid(), [](Nmg& n) { n.faces[3] = {{2, 3, 5}}; }), "face 3 uses vertex 5");
    check_fault(changed(pyramid(), [](Nmg& n) { n.faces[3].push_back({}); }), "face 3 has a loop of fewer than 3");
}

TEST_CASE("solid faults: pictures and volumes", "[promise:refusals]") {
    const Ebm ebm{"", 3, 2, 5, identity, {0, 1, 0, 255, 0, 0}};
    check_sound(ebm);
    check_fault(changed(ebm, [](Ebm& e) { e.cells = {0, 0, 0, 0, 0, 0}; }), "none of its cells is solid");
    check_fault(changed(ebm, [](Ebm& e) { e.cells.pop_back(); }), "3 x 2 are 6 cells, found 5");
    check_fault(changed(ebm, [](Ebm& e) { e.width = 0; }), "must be greater than 0");
    check_fault(changed(ebm, [](Ebm& e) { e.height = 0; }), "the height must be greater than 0");
    check_fault(changed(ebm, [](Ebm& e) { e.matrix[0] = 0; }), "the matrix is singular");
    check_fault(changed(ebm, [](Ebm& e) { e.matrix[15] = 2; }), "must end in the row 0 0 0 1");
    check_fault(changed(ebm, [](Ebm& e) { e.matrix[3] = infinite; }), "the matrix has a number");
    check_sound(changed(ebm, [](Ebm& e) { e.matrix[0] = -1; }));

    const Vol vol{"", 2, 1, 2, 10, 20, {1, 2, 3}, identity, {9, 10, 20, 21}};
    check_sound(vol);
    check_fault(changed(vol, [](Vol& v) { v.low = v.high = 15; }), "none of its cells is solid");
    check_fault(changed(vol, [](Vol& v) { v.low = 21; }), "must not be greater than the highest");
    check_fault(changed(vol, [](Vol& v) { v.cell.y = 0; }), "the sides of a cell");
    check_fault(changed(vol, [](Vol& v) { v.width = v.depth = v.height = UINT32_MAX; }), "cells large; at most");
    check_fault(changed(vol, [](Vol& v) { v.depth = 3; }), "2 x 3 x 2 are 12 cells, found 4");
}

TEST_CASE("solid faults: terrains") {
    const Dsp dsp{"", 3, 2, false, Dsp::Cut::adaptive, identity, {0, 0, 0, 0, 0, 1}};
    check_sound(dsp);
    check_fault(changed(dsp, [](Dsp& d) { d.heights.back() = 0; }), "all of its heights are 0");
    check_fault(changed(dsp, [](Dsp& d) { d.heights.pop_back(); }), "3 x 2 are 6 heights, found 5");
    check_fault(changed(dsp, [](Dsp& d) { d.depth = 1; }), "two heights or more along each side");
    check_fault(changed(dsp, [](Dsp& d) { d.depth = 0; }), "must be greater than 0");
    check_fault(changed(dsp, [](Dsp& d) { d.matrix[10] = 0; }), "the matrix is singular");
}
