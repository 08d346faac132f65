// Texts that nobody would write: each is read, or refused with an Error; nothing else may happen. Fixed seeds.
#include "catch.hpp"

#include <random>

#include "formats/json/parse_text.hpp"
#include "formats/json/write/writer.hpp"
#include "formats/read_seed.hpp"
#include "formats/same_scene.hpp"
#include "sanitized.hpp"

using namespace csgrt;

namespace {

const std::string& everything() {
    static const std::string text = test::read_seed("json/everything.json");
    return text;
}

// clang-format off
const std::string fragments[] = {
    "{", "}", "[", "]", ",", ":", "\"", "null", "true", "-", "1e999", "NaN", "0", "1e308", "-0", "\\u0000",
    "\\ud800", "\xff", "\"not\": ", "{\"not\": ", "\"s\"", "\"c\"", "\"f\"", "[[[[[[[[", "1e-400",
    "{\"object\": \"f\"}", "\"type\": \"tgc\"", "9999999999999999999999", "\n", "//", "\"\""};
// clang-format on

std::string mutated(std::mt19937& random) { return test::changed_at_random(everything(), fragments, 3, 40, random); }

/// A number, name or bracket for another: far more of these are still JSON, and reach the readers behind the parser.
std::string swapped_token(std::mt19937& random) {
    std::vector<std::pair<std::size_t, std::size_t>> tokens;
    for (std::size_t i = 0; i < everything().size();) {
        const std::size_t begin = i;
        if (everything()[i] == '"') {
            i = everything().find('"', i + 1) + 1;
        } else if (std::string_view("-0123456789.e").find(everything()[i]) != std::string_view::npos) {
            i = everything().find_first_not_of("-0123456789.e", i);
        } else {
            ++i;
            continue;
        }
        tokens.emplace_back(begin, i - begin);
    }
    std::string text = everything();
    for (int change = 0; change < 2; ++change) {
        const auto [to, to_length] = tokens[random() % tokens.size()];
        const auto [from, from_length] = tokens[random() % tokens.size()];
        if (text.size() == everything().size() || to < from)
            text.replace(to, to_length, everything(), from, from_length);
    }
    return text;
}

/// Whether the text was read. Anything but an Error escapes, and fails the test.
bool survives(const std::string& text) {
    try {
        const Scene scene = scene_of(text);
        for (const Diagnostic& finding : validate(scene)) CHECK_FALSE(finding.message.empty());
        CHECK(same_scene(scene, scene_of(json_scene_text(scene))));
        return true;
    } catch (const Error& error) {
        CHECK(error.status() == Status::scene);
        REQUIRE_FALSE(error.diagnostics().empty());
        for (const Diagnostic& finding : error.diagnostics()) {
            CHECK_FALSE(finding.message.empty());
            CHECK(finding.place.file == "scene.json");
            CHECK(finding.place.line > 0);
            CHECK(finding.place.column > 0);
        }
        return false;
    }
}

}  // namespace

TEST_CASE("json fuzz: the text that is changed is sound") {
    CHECK(survives(everything()));
    for (const Diagnostic& finding : validate(scene_of(everything()))) FAIL_CHECK(format(finding));
}

TEST_CASE("json fuzz: bytes changed, put in, left out", "[promise:untrusted]") {
    std::mt19937 random(20240607);
    int read = 0;
    constexpr int rounds = test::tries(2000);
    for (int i = 0; i < rounds; ++i) {
        const std::string text = mutated(random);
        INFO(text);
        read += survives(text);
    }
    CHECK(read > rounds / 100);  // some changes only change a number
    CHECK(read < rounds / 2);
}

TEST_CASE("json fuzz: values in each other's places") {
    std::mt19937 random(7);
    int read = 0;
    constexpr int rounds = test::tries(2000);
    for (int i = 0; i < rounds; ++i) {
        const std::string text = swapped_token(random);
        INFO(text);
        read += survives(text);
    }
    CHECK(read > rounds / 20);
    CHECK(read < rounds - rounds / 20);
}

TEST_CASE("json fuzz: cut off at every byte") {
    for (std::size_t length = 0; length < everything().size(); length += 7) {
        INFO(length);
        CHECK_FALSE(survives(everything().substr(0, length)));
    }
}
