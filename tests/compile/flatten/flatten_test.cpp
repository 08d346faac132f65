// What of a hierarchy becomes a region, with which tree, attributes and solids.
#include <map>

#include "catch.hpp"
#include "compile/flatten/flatten.hpp"
#include "compile/model.hpp"
#include "scene/faults/validate.hpp"

using namespace csgrt;
using namespace csgrt::test;

namespace {

/// A tree as text: names of solids, operators as + - u ^ ! in postfix order with the arity if it is not 2 (1 for !).
std::string text_of(const Scene& scene, const FlatScene& flat, const FlatTree& tree) {
    static const std::map<Operator, std::string> signs = {{Operator::union_, "u"},
                                                          {Operator::intersection, "+"},
                                                          {Operator::difference, "-"},
                                                          {Operator::xor_, "^"},
                                                          {Operator::not_, "!"}};
    std::string text;
    for (const FlatTree::Node& node : tree.nodes) {
        if (!text.empty()) text += ' ';
        if (node.op == Operator::leaf) {
            text += name_of(scene.objects[flat.instances[node.solid].object]);
        } else {
            text += signs.at(node.op);
            if (node.arity > 2) text += std::to_string(node.arity);
        }
    }
    return text;
}

/// "path: tree" of each region.
std::vector<std::string> regions_of(const Scene& scene, const std::vector<std::string>& objects = {},
                                    bool air = false) {
    const FlatScene flat = flatten(scene, objects.empty() ? top_objects(scene) : objects, air);
    std::vector<std::string> lines;
    for (const FlatRegion& r : flat.regions) lines.push_back(r.info.path + ": " + text_of(scene, flat, r.tree));
    return lines;
}

using Lines = std::vector<std::string>;

// Balls a to f, and regions A to F of one each.
Scene alphabet(std::initializer_list<Object> more) {
    Scene s;
    for (const char letter : {'a', 'b', 'c', 'd', 'e', 'f'}) {
        const std::string name(1, letter), upper(1, static_cast<char>(letter - 'a' + 'A'));
        s.objects.emplace_back(ball(name));
        s.objects.emplace_back(region(upper, {leg(name)}));
    }
    s.objects.insert(s.objects.end(), more.begin(), more.end());
    return s;
}

Lines terms(std::vector<TreeNode> nodes) { return regions_of(alphabet({group("top", std::move(nodes))}), {"top"}); }

}  // namespace

TEST_CASE("a region ends the search: regions below it are part of its tree", "[promise:scenes]") {
    const Scene s =
        alphabet({region("outer", {leg("A"), leg("B"), less}), group("all", {leg("outer"), leg("C"), either})});
    CHECK(regions_of(s, {"all"}) == Lines{"/all/outer: a b -", "/all/C: c"});
    CHECK(regions_of(s, {"outer"}) == Lines{"/outer: a b -"});
}

TEST_CASE("solids outside all regions are regions of their own", "[promise:scenes]") {
    const Scene s = alphabet({group("g", {leg("a"), leg("B"), either}), group("all", {leg("g"), leg("c"), either})});
    const FlatScene flat = flatten(s, {"all", "d"}, false);
    REQUIRE(flat.regions.size() == 4);
    CHECK(regions_of(s, {"all", "d"}) == Lines{"/all/g/a: a", "/all/g/B: b", "/all/c: c", "/d: d"});
    CHECK(flat.regions[0].info.region_id == 0);
    CHECK(flat.regions[1].info.region_id == 1000);
    CHECK(flat.regions[3].info.material_id == 0);
}

TEST_CASE("regions come in the order of the walk, left to right, object by object") {
    const Scene s =
        alphabet({group("g", {leg("C"), leg("B"), leg("A"), op(Operator::union_, 3)}), group("h", {leg("F")})});
    CHECK(regions_of(s, {"h", "g", "D"}) == Lines{"/h/F: f", "/g/C: c", "/g/B: b", "/g/A: a", "/D: d"});
}

TEST_CASE("operators above regions: unions are pulled up, the leftmost region gives its name", "[promise:scenes]") {
    CHECK(terms({leg("A"), leg("B"), less}) == Lines{"/top/A: a b -"});
    CHECK(terms({leg("A"), leg("B"), both}) == Lines{"/top/A: a b +"});
    CHECK(terms({leg("A"), leg("B"), either, leg("C"), less}) == Lines{"/top/A: a c -", "/top/B: b c -"});
    CHECK(terms({leg("A"), leg("B"), either, leg("C"), both}) == Lines{"/top/A: a c +", "/top/B: b c +"});
    // What is subtracted stays one tree; an intersection is taken apart on both sides.
    CHECK(terms({leg("C"), leg("A"), leg("B"), either, less}) == Lines{"/top/C: c a b u -"});
    CHECK(terms({leg("C"), leg("A"), leg("B"), either, both}) == Lines{"/top/C: c a +", "/top/C@2: c b +"});
    CHECK(terms({leg("A"), leg("B"), either, leg("C"), leg("D"), either, both}) ==
          Lines{"/top/A: a c +", "/top/A@2: a d +", "/top/B: b c +", "/top/B@2: b d +"});
    // Through several levels.
    CHECK(terms({leg("A"), leg("B"), either, leg("C"), less, leg("D"), less}) ==
          Lines{"/top/A: a c - d -", "/top/B: b c - d -"});
    CHECK(terms({leg("A"), leg("B"), leg("C"), op(Operator::difference, 3), leg("D"), either}) ==
          Lines{"/top/A: a b - c -", "/top/D: d"});
    CHECK(terms({leg("A"), leg("B"), leg("C"), either, both, leg("D"), less}) ==
          Lines{"/top/A: a b + d -", "/top/A@2: a c + d -"});
    // (A u B) ^ C is not (A ^ C) u (B ^ C).
    CHECK(terms({leg("A"), leg("B"), either, leg("C"), one_of}) == Lines{"/top/A: a b u c ^"});
    CHECK(terms({leg("A"), leg("B"), either, not_, leg("C"), both}) == Lines{"/top/A: a b u ! c +"});
}

TEST_CASE("operators above regions, with combinations between") {
    const Scene s = alphabet({group("pair", {leg("A"), leg("B"), either}), group("cut", {leg("C"), leg("D"), either}),
                              group("top", {leg("pair"), leg("cut"), less})});
    CHECK(regions_of(s, {"top"}) == Lines{"/top/pair/A: a c d u -", "/top/pair/B: b c d u -"});
}

TEST_CASE("a term's attributes are those of its leftmost region") {
    Scene s = alphabet({group("top", {leg("A"), leg("B"), less})});
    std::get<Combination>(s.objects[1]).region_id = 17;
    std::get<Combination>(s.objects[1]).color = Vec3{1, 0, 0};
    std::get<Combination>(s.objects[3]).color = Vec3{0, 1, 0};
    const FlatScene flat = flatten(s, {"top"}, false);
    REQUIRE(flat.regions.size() == 1);
    CHECK(flat.regions[0].info.region_id == 17);
    CHECK(flat.regions[0].info.color == Vec3{1, 0, 0});
}

TEST_CASE("air regions are left out, with a note, unless they are wanted", "[promise:scenes]") {
    Scene s = alphabet({group("top", {leg("A"), leg("B"), either, leg("C"), less})});
    std::get<Combination>(s.objects[3]).air = 2;  // B
    const FlatScene flat = flatten(s, {"top"}, false);
    CHECK(regions_of(s, {"top"}) == Lines{"/top/A: a c -"});
    REQUIRE(flat.warnings.size() == 1);
    CHECK(format(flat.warnings[0]) == "1 air region left out: /top/B");
    CHECK(regions_of(s, {"top"}, true) == Lines{"/top/A: a c -", "/top/B: b c -"});
    // An air region that would be subtracted is not there, either; one below a region is only a part of its tree.
    std::get<Combination>(s.objects[5]).air = 1;  // C
    CHECK(regions_of(s, {"top"}) == Lines{"/top/A: a"});
    s.objects.emplace_back(region("outer", {leg("A"), leg("B"), less}));
    CHECK(regions_of(s, {"outer"}) == Lines{"/outer: a b -"});
}

TEST_CASE("air regions come after all others, and each kind in the order of the model") {
    Scene s = alphabet({group("top", {leg("A"), leg("B"), either, leg("C"), either, leg("D"), either})});
    std::get<Combination>(s.objects[1]).air = 2;  // A
    std::get<Combination>(s.objects[5]).air = 1;  // C
    CHECK(regions_of(s, {"top"}, true) == Lines{"/top/B: b", "/top/D: d", "/top/A: a", "/top/C: c"});
    CHECK(regions_of(s, {"C", "D"}, true) == Lines{"/D: d", "/C: c"});
}

TEST_CASE("what is empty vanishes from trees, and empty regions are left out with a note") {
    const Scene s = alphabet(
        {group("none", {}), region("hollow", {leg("none")}), region("less", {leg("none"), leg("a"), less}),
         region("same", {leg("a"), leg("none"), less}), region("both", {leg("a"), leg("none"), both}),
         region("sum", {leg("none"), leg("a"), leg("b"), op(Operator::union_, 3)}),
         region("flip", {leg("none"), leg("a"), one_of}), region("inside", {leg("a"), leg("none"), not_, both}),
         region("outside", {leg("a"), leg("none"), not_, less}),
         region("but", {leg("none"), not_, leg("b"), less, leg("a"), both}),
         region("odd", {leg("none"), not_, leg("b"), one_of, leg("a"), both}),
         region("late", {leg("a"), leg("none"), both, leg("b"), either})});
    CHECK(regions_of(s, {"hollow", "less", "both", "outside"}).empty());
    CHECK(regions_of(s, {"same", "sum", "flip", "inside"}) ==
          Lines{"/same: a", "/sum: a b u", "/flip: a", "/inside: a"});
    CHECK(regions_of(s, {"but", "odd"}) == Lines{"/but: b ! a +", "/odd: b ! a +"});
    const FlatScene flat = flatten(s, {"hollow", "both", "A", "none"}, false);
    REQUIRE(flat.warnings.size() == 2);
    CHECK(format(flat.warnings[0]) == "none: the object holds no solid");
    CHECK(format(flat.warnings[1]) == "2 regions without solids left out: /hollow, /both");
    CHECK(flat.instances.size() == 1);  // a of "both" is not needed
    const FlatScene late = flatten(s, {"late", "A"}, false);
    REQUIRE(late.instances.size() == 2);  // a of "late" is not needed, and comes after b
    CHECK(name_of(s.objects[late.instances[0].object]) == "b");
}

TEST_CASE("an object that is named twice is rendered once") {
    const Scene s = alphabet({});
    const FlatScene flat = flatten(s, {"A", "B", "A"}, false);
    CHECK(flat.regions.size() == 2);
    REQUIRE(flat.warnings.size() == 1);
    CHECK(flat.warnings[0].reason.find("named twice") != std::string::npos);
}

TEST_CASE("a region must not contain the empty space", "[promise:scenes]") {
    const Scene s = alphabet({region("out", {leg("a"), not_}), region("most", {leg("a"), leg("b"), not_, either}),
                              region("fine", {leg("a"), leg("b"), not_, both}), group("none", {}),
                              region("all", {leg("none"), not_}),
                              region("odd", {leg("a"), not_, leg("b"), not_, leg("c"), op(Operator::xor_, 3)}),
                              group("above", {leg("A"), not_}), group("nothing", {leg("none"), not_})});
    CHECK(regions_of(s, {"fine", "odd"}).size() == 2);
    const Thrown thrown = thrown_by([&] { flatten(s, {"out", "fine", "most", "all", "above", "nothing"}, false); });
    CHECK(thrown.status == Status::scene);
    REQUIRE(thrown.findings.size() == 5);
    const std::vector<std::string> names = {"region /out", "region /most", "region /all", "region /above/A",
                                            "object nothing"};
    for (std::size_t i = 0; i < names.size(); ++i) {
        CHECK(thrown.findings[i].message == names[i] + " contains the empty space where no solid is");
        CHECK(says(thrown.findings[i].suggestion, "intersect the complement"));
    }
    CHECK(thrown.findings[0].place.line == 7);
}

TEST_CASE("one solid in one place is one instance, whoever uses it") {
    const Matrix away = moved(5, 0, 0), back = moved(-5, 0, 0);
    const Scene s = scene({ball("a"), region("r1", {leg("a", away)}), region("r2", {leg("a"), leg("a", away), either}),
                           group("g", {leg("r1", back)}), group("h", {leg("r1", moved(0, 0, -0.0))})});
    const FlatScene flat = flatten(s, {"r1", "r2", "g", "h"}, false);
    REQUIRE(flat.regions.size() == 4);
    REQUIRE(flat.instances.size() == 2);
    CHECK(*flat.instances[0].matrix == away);
    CHECK(flat.regions[2].tree.nodes[0].solid == 1);  // there and back: the identity
    CHECK(flat.regions[3].tree.nodes[0].solid == 0);
}

TEST_CASE("matrices multiply in the order of the path", "[promise:scenes]") {
    const Matrix scale = {2, 0, 0, 0, 0, 2, 0, 0, 0, 0, 2, 0, 0, 0, 0, 1};
    const Scene s = scene({ball("a"), group("g", {leg("a", moved(1, 2, 3))}), region("r", {leg("g", scale)}),
                           group("top", {leg("r", turned(std::acos(0.0)))})});
    const FlatScene flat = flatten(s, {"top"}, false);
    const Matrix& m = *flat.instances.at(0).matrix;
    CHECK(near(m[3], -4));
    CHECK(near(m[7], 2));
    CHECK(near(m[11], 6));
}

TEST_CASE("colour and finish come from above only where they are to be inherited", "[promise:scenes]") {
    const Vec3 red{1, 0, 0}, green{0, 1, 0}, blue{0, 0, 1}, white{1, 1, 1};
    Finish glass;
    glass.shader = "glass";
    Scene s = scene({ball("a"), region("r", {leg("a")}, 5), group("g", {leg("r")}), group("top", {leg("g")})});
    auto& r = std::get<Combination>(s.objects[1]);
    auto& g = std::get<Combination>(s.objects[2]);
    auto& top = std::get<Combination>(s.objects[3]);
    const auto info = [&] { return flatten(s, {"top"}, false).regions.at(0).info; };

    CHECK(info().color == white);
    CHECK(info().finish.shader == "plastic");
    top.color = red;
    CHECK(info().color == red);
    r.color = green;
    CHECK(info().color == green);
    top.color_inherits = true;
    CHECK(info().color == red);
    top.color_inherits = false;
    g.color = blue;
    g.color_inherits = true;
    CHECK(info().color == blue);
    g.color.reset();  // nothing to inherit
    CHECK(info().color == green);
    g.finish = glass;
    g.finish_inherits = true;
    r.finish = Finish{};
    CHECK(info().finish.shader == "glass");
    g.finish_inherits = false;
    CHECK(info().finish.shader == "plastic");
}

TEST_CASE("combinations below a region do not change its colour") {
    Scene s = scene({ball("a"), group("g", {leg("a")}), region("r", {leg("g")})});
    std::get<Combination>(s.objects[1]).color = Vec3{1, 0, 0};
    CHECK(flatten(s, {"r"}, false).regions.at(0).info.color == Vec3{1, 1, 1});
}

TEST_CASE("the colour table colours regions by id that have no colour", "[promise:scenes]") {
    Scene s = scene({ball("a"), region("r", {leg("a")}, 5), region("q", {leg("a")}, 9)});
    s.region_colors = {{1, 4, {1, 0, 0}}, {5, 5, {0, 1, 0}}, {5, 9, {0, 0, 1}}};
    const auto color = [&](const char* name) { return flatten(s, {name}, false).regions.at(0).info.color; };
    CHECK(color("r") == Vec3{0, 1, 0});
    CHECK(color("q") == Vec3{0, 0, 1});
    std::get<Combination>(s.objects[2]).color = Vec3{0.5, 0.5, 0.5};
    CHECK(color("q") == Vec3{0.5, 0.5, 0.5});
}

TEST_CASE("single trees may be of any depth") {
    constexpr int count = 100'000;
    std::vector<TreeNode> chain{leg("a")};
    for (int i = 0; i < count; ++i) {
        chain.push_back(leg("b"));
        chain.push_back(i % 2 == 0 ? less : either);
    }
    Scene s = scene({ball("a"), ball("b"), region("inside", chain)});
    CHECK(flatten(s, {"inside"}, false).regions.at(0).tree.nodes.size() == 2 * count + 1);
    // The same above regions: x0 - b u b - b ...; each union adds a term, from which all that follows is subtracted.
    std::vector<TreeNode> above{leg("a")};
    for (int i = 0; i < 2000; ++i) {
        above.push_back(leg("b"));
        above.push_back(less);
    }
    for (int i = 0; i < count; ++i) {
        above.push_back(leg("b"));
        above.push_back(either);
    }
    s.objects.emplace_back(group("above", above));
    const FlatScene flat = flatten(s, {"above"}, false);
    REQUIRE(flat.regions.size() == count + 1);
    CHECK(flat.regions[0].tree.nodes.size() == 4001);
    CHECK(flat.regions[1].tree.nodes.size() == 1);
}

TEST_CASE("scenes that expand without end are refused before they are followed") {
    // 2^60 copies of a solid, in one region, or as so many regions.
    const auto doubled = [](std::vector<TreeNode> innermost) {
        Scene s = scene({ball("a"), group("c0", std::move(innermost))});
        for (int i = 1; i <= 60; ++i) {
            const std::string below = "c" + std::to_string(i - 1);
            s.objects.emplace_back(group("c" + std::to_string(i), {leg(below), leg(below), either}));
        }
        s.objects.emplace_back(region("r", {leg("c60")}));
        return s;
    };
    const Scene solids = doubled({leg("a")});
    for (const char* object : {"r", "c60"}) {
        const std::string error = error_of([&] { flatten(solids, {"a", object}, false); });
        CHECK(says(error, std::string("with object ") + object +
                              ", the scene expands to more than 10^18 instances; at most 300000 are allowed"));
    }
    // Of nothing: no limit is exceeded, and no time is spent.
    const Scene none = doubled({});
    CHECK(flatten(none, {"r", "c60"}, false).regions.empty());
    // (a u b) + (a u b) + ...: 2^60 terms of 60 solids.
    std::vector<TreeNode> product;
    for (int i = 0; i < 60; ++i) {
        product.insert(product.end(), {leg("A"), leg("B"), either});
        if (i > 0) product.push_back(both);
    }
    const Scene terms = alphabet({group("top", product)});
    CHECK(says(error_of([&] { flatten(terms, {"top"}, false); }), "300000"));
}

TEST_CASE("the limit counts the solids of every term") {
    // (A u B u C) - (d u ... u d): three terms of 25 solids.
    std::vector<TreeNode> nodes{leg("A"), leg("B"), either, leg("C"), either};
    nodes.insert(nodes.end(), {leg("ground"), op(Operator::difference, 2)});
    std::vector<TreeNode> ground{leg("d")};
    for (int i = 1; i < 24; ++i) ground.insert(ground.end(), {leg("d"), either});
    const Scene scene = alphabet({group("ground", std::move(ground)), group("top", std::move(nodes))});
    const auto regions = [&](std::uint64_t max_instances) {
        Names names(scene);
        std::vector<Warning> warnings;
        const Validated validated = validate(scene, names, {"top"}, true, warnings);
        return flatten(scene, names, validated.instances, {"top"}, false, max_instances).regions.size();
    };
    CHECK(regions(75) == 3);
    CHECK(says(error_of([&] { regions(74); }), "with object top, the scene expands to 75 instances"));
}
