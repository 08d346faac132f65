// BRL-CAD's databases with bytes changed, put in and left out: each is read and compiled, or refused with an Error that
// says where; nothing else may happen, and soon. Fixed seeds.
#include <chrono>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>

#include "catch.hpp"

#include <csgrt/scene_io.hpp>

#include "compile/compiled_scene.hpp"
#include "formats/brlcad/asc.hpp"
#include "formats/brlcad/g/reader.hpp"
#include "formats/brlcad/g/bytes.hpp"
#include "formats/brlcad/brlcad_models.hpp"
#include "formats/read_seed.hpp"
#include "formats/text_source.hpp"
#include "sanitized.hpp"

using namespace csgrt;

namespace {

struct File {
    std::string name, bytes;
    bool binary = false;
};

std::vector<File> own_files() {
    std::vector<File> files;
    for (const std::string name : {"asc/v5.asc", "asc/v4.asc", "asc/metaball.asc", "g/v5.g", "g/metaball.g"})
        files.push_back({name, test::read_seed(name), name.ends_with(".g")});
    return files;
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
    return test::changed_at_random(file.bytes, fragments, 2, 12, random);
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

TEST_CASE("brlcad fuzz: begins of files, whose format the bytes tell") {
    std::vector<std::string> begins;
    for (int byte = 0; byte < 256; ++byte) begins.emplace_back(1, static_cast<char>(byte));
    for (const File& file : own_files())
        for (std::size_t length = 0; length <= 100; ++length) begins.push_back(file.bytes.substr(0, length));
    for (const std::string& begin : begins) {
        INFO(begin);
        try {
            parse_scene(begin, "begin");
        } catch (const Error& error) {
            CHECK(error.status() == Status::scene);
        }
    }
}

TEST_CASE("brlcad fuzz: bytes changed, put in, left out", "[promise:untrusted]") {
    fuzz(own_files(), 20261125, test::tries(300));
}
TEST_CASE("brlcad fuzz: 3000 files, of BRL-CAD's models too", "[.long][.fuzz]") {
    fuzz(all_files(), 41, test::tries(3000));
}
