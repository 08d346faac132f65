// Legs of BRL-CAD's databases that are missing or broken: each is the empty set, as in BRL-CAD's own ray tracer, and is
// told.
#include <filesystem>
#include <limits>
#include <utility>

#include <unistd.h>

#include <csgrt/scene_io.hpp>

#include "integration/field/judge.hpp"
#include "formats/brlcad/asc.hpp"
#include "formats/brlcad/g/reader.hpp"
#include "formats/brlcad/g/bytes.hpp"
#include "formats/brlcad/g/brlcad_g_writer.hpp"
#include "formats/brlcad/brlcad_models.hpp"
#include "formats/text_source.hpp"
#include "stress/build.hpp"
#include "thrown.hpp"

using namespace csgrt;

namespace {

// ---- Generated trees, before the oracle ----

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

/// Adds an object that is broken, or a name without one, in one of the ways there are. Returns the leg that uses it.
Tree broken_leg(Scene& scene, int way, const std::string& name) {
    const auto add = [&](Shape shape) { scene.objects.emplace_back(Solid{name, std::move(shape), {}}); };
    const auto add_combination = [&](Tree tree) {
        Combination combination{.name = name, .tree = std::move(tree)};
        scene.objects.emplace_back(std::move(combination));
    };
    const Matrix flat{1, 0, 0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 0, 0, 0, 1},
        far{1, 0, 0, 9e15, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1},
        not_finite{nan, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
    switch (way) {
        case 0:
            break;  // missing
        case 1:
            add(Ell{{}, {1, 0, 0}, {}, {0, 0, 1}});
            break;
        case 2:
            add(Tgc{{}, {0, 0, 10}, {5, 0, 0}, {0, 5, 0}, {-5, 0, 0}, {0, -5, 0}});
            break;
        case 3:
            add(Ell{{nan, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}});
            break;
        case 4:
            add(Unsupported{"brep"});
            break;
        case 5:
            add(Unsupported{"ell", "the object ends early"});
            break;
        case 6:
            add_combination({});
            break;
        case 7:
            add_combination(stress::leaf(name));
            break;  // contains itself
        case 8:
            return stress::leaf("s0", flat);
        case 9:
            return stress::leaf("s0", far);
        case 10:
            return stress::leaf("s0", not_finite);
        default:
            add_combination({{{Operator::union_, 2, {}, identity, {}}}});
            break;  // an operator without operands
    }
    return stress::leaf(name);
}
constexpr int ways = 12;

struct Twins {
    stress::StressScene made, truth;
};

/// Some solids and some legs that are broken, under operators at random; in the truth the broken ones are empty
/// combinations.
Twins broken_trees(std::uint64_t seed, std::size_t times) {
    stress::Builder to("broken trees", seed, times);
    stress::Random& random = to.random();
    std::vector<std::string> solids;
    for (int i = 0; i < 6; ++i)
        solids.push_back(to.solid(
            stress::ball({random.between(-6, 6), random.between(-6, 6), random.between(-6, 6)}, random.between(3, 8))));
    const std::string hole = to.combination({});
    const int regions = 4;
    for (int r = 0; r < regions; ++r) {
        std::vector<std::string> legs = solids;
        for (int i = 0; i < 3; ++i)
            legs[static_cast<std::size_t>(random.below(static_cast<std::uint32_t>(legs.size())))] = hole;
        to.region(stress::some_tree(legs, random));
    }
    to.region(stress::leaf(solids[0]));
    stress::some_rays(to, 15, to.rays(60));
    Twins twins;
    twins.truth = to.take();
    twins.made = twins.truth;
    twins.made.scene.lenient = true;
    int number = 0;
    for (std::size_t i = 0; i < twins.truth.scene.objects.size(); ++i) {
        if (std::holds_alternative<Solid>(twins.made.scene.objects[i])) continue;
        // The scene's objects move as it grows.
        Tree tree = std::get<Combination>(twins.made.scene.objects[i]).tree;
        for (TreeNode& node : tree.nodes) {
            if (node.op != Operator::leaf || node.object != hole) continue;
            const int way = random.whole(0, ways - 1);
            node = broken_leg(twins.made.scene, way, "broken" + std::to_string(number++)).nodes.front();
        }
        std::get<Combination>(twins.made.scene.objects[i]).tree = std::move(tree);
    }
    return twins;
}

void judge_broken_trees(std::uint64_t first, std::uint64_t count, std::size_t times) {
    test::FieldTally tally;
    for (std::uint64_t seed = first; seed < first + count; ++seed) {
        const Twins twins = broken_trees(seed, times);
        test::judge_field(twins.made, twins.truth, tally, [](const Ray&, const RayPartitions&) {});
        Scene strict = twins.made.scene;
        strict.lenient = false;
        CHECK_FALSE(validate(strict, twins.made.objects).empty());
    }
    test::require_all_right(tally);
}

// ---- The same in files ----

/// A leg that is broken, as records of a file; what is said of it.
struct Broken {
    const char* what;
    std::string records;  ///< none: there is no such object
    std::string leg;
    std::string reason;
};

using Parse = Scene (*)(const std::string& bytes, bool lenient);
Scene parse_asc(const std::string& text, bool lenient) {
    TextSource source("model.asc", text);
    source.file_folders = {"."};
    return parse_brlcad_asc(source, lenient);
}
Scene parse_g(const std::string& bytes, bool lenient) { return parse_brlcad_g(ByteSource("model.g", bytes), lenient); }

/// "a u b", "a - b", ... as a file's record of a region.
using Region = std::string (*)(const std::string& name, const std::string& a, char op, const std::string& b);

const std::vector<Ray> rays = {
    {{-50, 0.25, 0.5}, {1, 0, 0}}, {{0.5, -50, 0.125}, {0, 1, 0}}, {{0.5, 0.25, 80}, {0, 0.001, -1}}};

std::vector<RayPartitions> shoot(const Scene& scene) {
    return Renderer(scene, {"part.r", "other.r"}, test::on_reference()).shoot(rays);
}

bool is_refused(const std::string& bytes, Parse parse) {
    return !test::failure(Status::scene, [&] {
                Renderer(parse(bytes, false), {"part.r", "other.r"}, test::on_reference());
            }).empty();
}

bool is_of_unknown_type(const Scene& scene, const std::string& name) {
    const Object* object = scene.find(name);
    const auto* solid = object == nullptr ? nullptr : std::get_if<Solid>(object);
    const auto* shape = solid == nullptr ? nullptr : std::get_if<Unsupported>(&solid->shape);
    return shape != nullptr && shape->reason.empty();
}

/// The scene that a program reads from what save_scene writes of it.
Scene as_json(const Scene& scene) {
    const std::string path =
        (std::filesystem::temp_directory_path() / ("csgrt-lenient-" + std::to_string(getpid()) + ".json")).string();
    save_scene(scene, path);
    const Scene read = load_scene(path);
    std::filesystem::remove(path);
    CHECK_FALSE(read.lenient);
    return read;
}

/// Under each operator, on either side, the leg is the empty set. `sound`: records of ball.s and other.r.
void check_broken(const Broken& broken, const std::string& sound, Region region, Parse parse) {
    const std::vector<RayPartitions> both = shoot(parse(sound + region("part.r", "ball.s", 'u', "ball.s"), false)),
                                     other =
                                         Renderer(parse(sound, false), {"other.r"}, test::on_reference()).shoot(rays);
    REQUIRE(both[0].partitions.size() == 2);
    REQUIRE(other[0].partitions.size() == 1);
    for (const char op : {'u', '-', '+', '^'}) {
        for (const bool first : {false, true}) {
            INFO(broken.what << ", " << op << (first ? ", first" : ""));
            const std::string bytes =
                sound + broken.records +
                (first ? region("part.r", broken.leg, op, "ball.s") : region("part.r", "ball.s", op, broken.leg));
            const Scene scene = parse(bytes, true);
            REQUIRE(scene.lenient);
            const bool nothing = op == '+' || (op == '-' && first);
            test::require_same(shoot(scene), nothing ? other : both);
            std::size_t told = 0;
            const Renderer renderer(scene, {"part.r", "other.r"}, test::on_reference());
            for (const Warning& warning : renderer.model().warnings())
                if (warning.reason.find(broken.reason) != std::string::npos) {
                    ++told;
                    CHECK_FALSE(warning.object.empty());
                    CHECK((warning.place.line > 0 || warning.place.offset >= 0));
                    CHECK(warning.count == 1);
                }
            CHECK(told == 1);
            // An object that has no inside is no mistake.
            const bool is_mistake =
                broken.reason != "nothing in it" && broken.reason.find("has no inside") == std::string::npos;
            CHECK(is_refused(bytes, parse) == is_mistake);
            // As JSON, which is strict, it means the same; but for what is too far only where it stands.
            if (!is_of_unknown_type(scene, broken.leg) && broken.reason.find("it reaches to") != 0)
                test::require_same(shoot(as_json(scene)), nothing ? other : both);
        }
    }
}

std::string region_v5(const std::string& name, const std::string& a, char op, const std::string& b) {
    return "put {" + name + "} comb region yes tree {" + op + " {l " + a + "} {l " + b + "}}\n";
}
const std::string sound_v5 =
    "title {t}\nunits mm\nput {ball.s} ell V {0 0 0} A {10 0 0} B {0 10 0} C {0 0 10}\n"
    "put {other.s} ell V {30 0 0} A {10 0 0} B {0 10 0} C {0 0 10}\nput {other.r} comb region yes tree {l other.s}\n";

std::string member_v4(char op, const std::string& name) {
    return std::string("M ") + op + " " + name + " 1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1 0\n";
}
std::string region_v4(const std::string& name, const std::string& a, char op, const std::string& b) {
    return "C Y " + name + " 1000 0 2 0 1 100 0 0 0 0 0 0 0\n" + member_v4('u', a) + member_v4(op, b);
}
std::string solid_v4(int type, const std::string& name, const std::string& numbers, int count) {
    std::string text = "S " + std::to_string(type) + " " + name + " 0 " + numbers;
    for (int i = count; i < 24; ++i) text += " 0";
    return text + "\n";
}
const std::string sound_v4 = "I 0 v4\nt\n" + solid_v4(19, "ball.s", "0 0 0 10 0 0 0 10 0 0 0 10", 12) +
                             solid_v4(19, "other.s", "30 0 0 10 0 0 0 10 0 0 0 10", 12) +
                             "C Y other.r 1001 0 1 0 1 100 0 0 0 0 0 0 0\n" + member_v4('u', "other.s");

std::string solid_g(int minor, const std::string& name, const std::vector<double>& numbers) {
    return g_test::WrittenObject{.minor = minor, .name = name, .body = g_test::reals(numbers)}.bytes();
}
const std::string as_region = g_test::attributes({"region", "R"});
std::string region_g(const std::string& name, const std::string& a, char op, const std::string& b) {
    const char tokens[] = {1, 1, static_cast<char>(op == 'u' ? 2 : op == '+' ? 3 : op == '-' ? 4 : 5)};
    return g_test::combination(name, {.leaves = {{a}, {b}}, .expression = std::string(tokens, 3)}, as_region);
}
const std::string sound_g = g_test::header + solid_g(3, "ball.s", {0, 0, 0, 10, 0, 0, 0, 10, 0, 0, 0, 10}) +
                            solid_g(3, "other.s", {30, 0, 0, 10, 0, 0, 0, 10, 0, 0, 0, 10}) +
                            g_test::combination("other.r", {.leaves = {{"other.s"}}}, as_region);

}  // namespace

TEST_CASE("broken legs of generated trees are empty sets", "[field][promise:databases]") {
    judge_broken_trees(1, 6, 1);
}
TEST_CASE("broken legs of generated trees are empty sets: 10^5 rays", "[.long][promise:databases]") {
    judge_broken_trees(1000, 200, 10);
}

TEST_CASE("a database in text is drawn without its broken legs", "[field][promise:databases]") {
    const Broken kinds[] = {
        {"missing", "", "gone.s", "there is no such object"},
        {"numbers", "put bad.s ell V {0 0 0} A {10 0 0} B {0 0 0} C {0 0 10}\n", "bad.s", "has length 0"},
        {"opposite axes", "put bad.s tgc V {0 0 0} H {0 0 10} A {5 0 0} B {0 5 0} C {-5 0 0} D {0 -5 0}\n", "bad.s",
         "must not point in opposite directions"},
        {"unreadable", "put bad.s ell V {0 x 0} A {10 0 0} B {0 10 0} C {0 0 10}\n", "bad.s", "'x' is not a number"},
        {"incomplete", "put bad.s ell V {0 0 0}\n", "bad.s", "the ell has no A"},
        {"unknown", "put bad.s brep x y\n", "bad.s", "NURB"},
        {"empty", "put bad.c comb region no\n", "bad.c", "nothing in it"},
        {"grip", "put bad.s grip V {0 0 0} N {1 0 0} L 1\n", "bad.s", "a grip has no inside"},
        {"sketch", "put bad.s sketch V {0 0 0} A {1 0 0} B {0 1 0} VL {} SL {}\n", "bad.s", "a sketch has no inside"},
        {"itself", "put bad.c comb region no tree {l bad.c}\n", "bad.c", "contains itself: bad.c/bad.c"},
        {"cycle", "put bad.c comb region no tree {l d.c}\nput d.c comb region no tree {l bad.c}\n", "bad.c",
         "contains itself: bad.c/d.c/bad.c"},
        {"singular", "", "ball.s {1 0 0 0 0 1 0 0 1 1 0 0 0 0 0 1}", "is singular"},
        {"far",
         "put far.s ell V {0 0 0} A {10 0 0} B {0 10 0} C {0 0 10}\n"
         "put bad.c comb region no tree {l d.c {1 0 0 9e14 0 1 0 0 0 0 1 0 0 0 0 1}}\n"
         "put d.c comb region no tree {l far.s {1 0 0 9e14 0 1 0 0 0 0 1 0 0 0 0 1}}\n",
         "bad.c", "it reaches to 1.8e+15 mm"},
        {"operator", "put bad.c comb region no tree {q {l ball.s} {l ball.s}}\n", "bad.c", "'q' is no operator"},
        {"cells",
         "put bad.s vol file none w 2 n 2 d 2 lo 1 hi 255 size {1 1 1} mat {1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1}\n",
         "bad.s", "the file 'none', which cannot be read"},
    };
    for (const Broken& broken : kinds) check_broken(broken, sound_v5, region_v5, parse_asc);
}

TEST_CASE("a database of release 4 in text is drawn without its broken legs", "[field]") {
    const Broken kinds[] = {
        {"missing", "", "gone.s", "there is no such object"},
        {"numbers", solid_v4(19, "bad.s", "0 0 0 10 0 0 0 0 0 0 0 10", 12), "bad.s", "has length 0"},
        {"opposite axes", solid_v4(18, "bad.s", "0 0 0 0 0 10 5 0 0 0 5 0 -5 0 0 0 -5 0", 18), "bad.s",
         "must not point in opposite directions"},
        {"unreadable", solid_v4(19, "bad.s", "0 x 0 10 0 0 0 10 0 0 0 10", 12), "bad.s", "'x' is not a number"},
        {"unknown", "P bad.s\nQ 3 0 0 0\n", "bad.s", "dbupgrade"},
        {"no such type", solid_v4(99, "bad.s", "0 0 0 10 0 0 0 10 0 0 0 10", 12), "bad.s", "no solid has type 99"},
        {"empty", "C N bad.c 0 0 0 0 0 0 0 0 0 0 0 0 0\n", "bad.c", "nothing in it"},
        {"itself", "C N bad.c 0 0 1 0 0 0 0 0 0 0 0 0 0\n" + member_v4('u', "bad.c"), "bad.c", "contains itself"},
        {"operator", "C N bad.c 0 0 1 0 0 0 0 0 0 0 0 0 0\n" + member_v4('q', "ball.s"), "bad.c", "'q' is no operator"},
    };
    for (const Broken& broken : kinds) check_broken(broken, sound_v4, region_v4, parse_asc);
}

TEST_CASE("a binary database is drawn without its broken legs", "[field][promise:databases]") {
    const std::string bad_token(1, '\11');
    const Broken kinds[] = {
        {"missing", "", "gone.s", "there is no such object"},
        {"numbers", solid_g(3, "bad.s", {0, 0, 0, 10, 0, 0, 0, 0, 0, 0, 0, 10}), "bad.s", "has length 0"},
        {"opposite axes", solid_g(2, "bad.s", {0, 0, 0, 0, 0, 10, 5, 0, 0, 0, 5, 0, -5, 0, 0, 0, -5, 0}), "bad.s",
         "must not point in opposite directions"},
        {"too short", solid_g(3, "bad.s", {0, 0, 0, 10}), "bad.s", "bytes are needed"},
        {"too long", solid_g(3, "bad.s", {0, 0, 0, 10, 0, 0, 0, 10, 0, 0, 0, 10, 7}), "bad.s", "8 bytes more"},
        {"compressed",
         g_test::WrittenObject{.minor = 3, .name = "bad.s", .body = g_test::counted_reals(1, 12), .compression = 1}
             .bytes(),
         "bad.s", "g2asc"},
        {"unknown", solid_g(37, "bad.s", {1, 2, 3}), "bad.s", "NURB"},
        {"submodel", solid_g(28, "bad.s", {1, 2, 3}), "bad.s", "dbconcat"},
        {"no such type", solid_g(99, "bad.s", {1, 2, 3}), "bad.s", "'type 99'"},
        {"empty", g_test::combination("bad.c", {}), "bad.c", "nothing in it"},
        {"joint", solid_g(23, "bad.s", {1, 2, 3}), "bad.s", "a joint has no inside"},
        {"itself", g_test::combination("bad.c", {.leaves = {{"bad.c"}}}), "bad.c", "contains itself"},
        {"singular",
         g_test::combination(
             "bad.c", {.leaves = {{"ball.s", 0}}, .matrices = {{1, 0, 0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 0, 0, 0, 1}}}),
         "bad.c", "is singular"},
        {"token", g_test::combination("bad.c", {.leaves = {{"ball.s"}}, .expression = bad_token}), "bad.c",
         "is no token"},
        {"matrix", g_test::combination("bad.c", {.leaves = {{"ball.s", 3}}}), "bad.c", "the leaf has matrix 3"},
    };
    for (const Broken& broken : kinds) check_broken(broken, sound_g, region_g, parse_g);
}

TEST_CASE("what is wrong beside the geometry is passed over, and told", "[field][promise:databases]") {
    const Scene scene = parse_asc(sound_v5 +
                                      "put r.r comb region yes rgb {1 2 300} id 7 tree {l ball.s}\n"
                                      "attr set r.r los many aircode 0 material_id 5\n"
                                      "attr set gone.r los 5\ncolor 1 2 x 4 5\n"
                                      "put ball.s ell V {5 0 0} A {1 0 0} B {0 1 0} C {0 0 1}\n",
                                  true);
    REQUIRE(scene.warnings.size() == 5);
    for (const Warning& warning : scene.warnings) CHECK(warning.place.line > 5);
    const auto& region = std::get<Combination>(*scene.find("r.r"));
    CHECK(region.region_id == 7);
    CHECK(region.material_id == 5);
    CHECK_FALSE(region.color);
    CHECK(std::get<Ell>(std::get<Solid>(*scene.find("ball.s")).shape).v == Vec3{0, 0, 0});
    CHECK(scene.warnings.back().reason.find("this name is taken") == 0);

    const Scene binary =
        parse_g(sound_g + g_test::combination("r.r", {.leaves = {{"ball.s"}}},
                                              g_test::attributes({"region", "R", "los", "many", "material_id", "5"})),
                true);
    REQUIRE(binary.warnings.size() == 1);
    CHECK(binary.warnings[0].object == "r.r");
    CHECK(std::get<Combination>(*binary.find("r.r")).region);
    CHECK(std::get<Combination>(*binary.find("r.r")).material_id == 5);
}

TEST_CASE("a file that cannot be read as a whole is refused with its place", "[field]") {
    const auto refused = [](const std::string& bytes, Parse parse) {
        const test::Thrown thrown = test::thrown_by([&] { parse(bytes, true); });
        return thrown.status == Status::scene &&
               (thrown.findings[0].place.line > 0 || thrown.findings[0].place.offset >= 0);
    };
    CHECK(refused(sound_v5 + "put open.s ell V {0 0 0", parse_asc));
    CHECK(refused(sound_v5 + "draw all.g\n", parse_asc));
    CHECK(refused(sound_v4 + "S 19 cut.s 0 1 2 3", parse_asc));
    CHECK(refused(sound_v4 + "X 1 2 3\n", parse_asc));
    CHECK(refused(sound_g.substr(0, sound_g.size() - 8), parse_g));
    CHECK(refused(sound_g + "garbage", parse_g));
    CHECK(refused(sound_g.substr(g_test::header.size()), parse_g));
}

TEST_CASE("a missing object is told once, with its legs counted; so is one that all use",
          "[field][promise:databases]") {
    const Scene scene =
        parse_asc(sound_v5 + "put bad.s ell V {0 0 0} A {10 0 0} B {0 0 0} C {0 0 10}\n" +
                      region_v5("a.r", "ball.s", 'u', "gone.s") + region_v5("b.r", "bad.s", 'u', "gone.s") +
                      region_v5("c.r", "ball.s", '-', "bad.s"),
                  true);
    const std::vector<Warning> warnings =
        Renderer(scene, {"a.r", "b.r", "c.r"}, test::on_reference()).model().warnings();
    REQUIRE(warnings.size() == 3);
    CHECK(warnings[0].object == "bad.s");
    CHECK(warnings[0].count == 2);
    CHECK(warnings[1].object == "gone.s");
    CHECK(warnings[1].count == 2);
    CHECK(warnings[1].place.line == 7);
    CHECK(format(warnings[2]) == "1 region without solids left out: /b.r");
    CHECK(Renderer(scene, {"other.r"}, test::on_reference()).model().warnings().empty());  // nothing broken is in it
}

TEST_CASE("a database with some bytes changed is drawn or refused", "[field]") {
    const std::string v5 = sound_v5 + "put t.s tor V {0 0 0} H {0 0 1} r_a 10 r_h 2\n" +
                           region_v5("a.r", "ball.s", '-', "t.s") + region_v5("b.r", "other.s", 'u', "gone.s") +
                           "put all.g comb region no tree {u {l a.r} {l b.r}}\n",
                      v4 = sound_v4 + solid_v4(16, "t.s", "0 0 0 0 0 2 10 0 0 0 10 0", 12) +
                           region_v4("a.r", "ball.s", '-', "t.s") + region_v4("b.r", "other.s", 'u', "gone.s") +
                           region_v4("all.g", "a.r", 'u', "b.r"),
                      g = sound_g + solid_g(1, "t.s", {0, 0, 0, 0, 0, 1, 10, 2}) +
                          region_g("a.r", "ball.s", '-', "t.s") + region_g("b.r", "other.s", 'u', "gone.s") +
                          region_g("all.g", "a.r", 'u', "b.r");
    stress::Random random(7);
    int drawn = 0, refused = 0, told = 0;
    for (int i = 0; i < 3000; ++i) {
        const Parse parse = i % 3 == 2 ? parse_g : parse_asc;
        std::string bytes = i % 3 == 0 ? v5 : i % 3 == 1 ? v4 : g;
        for (int k = random.whole(1, 3); k > 0; --k) {
            const auto at = static_cast<std::size_t>(random.below(static_cast<std::uint32_t>(bytes.size())));
            const char other =
                i % 3 == 2 ? static_cast<char>(random.whole(0, 255)) : "0123456789 .-e{}xu\n"[random.whole(0, 19)];
            bytes[at] = random.coin() ? other : static_cast<char>(bytes[at] ^ 1 << random.whole(0, 7));
        }
        INFO(i);
        try {
            const Scene scene = parse(bytes, true);
            Renderer renderer(scene, {}, test::on_reference());
            renderer.shoot(rays);
            ++drawn;
            if (renderer.model().warnings().size() > 1) ++told;  // of gone.s, there is one always
        } catch (const Error& error) {
            REQUIRE(error.status() == Status::scene);
            REQUIRE_FALSE(error.diagnostics().empty());
            ++refused;
        }
    }
    CHECK(drawn > 1000);
    CHECK(told > 300);
    CHECK(refused > 300);
}

TEST_CASE("every model of BRL-CAD draws, with nothing left out but what is empty", "[field]") {
    const auto folder = brlcad_test::model_folder();
    if (folder.empty()) return;
    std::size_t models = 0;
    for (const auto& entry : std::filesystem::directory_iterator(folder)) {
        if (entry.path().extension() != ".g" && entry.path().extension() != ".asc") continue;
        INFO(entry.path().filename());
        ++models;
        const Scene scene = load_scene(entry.path().string());
        CHECK(scene.lenient);
        Renderer renderer(scene, {}, test::on_reference());
        View view{.width = 16, .height = 16, .camera = scene.camera};
        CHECK(renderer.render(view).attributes.contains("csgrt:warnings") == !renderer.model().warnings().empty());
        CHECK(renderer.statistics().ends > 0);
        std::string told;
        for (const Warning& warning : renderer.model().warnings()) told += "\n" + format(warning);
        INFO(told);
        for (std::size_t at = told.find(": left out: "); at != std::string::npos;
             at = told.find(": left out: ", at + 1))
            CHECK(told.find("there is nothing in it", at) == at + 12);
        CHECK(validate(load_scene(entry.path().string(), {.strict = true})).empty());
    }
    CHECK(models > 20);
}
