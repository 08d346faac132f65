// BRL-CAD's databases as people have them: what its own programs write and read, in every form of file.
#include <unistd.h>

#include <cmath>
#include <tuple>
#include <filesystem>
#include <sstream>

#include "catch.hpp"

#include "compile/compiled_scene.hpp"
#include "folder.hpp"
#include "formats/brlcad/brlcad_asc_text.hpp"
#include "formats/brlcad/g/reader.hpp"
#include "formats/brlcad/g/bytes.hpp"
#include "formats/brlcad/g/brlcad_g_writer.hpp"
#include "integration/stress/check.hpp"

using namespace csgrt;
using asc_test::comb;
using asc_test::parse;
using asc_test::shape;
using asc_test::written;
using test::Folder;

namespace {

namespace fs = std::filesystem;
using g_test::WrittenObject;

const std::string v5 = "title {}\nunits mm\n";
const std::string v4 = "I 1 v4\ntitle\n";
const std::string ball = "put {s} ell V {0 0 0} A {10 0 0} B {0 10 0} C {0 0 10}\n";
const std::string unit = "{1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1}";

Scene parse_g(const std::string& bytes) { return parse_brlcad_g(ByteSource("model.g", g_test::header + bytes)); }

std::vector<RayPartitions> shot(const Scene& scene, const std::vector<std::string>& objects,
                                const std::vector<Ray>& rays) {
    return Renderer(scene, objects, test::on_reference()).shoot(rays);
}

}  // namespace

TEST_CASE("files: cells are in a file, a name or both, the last one holds", "[field][asc]") {
    const Folder folder;
    folder.write("h", std::string("\0\1\0\2\0\3\0\4", 8));
    folder.write("c", "abcd");
    folder.write("x", "wxyz");
    const auto dsp = [](const std::string& name, const std::string& keys) {
        return "put " + name + " dsp " + keys + " src f w 2 n 2 sm 0 cut a stom " + unit + "\n";
    };
    const auto vol = [](const std::string& name, const std::string& keys) {
        return "put " + name + " vol " + keys + " w 2 n 2 d 1 lo 1 hi 255 size {1 1 1} mat " + unit + "\n";
    };
    const auto ebm = [](const std::string& name, const std::string& keys) {
        return "put " + name + " ebm " + keys + " w 2 n 2 d 3 mat " + unit + "\n";
    };
    std::string text = v5;
    for (const auto& [name, keys] : {std::pair{"1", "file h"}, {"2", "name h"}, {"3", "file {h} name {h}"}})
        text += dsp(std::string("d") + name, keys);
    for (const auto& [name, keys] : {std::pair{"1", "file c"},
                                     {"2", "name c src f"},
                                     {"3", "file {c} name {c} src f"},
                                     {"4", "file x name c"},
                                     {"5", "name x file c"},
                                     {"6", "F c"}}) {
        text += vol(std::string("v") + name, keys) + ebm(std::string("e") + name, keys);
    }
    const Scene scene = read_brlcad_asc(folder.write("m.asc", text));
    for (const char* name : {"d1", "d2", "d3"})
        CHECK(shape<Dsp>(scene, name).heights == std::vector<std::uint16_t>{1, 2, 3, 4});
    for (const char* name : {"1", "2", "3", "4", "5", "6"}) {
        INFO(name);
        CHECK(shape<Vol>(scene, std::string("v") + name).cells == std::vector<std::uint8_t>{'a', 'b', 'c', 'd'});
        CHECK(shape<Ebm>(scene, std::string("e") + name).cells == std::vector<std::uint8_t>{'a', 'b', 'c', 'd'});
    }
    // The key=value form, of v4 and of binary databases.
    const std::string old_vol = " w=2 n=2 d=1", old_ebm = " w=2 n=2 d=3", old_dsp = " w=2 n=2";
    const Scene old = read_brlcad_asc(folder.write(
        "old.asc", v4 + "s vol v1 name=\"c\"" + old_vol + "\ns vol v2 file=x name=c" + old_vol +
                       "\ns ebm e1 name=x file=c" + old_ebm + "\ns dsp d1 name=h file=h" + old_dsp + "\n"));
    for (const char* name : {"v1", "v2"}) CHECK(shape<Vol>(old, name).cells.front() == 'a');
    CHECK(shape<Ebm>(old, "e1").cells.front() == 'a');
    CHECK(shape<Dsp>(old, "d1").heights.size() == 4);
    const auto object = [](int minor, const std::string& name, const std::string& body) {
        return WrittenObject{.minor = minor, .name = name, .body = body + g_test::zero}.bytes();
    };
    const Scene binary = read_brlcad_g(folder.write(
        "m.g", g_test::header + object(13, "v1", "name=\"c\" src=f" + old_vol) +
                   object(13, "v2", "file=c name=c src=f" + old_vol) + object(12, "e1", "file=c name=c" + old_ebm)));
    for (const char* name : {"v1", "v2"}) CHECK(shape<Vol>(binary, name).cells.front() == 'a');
    CHECK(shape<Ebm>(binary, "e1").cells.front() == 'a');
    const auto findings = asc_test::findings_in(v5 + vol("v", ""));
    REQUIRE(findings.size() == 1);
    CHECK(findings[0].message == "the vol has no file");
}

TEST_CASE("files: noise of single precision in a matrix's last row is divided out with a warning", "[field][asc]") {
    const std::string noise = "1 0 0 5 0 1 0 0 0 0 1 0 9.3e-10 0 -4e-7 0.5";
    std::vector<double> numbers = {1, 0, 0, 5, 0, 1, 0, 0, 0, 0, 1, 0, 9.3e-10, 0, -4e-7, 0.5};
    const Matrix right = {2, 0, 0, 10, 0, 2, 0, 0, 0, 0, 2, 0, 0, 0, 0, 1};
    const auto check = [&](const Scene& scene, std::uint64_t count) {
        CHECK(comb(scene, "c").tree.nodes.at(0).matrix == right);
        REQUIRE(scene.warnings.size() == 1);
        CHECK(scene.warnings[0].count == count);
        CHECK(scene.warnings[0].object == "c");
        CHECK((scene.warnings[0].place.line > 0 || scene.warnings[0].place.offset > 0));
        CHECK(scene.warnings[0].reason.find("noise of single precision") != std::string::npos);
        CHECK(validate(scene).empty());
        const CompiledScene compiled = compile(scene);
        REQUIRE(compiled.warnings.size() == 1);
        CHECK(compiled.warnings[0].reason.find("noise of single precision") != std::string::npos);
    };
    check(parse(v5 + ball + "put c comb region yes tree {u {l s {" + noise + "}} {l s {" + noise + "}}}\n"), 2);
    check(parse(v4 +
                "S 19 s 0 0 0 0 1 0 0 0 1 0 0 0 1 0 0 0 0 0 0 0 0 0 0 0 0\nC Y c 1 0 1 0 1 100 0 0 0 0 0 0 0\nM u s " +
                noise + " 0\n"),
          1);
    check(parse_g(g_test::sphere("s") + g_test::combination("c", {.leaves = {{"s", 0}}, .matrices = {numbers}})), 1);

    // What is at the limit, and what is beyond it.
    const auto faults_with = [](const std::string& last_row) {
        const Scene scene =
            parse(v5 + ball + "put c comb region yes tree {l s {1 0 0 0 0 1 0 0 0 0 1 0 " + last_row + "}}\n");
        return validate(scene).size();
    };
    CHECK(faults_with("1e-6 0 0 1") == 0);
    CHECK(faults_with("0 1.1e-6 0 1") == 1);
    CHECK(faults_with("0 0 -1e-9 1e-3") == 0);
    CHECK(faults_with("0 0 2e-9 1e-3") == 1);
}

TEST_CASE("files: a perspective matrix makes only what uses it unusable", "[field][asc][promise:databases]") {
    const std::vector<std::pair<std::string, std::string>> rows = {
        {"1 0 0 0 0 1 0 0 0 0 1 0 0 0 .5 1", "must end in the row 0 0 0 1"},
        {"1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 0", "must end in the row 0 0 0 1"},
        {"1e300 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1e-9", "not finite"}};
    for (const auto& row : rows) {
        const std::string& matrix = row.first;
        const std::string& message = row.second;
        INFO(matrix);
        const auto check = [&](const Scene& scene, int line) {
            CHECK(validate(scene, {"good"}).empty());
            const std::vector<Diagnostic> findings = validate(scene, {"bad"});
            REQUIRE(findings.size() == 1);
            INFO(format(findings[0]));
            CHECK(findings[0].place.line == line);
            CHECK(findings[0].message.find("the matrix of 's'") == 0);
            CHECK(findings[0].message.find(message) != std::string::npos);
        };
        check(parse(v5 + ball + "put bad comb region yes tree {l s {" + matrix +
                    "}}\nput good comb region yes tree {l s}\n"),
              4);
        const std::string c = " 1 0 1 0 1 100 0 0 0 0 0 0 0\n";
        check(parse(v4 + "S 19 s 0 0 0 0 1 0 0 0 1 0 0 0 1 0 0 0 0 0 0 0 0 0 0 0 0\nC Y bad" + c + "M u s " + matrix +
                    " 0\nC Y good" + c + "M u s 1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1 0\n"),
              5);
        std::vector<double> numbers;
        for (std::istringstream in(matrix); !in.eof();) in >> numbers.emplace_back();
        check(parse_g(g_test::sphere("s") +
                      g_test::combination("bad", {.leaves = {{"s", 0}}, .matrices = {numbers}},
                                          g_test::attributes({"region", "R"})) +
                      g_test::combination("good", {.leaves = {{"s"}}})),
              0);
    }
    const Scene scene = parse(v5 + "put v ebm file none w 1 n 1 d 1 mat {1 0 0 0 0 1 0 0 0 0 1 0 0 0 1 1}\n" + ball);
    CHECK(validate(scene, {"s"}).empty());
    CHECK(validate(scene, {"v"}).size() == 1);
}

TEST_CASE("files: BRL-CAD's units", "[field][asc][promise:databases]") {
    const std::tuple<const char*, double, const char*> units[] = {{"inches", 25.4, "in"},
                                                                  {"IN", 25.4, "in"},
                                                                  {"millimeters", 1, "mm"},
                                                                  {"centimeter", 10, "cm"},
                                                                  {"Feet", 304.8, "ft"},
                                                                  {"micron", 1e-3, "um"},
                                                                  {"cubits", 456.2, "cubit"},
                                                                  {"rods", 5029.2, "rd"},
                                                                  {"{nautical mile}", 1852000, "nmile"},
                                                                  {"{light year}", 9.4605284e18, "lightyear"},
                                                                  {"parsec", 3.08568025e19, "pc"},
                                                                  {"angstroms", 1e-7, "angstrom"},
                                                                  {"Mm", 1, "mm"},
                                                                  {"megameter", 1e9, "megameter"},
                                                                  {"league", 5556000, "league"},
                                                                  {"hand", 101.6, "hand"}};
    for (const auto& [name, length, kept] : units) {
        INFO(name);
        const Scene scene = parse("title {}\nunits " + std::string(name) + "\n" + ball);
        CHECK(scene.unit_length == length);
        CHECK(scene.units == kept);
    }
    // As an attribute any length is a unit; what is none is borne, as BRL-CAD does.
    for (const std::string value : {"7", "0.7", "456.2", "0", "-1", "x"}) {
        INFO(value);
        const auto check = [&](const Scene& scene) {
            const bool good = value != "0" && value != "-1" && value != "x";
            CHECK(scene.unit_length == (good ? std::stod(value) : 1));
            CHECK(scene.units == (value == "456.2" ? "cubit" : good ? value + " mm" : "mm"));
            CHECK(scene.warnings.size() == (good ? 0 : 1));
        };
        check(parse("title {}\nattr set {_GLOBAL} {units} {" + value + "}\n" + ball));
        check(parse_g(
            WrittenObject{.major = 2, .name = "_GLOBAL", .attributes = g_test::attributes({"units", value})}.bytes()));
    }
}

TEST_CASE("files: a byte order mark before a text", "[field][asc]") {
    const std::string mark = "\xEF\xBB\xBF";
    CHECK(parse(mark + "title {T}\nunits in\n" + ball).title == "T");
    CHECK(parse(mark + "I 4 v4\nold\nS 19 s 0 0 0 0 1 0 0 0 1 0 0 0 1 0 0 0 0 0 0 0 0 0 0 0 0\n").title == "old");
    const auto findings = asc_test::findings_in(mark + "title {T}\nfrob\n");
    REQUIRE(findings.size() == 1);
    CHECK(findings[0].place.line == 2);
    CHECK(findings[0].place.column == 1);
    CHECK(asc_test::findings_in(mark).size() == 1);
}

TEST_CASE("files: the operators G, X and N of BRL-CAD's trees", "[field][asc]") {
    const auto tree = [](const std::string& text) {
        const Scene scene = parse(v5 + "put c comb region yes tree {" + text + "}\n");
        return written(comb(scene, "c").tree);
    };
    CHECK(tree("X {l a}") == "a");
    CHECK(tree("G {u {l a} {X {l b}}}") == "u(a b)");
    CHECK(tree("^ {G {l a}} {X {! {l b}}}") == "^(a !(b))");
    CHECK(tree("N") == "");
    CHECK(tree("none") == "");
    CHECK(tree("u {N} {l a}") == "a");
    CHECK(tree("u {l a} {N}") == "a");
    CHECK(tree("- {l a} {N}") == "a");
    CHECK(tree("- {N} {u {l a} {l b}}") == "");
    CHECK(tree("u {l c} {n {u {l a} {l b}} {N}}") == "c");
    CHECK(tree("^ {N} {- {l a} {l b}}") == "-(a b)");
    CHECK(tree("u {- {N} {l a}} {G {N}}") == "");
    CHECK(parse(v5 + "put c comb region yes tree {l a I}\n").warnings.empty());
    const auto findings = asc_test::findings_in(v5 + "put c comb region yes tree {! {N}}\n");
    REQUIRE(findings.size() == 1);
    CHECK(findings[0].message.find("all space") != std::string::npos);
    CHECK(asc_test::findings_in(v5 + "put c comb region yes tree {X {l a} {l b}}\n").size() == 1);
}

TEST_CASE("files: an object named by a path has the place and the attributes that it has there",
          "[field][promise:databases]") {
    const Scene scene =
        parse(v5 +
              "put s ell V {0 0 0} A {1 0 0} B {0 1 0} C {0 0 1}\nput t ell V {0 0 0} A {2 0 0} B {0 2 0} C {0 0 2}\n"
              "put r comb region yes id 7 tree {- {l t {1 0 0 0 0 1 0 0 0 0 1 5 0 0 0 1}} {l s}}\n"
              "put g comb region no rgb {255 0 0} inherit yes tree {u {l r {1 0 0 10 0 1 0 0 0 0 1 0 0 0 0 1}} {l r}}\n"
              "put top comb region no tree {u {l g {1 0 0 0 0 1 0 100 0 0 1 0 0 0 0 1}} {l gone}}\n"
              "put air.r comb region yes air 1 tree {l s}\nput air.g comb region no tree {u {l air.r} {l r}}\n");
    const auto at = [](double x, double y, double z) { return Ray{{x - 50, y, z}, {1, 0, 0}}; };
    // Along a ray through where it must be: its ends, seen from the middle.
    const auto check = [&](const std::string& path, const Ray& ray, double radius, const std::string& name, int id) {
        INFO(path);
        Renderer renderer(scene, {path}, test::on_reference());
        REQUIRE(renderer.model().regions().size() == 1);
        CHECK(renderer.model().regions()[0].path == name);
        CHECK(renderer.model().regions()[0].region_id == id);
        const RayPartitions found = renderer.shoot({ray}).front();
        REQUIRE(found.partitions.size() == 1);
        CHECK(std::abs(found.partitions[0].in - (50 - radius)) < 1e-9);
        CHECK(std::abs(found.partitions[0].out - (50 + radius)) < 1e-9);
    };
    check("r", at(0, 0, 5), 2, "/r", 7);
    check("/r", at(0, 0, 5), 2, "/r", 7);
    check("g/r", at(10, 0, 5), 2, "/g/r", 7);
    check("top/g/r", at(10, 100, 5), 2, "/top/g/r", 7);
    check("/top//g/r/", at(10, 100, 5), 2, "/top/g/r", 7);
    check("top/g/r/t", at(10, 100, 5), 2, "/top/g/r/t", 7);
    check("top/g/r/s", at(10, 100, 0), 1, "/top/g/r/s", 7);
    // Paths that csgrt prints are taken.
    const Renderer whole(scene, {"g"}, test::on_reference());
    for (const RegionInfo& region : whole.model().regions())
        CHECK(Renderer(scene, {region.path}, test::on_reference()).model().regions()[0].path == region.path);
    CHECK(Renderer(scene, {"top/g/r"}, test::on_reference()).model().regions()[0].color == Vec3{1, 0, 0});
    CHECK(Renderer(scene, {"air.g/r"}, test::on_reference()).model().regions()[0].color != Vec3{1, 0, 0});
    CHECK_THROWS_AS(Renderer(scene, {"air.g/air.r/s"}, test::on_reference()), Error);  // air is left out
    // One region by two names.
    const Renderer twice(scene, {"g/r", "/g/r"}, test::on_reference());
    CHECK(twice.model().regions().size() == 1);

    const auto fault = [&](const std::string& path, const std::string& message, const std::string& suggestion) {
        INFO(path);
        const std::vector<Diagnostic> findings = validate(scene, {path});
        REQUIRE(findings.size() == 1);
        CHECK(findings[0].message == message);
        CHECK(findings[0].suggestion == suggestion);
        CHECK(object_at(scene, path) == nullptr);
    };
    fault("topp/g", "the scene has no object 'topp' (in the path 'topp/g')", "did you mean 'top'?");
    fault("air.g/air/s", "'air.g' has no member 'air' (in the path 'air.g/air/s')", "did you mean 'air.r'?");
    fault("g/elephant", "'g' has no member 'elephant' (in the path 'g/elephant')", "its members are r, r");
    fault("g/r/s/x", "'s' is a solid; it has no member 'x' (in the path 'g/r/s/x')", "");
    fault("/", "'/' is all, not one object", "give the path of one");
    CHECK(validate(scene, {"top/gone"}).at(0).message ==
          "'top' uses 'gone', which does not exist (in the path 'top/gone')");
    CHECK(object_at(scene, "top/g/r/t") == scene.find("t"));

    // A matrix on the way is checked, too; names may hold a '/'.
    const Scene flat = parse(
        v5 + ball +
        "put r comb region yes tree {l s {0 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1}}\nput a/b comb region no tree {l r}\n");
    CHECK(validate(flat, {"r/s"}).size() == 1);
    CHECK(object_at(flat, "a/b/r/s") == flat.find("s"));
}

TEST_CASE("files: points with a scale are balls", "[field][promise:databases]") {
    // type 0: all of one scale; 2: each its own; 7: with colours and normals, too
    const std::string same = "put p pnts count 3 type 0 scale 2 data { {0 0 0} {3 0 0} {20 0 0} }\n";
    const std::string own = "put q pnts count 9 type 2 scale 5 data { {0 0 0 1} {10 0 0 2} {20 0 0 0} }\n";
    const std::string full = "put f pnts type 7 data { {0 0 0 1 .5 0 4 0 0 1} } scale 0\n";
    const Scene scene = parse(v5 + same + own + full + "put none pnts count 1 type 0 scale 0 data { {1 2 3} }\n" +
                              "put r comb region yes id 3 tree {- {l p} {l f}}\n");
    const Ray ray{{-50, 0, 0}, {1, 0, 0}};
    const auto ends = [&](const Scene& s, const std::string& object) {
        std::vector<double> found;
        const RayPartitions answer = shot(s, {object}, {ray}).front();
        for (const Partition& part : answer.partitions) found.insert(found.end(), {part.in - 50, part.out - 50});
        return found;
    };
    CHECK(ends(scene, "p") == std::vector<double>{-2, 5, 18, 22});
    CHECK(ends(scene, "q") == std::vector<double>{-1, 1, 8, 12});
    CHECK(ends(scene, "f") == std::vector<double>{-4, 4});
    CHECK(ends(scene, "r") == std::vector<double>{4, 5, 18, 22});
    CHECK(Renderer(scene, {"p"}, test::on_reference()).model().regions().size() == 1);
    REQUIRE(scene.warnings.size() == 2);
    CHECK(scene.warnings[0].object == "q");
    CHECK(scene.warnings[1].object == "none");
    CHECK(scene.find("none") == nullptr);

    using g_test::number;
    using g_test::reals;
    const auto points = [](const std::string& name, double scale, unsigned type, std::uint32_t count,
                           const std::vector<double>& numbers) {
        return WrittenObject{
            .minor = 41, .name = name, .body = reals({scale}) + number(type, 1) + number(count, 2) + reals(numbers)}
            .bytes();
    };
    const Scene binary =
        parse_g(points("p", 2, 0, 3, {0, 0, 0, 3, 0, 0, 20, 0, 0}) + points("q", 5, 2, 2, {0, 0, 0, 1, 10, 0, 0, 2}) +
                points("f", 0, 7, 1, {0, 0, 0, 1, .5, 0, 4, 0, 0, 1}));
    CHECK(ends(binary, "p") == ends(scene, "p"));
    CHECK(ends(binary, "q") == ends(scene, "q"));
    CHECK(ends(binary, "f") == ends(scene, "f"));
    for (const std::string& wrong :
         {points("p", 2, 0, 4, {0, 0, 0}), points("p", 2, 8, 0, {}), points("p", 2, 0, 1, {0, 0, NAN})})
        CHECK_THROWS_AS(parse_g(wrong), Error);
    CHECK(asc_test::findings_in(v5 + "put p pnts type 2 data {{1 2 3}}\n").size() == 1);
}
