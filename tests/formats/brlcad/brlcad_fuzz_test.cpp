// BRL-CAD's databases with bytes changed, put in and left out: each is read and compiled, or refused with an Error that
// says where; nothing else may happen, and soon. Fixed seeds.
#include <chrono>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>

#include "catch.hpp"

#include "compile/compiled_scene.hpp"
#include "formats/brlcad/asc.hpp"
#include "formats/brlcad/g/reader.hpp"
#include "formats/brlcad/g/bytes.hpp"
#include "formats/brlcad/g/brlcad_g_writer.hpp"
#include "formats/brlcad/brlcad_models.hpp"
#include "formats/text_source.hpp"
#include "sanitized.hpp"

using namespace csgrt;
using namespace csgrt::g_test;

namespace {

struct File {
    std::string name, bytes;
    bool binary = false;
};

/// A little of everything, so that a change anywhere meets some reader.
std::vector<File> own_files() {
    const std::string m = "{1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1}", line = " 1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1 0\n";
    const std::string v5 =
        "title {T}\nunits in\ncolor 1 9 255 0 0\nput e ell V {0 0 0} A {1 0 0} B {0 1 0} C {0 0 1}\n"
        "put t tgc V {0 0 0} H {0 0 3} A {1 0 0} B {0 1 0} C {1 0 0} D {0 1 0}\nput o tor V {0 0 0} H {0 0 1} r_a 3 "
        "r_h 1\n"
        "put a arb8 V1 {0 0 0} V2 {1 0 0} V3 {1 1 0} V4 {0 1 0} V5 {0 0 1} V6 {1 0 1} V7 {1 1 1} V8 {0 1 1}\n"
        "put n arbn N 4 P0 {1 1 1 1} P1 {-1 0 0 0} P2 {0 -1 0 0} P3 {0 0 -1 0}\nput h half N {0 0 1} d 1\n"
        "put p part V {0 0 0} H {0 0 3} r_v 1 r_h 0.5\nput eto eto V {0 0 0} N {0 0 1} C {0.5 0 1} r 3 r_d 0.5\n"
        "put m metaball method 2 thresh 1 PL {{0 0 0 1 1} {1 0 0 1 2}}\nput pts pnts count 2 type 2 scale 1 data {{0 0 "
        "0 1} {1 2 3 .5}}\n"
        "put pi pipe V0 {0 0 0} O0 1 I0 0.5 R0 2 V1 {9 0 0} O1 1 I1 0.5 R1 2 V2 {9 9 0} O2 1 I2 0.5 R2 2\n"
        "put b bot mode volume orient rh flags {} V {{0 0 0} {1 0 0} {0 1 0} {0 0 1}} F {{0 2 1} {0 1 3} {1 2 3} {2 0 "
        "3}}\n"
        "put ars ars NC 3 PPC 3 C0 {{0 0 0} {0 0 0} {0 0 0}} C1 {{1 0 1} {0 1 1} {-1 0 1}} C2 {{0 0 2} {0 0 2} {0 0 "
        "2}}\n"
        "put sk sketch V {0 0 0} A {1 0 0} B {0 1 0} VL {{0 0} {4 0} {4 4} {0 4}} SL {{line S 0 E 1} {line S 1 E 2} "
        "{line S 2 E 3} {line S 3 E 0}}\n"
        "put ex extrude V {0 0 0} H {0 0 1} A {1 0 0} B {0 1 0} S sk\nput num binunif T 5 D {0001 0002 0003 0004}\n"
        "put d dsp file num name num src o w 2 n 2 sm 0 cut a stom " +
        m +
        "\n"
        "put c comb region yes id 7 los 100 GIFTmater 1 rgb {1 2 3} shader {plastic {sh 9}} inherit yes tree {u {- {l "
        "t {2 0 0 1 0 2 0 0 0 0 2 0 0 0 0 1}} {l o}} {n {l a} {^ {l e} {l h}}}}\n"
        "attr set {c} {los} {50} {oshader} {glass}\nput g comb region no tree {u {l c} {u {l b} {u {l m} {u {l pi} {u "
        "{l ex} {u {l d} {l pts}}}}}}}\n"
        "put c2 comb region yes tree {- {l n} {l p}}\n";
    const std::string v4 =
        "I 4 v4\nold\nS 19 e 0 0 0 0 1 0 0 0 1 0 0 0 1 0 0 0 0 0 0 0 0 0 0 0 0\n"
        "S 18 t 0 0 0 0 0 0 3 1 0 0 0 1 0 1 0 0 0 1 0 0 0 0 0 0 0\nn n 4\nn 1 1 1 1\nn -1 0 0 0\nn 0 -1 0 0\nn 0 0 -1 "
        "0\n"
        "p p 0 0 0 0 0 3 1 .5\nC Y c 7 0 2 0 1 100 1 1 2 3 1 0 0\nplastic\nM u e" +
        line + "M - t" + line + "C N g 0 0 2 0 0 0 0 0 0 0 0 0 0\nM u c" + line + "M u n" + line + "M u p" + line +
        "m 0 1 9 255 0 0\n";
    const std::vector<double> moved = {2, 0, 0, 1, 0, 2, 0, 0, 0, 0, 2, 0, 0, 0, 0, 1};
    const auto solid = [](int minor, const std::string& name, const std::string& body) {
        return WrittenObject{.minor = minor, .name = name, .body = body}.bytes();
    };
    const std::string g =
        header +
        WrittenObject{.major = 2,
                      .name = "_GLOBAL",
                      .attributes = attributes({"title", "T", "units", "25.4", "regionid_colortable", "{1 2 3 4 5}"})}
            .bytes() +
        sphere("e") + solid(2, "t", reals({0, 0, 0, 0, 0, 3, 1, 0, 0, 0, 1, 0, 1, 0, 0, 0, 1, 0})) +
        solid(1, "o", reals({0, 0, 0, 0, 0, 1, 3, 1})) +
        solid(14, "n", number(4, 2) + reals({1, 1, 1, 1, -1, 0, 0, 0, 0, -1, 0, 0, 0, 0, -1, 0})) +
        solid(36, "m", number(2, 2) + number(2, 2) + reals({1}) + reals({0, 0, 0, 1, 1, 1, 0, 0, 1, 2})) +
        solid(41, "pts", reals({1}) + number(0, 1) + number(2, 2) + reals({0, 0, 0, 5, 5, 5})) +
        solid(13, "v", "file=num src=o w=2 n=2 d=2 size=1,1,1" + zero) +
        WrittenObject{.major = 9, .minor = 4, .name = "num", .body = "\1\2\3\4\5\6\7\1"}.bytes() +
        combination("c", {.leaves = {{"e", 0}, {"t"}, {"o"}}, .expression = "\1\1\2\1\4", .matrices = {moved}},
                    attributes({"region", "R", "region_id", "7", "color", "1/2/3"})) +
        combination("g", {.leaves = {{"c"}, {"n"}, {"m"}, {"pts"}, {"v"}}});
    return {{"own_v5.asc", v5}, {"own_v4.asc", v4}, {"own.g", g, true}};
}

std::vector<File> all_files() {
    std::vector<File> files = own_files();
    const std::filesystem::path folder = brlcad_test::model_folder();
    if (folder.empty()) return files;
    for (const char* name : {"moss", "boolean-ops", "operators", "prim", "rounds", "bearing", "axis", "aet", "cube"}) {
        for (const char* extension : {".asc", ".g"}) {
            std::ifstream in(folder / (std::string(name) + extension), std::ios::binary);
            if (!in) continue;
            files.push_back({std::string(name) + extension,
                             {std::istreambuf_iterator<char>(in), {}},
                             std::string(extension) == ".g"});
        }
    }
    return files;
}

const std::string fragments[] = {"{",         "}",     "\"",      "\\",  "\n",  " ",           ";",    "#",    "-1",
                                 "0",         "1e308", "-1e-320", "nan", "inf", "99999999999", "put ", "comb", "tree {",
                                 "attr set ", "l c",   "M u c",   "N",   "X",   "G",           "V"};

std::string mutated(const File& file, std::mt19937& random) {
    std::string bytes = file.bytes;
    const auto below = [&](std::size_t n) { return n == 0 ? 0 : static_cast<std::size_t>(random()) % n; };
    for (std::size_t i = 0, changes = 1 + below(2); i < changes && !bytes.empty(); ++i) {
        const std::size_t at = below(bytes.size()), length = below(std::min<std::size_t>(12, bytes.size() - at));
        const std::string& fragment = fragments[below(std::size(fragments))];
        switch (below(8)) {
            case 0:
                bytes.erase(at, length);
                break;
            case 1:
                bytes.insert(at, fragment);
                break;
            case 2:
                bytes.replace(at, length, fragment);
                break;
            case 3:
                bytes[at] = static_cast<char>(random());
                break;
            case 4:
                bytes.insert(below(bytes.size()), bytes.substr(at, length));
                break;
            case 5:
                if (const std::size_t digit = bytes.find_first_of("0123456789", at); digit != std::string::npos)
                    bytes[digit] = static_cast<char>('0' + below(10));
                break;
            case 6:  // one bit, so that lengths and counts of binary files stay near what they were
                bytes[at] = static_cast<char>(bytes[at] ^ (1 << below(8)));
                break;
            default:
                if (below(4) == 0) bytes.resize(at);
                break;
        }
    }
    return bytes;
}

struct Tally {
    int read = 0, compiled = 0;
    std::size_t errors = 0, without_place = 0;
    double slowest = 0;
    std::string first_without_place, slowest_file;
};

void count_places(const Error& error, Tally& tally) {
    const auto count = [&tally](bool placed, const std::string& text) {
        ++tally.errors;
        if (!placed && tally.without_place++ == 0) tally.first_without_place = text;
    };
    if (error.diagnostics().empty()) return count(false, error.what());
    for (const Diagnostic& finding : error.diagnostics()) {
        CHECK_FALSE(finding.message.empty());
        const Place& place = finding.place;
        count(place.line > 0 || place.offset >= 0 || !place.pointer.empty(), format(finding));
    }
}

/// Reads and compiles; anything but an Error escapes, and fails the test.
void load(const File& file, const std::string& bytes, Tally& tally) {
    const auto begin = std::chrono::steady_clock::now();
    try {
        const Scene scene =
            file.binary ? parse_brlcad_g(ByteSource(file.name, bytes)) : parse_brlcad_asc(TextSource(file.name, bytes));
        ++tally.read;
        compile(scene, {}, {.air = true, .skip_unsupported = true});
        ++tally.compiled;
    } catch (const Error& error) {
        CHECK((error.status() == Status::scene || error.status() == Status::out_of_memory));
        count_places(error, tally);
    }
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    if (seconds > tally.slowest) {
        tally.slowest = seconds;
        tally.slowest_file = file.name;
    }
}

void fuzz(const std::vector<File>& files, std::uint32_t seed, int rounds) {
    Tally tally;
    std::mt19937 random(seed);
    for (int i = 0; i < rounds; ++i) {
        const File& file = files[static_cast<std::size_t>(i) % files.size()];
        INFO(file.name << ", seed " << seed << ", round " << i);
        load(file, mutated(file, random), tally);
    }
    INFO(rounds << " files, " << tally.read << " read, " << tally.compiled << " compiled, " << tally.errors
                << " findings, " << tally.without_place << " without a place, slowest " << tally.slowest << " s ("
                << tally.slowest_file << "); first without a place: " << tally.first_without_place);
    CHECK(tally.read > rounds / 10);
    CHECK(tally.compiled > rounds / 20);
    CHECK(tally.errors > static_cast<std::size_t>(rounds / 10));
    CHECK(100 * tally.without_place <= tally.errors);
    CHECK(tally.slowest < (test::sanitized ? 60 : 2));
    SUCCEED();  // shows what was measured, with -s
}

}  // namespace

TEST_CASE("brlcad fuzz: the files that are changed are sound") {
    for (const File& file : own_files()) {
        INFO(file.name);
        Tally tally;
        load(file, file.bytes, tally);
        INFO(tally.first_without_place);
        CHECK(tally.compiled == 1);
    }
}

TEST_CASE("brlcad fuzz: bytes changed, put in, left out") { fuzz(own_files(), 20261125, test::tries(300)); }
TEST_CASE("brlcad fuzz: 3000 files, of BRL-CAD's models too", "[.long][.fuzz]") {
    fuzz(all_files(), 41, test::tries(3000));
}
