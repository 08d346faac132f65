// csgrt measure: what it prints and writes.
#include <cmath>
#include <cstring>
#include <sstream>

#include <nlohmann/json.hpp>

#include "cli/command.hpp"

using namespace command_test;
using nlohmann::json;

namespace {

/// Two blocks of 1000 mm^3, of which the first owns what they share, in a database that knows steel.
constexpr const char* blocks =
    "title {two blocks}\n"
    "units mm\n"
    "put a.s arb8 V1 {0 0 0} V2 {10 0 0} V3 {10 10 0} V4 {0 10 0} V5 {0 0 10} V6 {10 0 10} V7 {10 10 10} V8 {0 10 10}\n"
    "put b.s arb8 V1 {5 0 0} V2 {15 0 0} V3 {15 10 0} V4 {5 10 0} V5 {5 0 10} V6 {15 0 10} V7 {15 10 10} V8 {5 10 10}\n"
    "put a.r comb region yes id 1001 tree {l a.s}\n"
    "put b.r comb region yes id 1002 tree {l b.s}\n"
    "put all.g comb region no tree {u {l a.r} {l b.r}}\n"
    "attr set a.r region R region_id 1001 material_id 1 los 100\n"
    "attr set b.r region R region_id 1002 material_id 2 los 100\n"
    "put _DENSITIES binunif T 12 D {3120372e38352073746565 6c}\n";  // 1 7.85 steel

const json& part(const json& result, const std::string& name) {
    for (const json& part : result["parts"])
        if (part["name"] == name) return part;
    FAIL(name);
    return result;
}

bool is_near(const json& estimate, double truth) {
    return std::abs(estimate[0].get<double>() - truth) <= 2.5 * estimate[1].get<double>();
}

}  // namespace

TEST_CASE("measure prints a table, and writes JSON and CSV", "[promise:measure]") {
    NEEDS_COMMAND();
    const Folder folder;
    const std::string scene = folder.write("blocks.asc", blocks);
    const Result table = run({"measure", scene, "--json", folder / "out.json", "--csv", folder / "out.csv"});
    CAPTURE(table.out, table.err);
    REQUIRE(table.status == 0);
    CHECK(table.err.empty());
    CHECK(table.out.starts_with("volume              1"));
    for (const char* text : {"\n  claimed ", "\nmass ", " kg mm^2\n", "\nall.g ", "\n  a.r ", "\n  b.r ", "\nsteel ",
                             "\nmaterial 2 ", "No density is known of these regions, which count as weightless:\n",
                             "\n  /all.g/b.r  ", "2 of 2 regions within 1 %\n"})
        CHECK(contains(table.out, text));
    std::istringstream lines(table.out);
    for (std::string line; std::getline(lines, line);) CHECK(line.size() <= 100);

    const json result = json::parse(read_file(folder / "out.json"));
    CHECK(result["reached"] == true);
    CHECK(result["units"]["mass"] == "kg");
    CHECK(is_near(part(result, "/all.g")["volume"], 1500));
    CHECK(is_near(part(result, "/all.g")["claimed"], 2000));
    CHECK(is_near(part(result, "/all.g/a.r")["mass"], 7.85e-3));
    CHECK(part(result, "/all.g/b.r")["weightless"] == 1);
    CHECK(part(result, "/all.g/b.r")["centroid_x"][0].is_null());

    const std::string csv = read_file(folder / "out.csv");
    CHECK(csv.starts_with("kind,name,id,regions,reached,unmet,weightless,unmet_bound,thin,wall,volume,"));
    CHECK(contains(csv, "\nregion,/all.g/b.r,1,1,1,0,1,0,0,,"));
    const auto columns = [](const std::string& line) { return std::count(line.begin(), line.end(), ','); };
    std::istringstream rows(csv);
    std::string head;
    std::getline(rows, head);
    for (std::string line; std::getline(rows, line);) CHECK(columns(line) == columns(head));
}

TEST_CASE("measure's JSON has the same bytes with any number of threads", "[promise:measure]") {
    NEEDS_COMMAND();
    const Folder folder;
    const std::string scene = folder.write("blocks.asc", blocks);
    const auto bytes = [&scene](const std::vector<std::string>& more) {
        std::vector<std::string> words = {"measure", scene, "--rel-error", "2e-3", "--json", "-"};
        words.insert(words.end(), more.begin(), more.end());
        return run(words).out;
    };
    const std::string one = bytes({"--threads", "1"});
    CHECK(one.size() > 1000);
    CHECK(bytes({"--threads", "2"}) == one);
    CHECK(bytes({"--reference"}) == one);
    CHECK(bytes({"--seed", "2"}) != one);
}

TEST_CASE("a wall below the limit ends measure with 8, and is told with its ends", "[promise:measure]") {
    NEEDS_COMMAND();
    const Folder folder;
    const std::string scene = folder.write("blocks.asc", blocks);
    const Result fine = run({"measure", scene, "--walls"});
    CHECK(fine.status == 0);
    CHECK(contains(fine.out, " wall mm\n"));
    CHECK(run({"measure", scene, "--wall-limit", "5"}).status == 0);
    const Result thin = run({"measure", scene, "--wall-limit", "5.001"});
    CAPTURE(thin.out);
    CHECK(thin.status == 8);
    CHECK(contains(thin.out, "\nWalls thinner than 5.001 mm:\n  /all.g/b.r  5 mm, from 1"));
}

TEST_CASE("a table of densities of one's own counts in place of the database's", "[promise:measure]") {
    NEEDS_COMMAND();
    const Folder folder;
    const std::string scene = folder.write("blocks.asc", blocks);
    const std::string own = folder.write("own", "# mine\n/all.g 1\n2 2.5 lead\n/of_another_model 3\n");
    const Result result = run({"measure", scene, "--densities", own, "--json", "-"});
    CAPTURE(result.err);
    REQUIRE(result.status == 0);
    CHECK(contains(result.err, "/of_another_model: no region has this path"));
    const json all = json::parse(result.out);
    CHECK(is_near(part(all, "/all.g/a.r")["mass"], 1e-3));
    CHECK(is_near(part(all, "/all.g/b.r")["mass"], 1.25e-3));
    const Result wrong = run({"measure", scene, "--densities", folder.write("wrong", "1 2\nlead 11\n")});
    CHECK(wrong.status == 3);
    CHECK(contains(wrong.err, "wrong:2:1: 'lead' is neither the number of a material nor a path"));
}

TEST_CASE("a measure that its time ends prints what it has", "[promise:measure]") {
    NEEDS_COMMAND();
    const Folder folder;
    const std::string scene = folder.write("blocks.asc", blocks);
    const Result timed = run({"measure", scene, "--rel-error", "1e-9", "--time", "0.2"});
    CHECK(timed.status == 0);
    CHECK(contains(timed.out, "0 of 2 regions within 1e-07 %\n"));
}

TEST_CASE("a database's densities are kept by convert", "[promise:measure]") {
    NEEDS_COMMAND();
    const Folder folder;
    const std::string scene = folder.write("blocks.asc", blocks);
    REQUIRE(run({"convert", scene, folder / "blocks.json"}).status == 0);
    const Result first = run({"measure", scene, "--json", "-"});
    CHECK(json::parse(first.out)["parts"][0].contains("mass"));
    CHECK(run({"measure", folder / "blocks.json", "--json", "-"}).out == first.out);
}

TEST_CASE("measure writes the volumes in the cells of a grid", "[promise:measure]") {
    NEEDS_COMMAND();
    const Folder folder;
    const std::string scene = folder.write("blocks.asc", blocks);
    const auto write = [&](const std::string& name, const std::string& threads) {
        const Result result = run({"measure", scene, "--grid", "6,2,1", "--grid-output", folder / name, "--grid-output",
                                   folder / ("a" + name), "--threads", threads});
        CAPTURE(result.err);
        REQUIRE(result.status == 0);
        CHECK(read_file(folder / name) == read_file(folder / ("a" + name)));
        return read_file(folder / name);
    };
    const std::string npz = write("cells.npz", "1"), vti = write("cells.vti", "2");
    CHECK(write("cells.npz", "2") == npz);
    CHECK(npz.starts_with("PK\3\4"));
    CHECK(contains(npz, "region_half_widths.npy"));

    CHECK(contains(vti, "WholeExtent=\"0 6 0 2 0 1\" Origin=\"0 0 0\" Spacing=\"2.5 5 10\""));
    CHECK(contains(vti, "Name=\"material 1 steel\""));
    CHECK(contains(vti, "Name=\"material 2\""));
    std::size_t at = vti.find("\n_") + 2;
    const auto next = [&](auto* values) {
        std::uint64_t bytes;
        std::memcpy(&bytes, vti.data() + at, sizeof bytes);
        REQUIRE(bytes == 12 * sizeof *values);
        std::memcpy(values, vti.data() + at + sizeof bytes, bytes);
        at += sizeof bytes + bytes;
    };
    double all[12], steel[12], other[12];
    std::int32_t regions[12];
    next(all);
    next(regions);
    next(steel);
    next(other);
    CHECK(vti.substr(at) == "\n</AppendedData>\n</VTKFile>\n");
    for (int i = 0; i < 12; ++i) {
        CAPTURE(i);
        CHECK(std::abs(all[i] - 1) < 0.05);  // both blocks fill the box
        CHECK(regions[i] == (i % 6 < 4 ? 0 : 1));
        CHECK(steel[i] == (i % 6 < 4 ? all[i] : 0));
        CHECK(other[i] == (i % 6 < 4 ? 0 : all[i]));
    }
}

TEST_CASE("a wrong grid is refused before the measure", "[promise:measure]") {
    NEEDS_COMMAND();
    const Folder folder;
    const std::string scene = folder.write("blocks.asc", blocks);
    const std::pair<std::vector<std::string>, const char*> wrong[] = {
        {{"--grid", "6,2,1"}, "--grid-output FILE.npz"},
        {{"--grid-output", folder / "a.npz"}, "--grid NX,NY,NZ"},
        {{"--grid", "6,2,1", "--grid-output", folder / "a.csv"}, "a.csv' ends in neither .npz nor .vti"},
        {{"--grid", "6,0,1", "--grid-output", folder / "a.npz"}, "'6,0,1' is not three whole"},
        {{"--grid", "6,2", "--grid-output", folder / "a.npz"}, "'6,2' is not three whole"},
        {{"--grid", "4294967297,1,1", "--grid-output", folder / "a.npz"}, "1' is not three whole"},
        {{"--grid", "4096,4096,2", "--grid-output", folder / "a.npz"}, "16,777,216 of them at most"}};
    for (const auto& [options, text] : wrong) {
        std::vector<std::string> words = {"measure", scene};
        words.insert(words.end(), options.begin(), options.end());
        const Result result = run(words);
        CAPTURE(result.err, text);
        CHECK(result.status == 2);
        CHECK(contains(result.err, text));
    }
    CHECK(!fs::exists(folder / "a.npz"));
}
