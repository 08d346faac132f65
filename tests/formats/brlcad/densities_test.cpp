// Tables of densities, in files and in databases.
#include <csgrt/measure.hpp>
#include <csgrt/scene_io.hpp>

#include "folder.hpp"
#include "g/brlcad_g_writer.hpp"
#include "thrown.hpp"

using namespace csgrt;

namespace {

const std::string table =
    "# steel and others\n"
    "\n"
    "2 7.82 Carbon Tool Steel\n"
    "  5\t2.7   \"Aluminum, 6061-T6\"  # light\r\n"
    "/all/hull.r 0.9\n";

void check_table(const std::vector<Density>& rows) {
    REQUIRE(rows.size() == 3);
    CHECK((rows[0].material_id == 2 && rows[0].density == 7.82 && rows[0].name == "Carbon Tool Steel"));
    CHECK((rows[1].material_id == 5 && rows[1].density == 2.7 && rows[1].name == "Aluminum, 6061-T6"));
    CHECK((rows[2].path == "/all/hull.r" && rows[2].density == 0.9 && rows[2].name.empty()));
}

std::string hexadecimal(const std::string& bytes) {
    constexpr const char* digits = "0123456789abcdef";
    std::string out;
    for (const char c : bytes) {
        out += digits[static_cast<unsigned char>(c) / 16];
        out += digits[static_cast<unsigned char>(c) % 16];
    }
    return out;
}

}  // namespace

TEST_CASE("a file of densities is read, and all its wrong lines are told") {
    const test::Folder folder;
    check_table(load_densities(folder.write("densities", table)));
    const test::Thrown thrown =
        test::thrown_by([&] { load_densities(folder.write("wrong", "1 2 a\nsteel 7.8\n3 heavy\n4\n5 -1\n")); });
    CHECK(thrown.status == Status::scene);
    REQUIRE(thrown.findings.size() == 4);
    CHECK(test::says(thrown.findings[0].message, "'steel' is neither the number of a material nor a path"));
    CHECK(thrown.findings[0].place.line == 2);
    CHECK(test::says(thrown.findings[1].message, "'heavy' is no density"));
    CHECK(test::says(thrown.findings[2].message, "'' is no density"));
    CHECK(test::says(thrown.findings[3].message, "'-1' is no density"));
}

TEST_CASE("a database's densities are its object _DENSITIES, in text and binary") {
    const test::Folder folder;
    const auto binary = [](int type, const std::string& text) {
        return g_test::header +
               g_test::WrittenObject{.major = 9, .minor = type, .name = "_DENSITIES", .body = text}.bytes();
    };
    const auto text = [](int type, const std::string& of) {
        return "title {}\nput x grip V {0 0 0} N {0 0 1} L 1\nput _DENSITIES binunif T " + std::to_string(type) +
               " D {\n" + hexadecimal(of) + "}\n";
    };
    for (const int type : {4, 12}) {
        CAPTURE(type);
        check_table(load_densities(folder.write("model.g", binary(type, table))));
        check_table(load_densities(folder.write("model.asc", text(type, table))));
    }
    CHECK(load_densities(folder.write("doubles.g", binary(3, table))).empty());
    CHECK(load_densities(folder.write("none.g", g_test::header)).empty());
    CHECK(load_densities(folder.write("none.asc", "title {}\n")).empty());
    CHECK(load_densities(folder.write("none.json", R"({"csgrt": 1, "combinations": {"c": {"tree": null}}})")).empty());

    // A scene has them, and its .json.
    Scene scene = load_scene(folder.write("model.g", binary(4, table)));
    check_table(scene.densities);
    scene.objects.push_back(Combination{.name = "c"});
    save_scene(scene, folder / "model.json");
    check_table(load_densities(folder / "model.json"));

    const std::string broken = folder.write("broken.g", binary(4, "1 2 a\nb 3"));
    std::vector<Warning> warnings;
    CHECK(load_densities(broken, &warnings).size() == 1);
    REQUIRE(warnings.size() == 1);
    CHECK(warnings[0].object == "_DENSITIES");
    CHECK(test::says(warnings[0].reason, "'b' is neither"));
    CHECK(test::thrown_by([&] { load_densities(broken); }).status == Status::scene);
    CHECK(load_scene(broken).warnings.size() == 1);
    CHECK(test::thrown_by([&] { load_scene(broken, {.strict = true}); }).status == Status::scene);
    CHECK(test::thrown_by([&] { load_densities(folder / "none"); }).status == Status::file);
}
