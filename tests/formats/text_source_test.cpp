// Files as text: reading them, places in them, and excerpts that a terminal can show.
#include <filesystem>
#include <fstream>

#include "catch.hpp"
#include "formats/text_source.hpp"
#include "thrown.hpp"

using namespace csgrt;

TEST_CASE("text source: lines and columns", "[text]") {
    const TextSource source("f", "ab\r\n\ncde");
    const auto check = [&](std::size_t offset, int line, int column) {
        INFO(offset);
        const Place place = source.place(offset, "object");
        CHECK(place.file == "f");
        CHECK(place.line == line);
        CHECK(place.column == column);
        CHECK(place.offset == -1);
        CHECK(place.pointer == "object");
    };
    check(0, 1, 1);
    check(2, 1, 3);
    check(4, 2, 1);
    check(5, 3, 1);
    check(7, 3, 3);
    check(8, 3, 4);
    check(1000, 3, 4);
    CHECK(TextSource("f", "").place(0).line == 1);
}

TEST_CASE("text source: excerpts", "[text]") {
    CHECK(TextSource("f", "one\ntwo\r\nthree").excerpt(5) == "two\n ^");
    CHECK(TextSource("f", "one\ntwo\r\nthree").excerpt(8) == "two\n   ^");
    CHECK(TextSource("f", "").excerpt(0) == "\n^");
    // Control characters cannot act on the terminal; characters of several bytes count as one.
    CHECK(TextSource("f", "\x1b[2J\tx").excerpt(5) == " [2J x\n     ^");
    CHECK(TextSource("f", "\u00e9\u00e9x").excerpt(4) == "\u00e9\u00e9x\n  ^");

    const TextSource source("f", std::string(10'000, 'a') + "X" + std::string(10'000, 'b'));
    const std::string excerpt = source.excerpt(10'000);
    CHECK(excerpt.size() < 300);
    const std::size_t newline = excerpt.find('\n');
    CHECK(excerpt.substr(0, 3) == "...");
    CHECK(excerpt.substr(newline - 3, 3) == "...");
    CHECK(excerpt.find('X') == excerpt.size() - 1 - (newline + 1));
}

TEST_CASE("text source: findings leave in the order of the file, all at once", "[text]") {
    const TextSource source("f", "one\ntwo\nthree");
    Findings findings(source);
    findings.throw_if_any();
    findings.add(8, "c", "third", "do this");
    findings.add(Fault{0, "first", {}}, "a");
    CHECK_FALSE(findings.empty());
    const test::Thrown thrown = test::thrown_by([&] { findings.throw_if_any(); });
    CHECK(thrown.status == Status::scene);
    REQUIRE(thrown.findings.size() == 2);
    CHECK(thrown.findings[0].message == "first");
    CHECK(thrown.findings[1].place.pointer == "c");
    CHECK(thrown.findings[1].suggestion == "do this");
    CHECK(thrown.findings[1].excerpt == "three\n^");
}

TEST_CASE("text source: files", "[text]") {
    const auto folder = std::filesystem::temp_directory_path();
    const auto path = folder / "csgrt_text_source_test.txt";
    const std::string text = std::string("a\0b\n", 4) + std::string(200'000, 'x');
    std::ofstream(path, std::ios::binary) << text;
    CHECK(TextSource::read(path.string()).text() == text);
    std::filesystem::remove(path);

    for (const std::string& bad : {path.string(), folder.string()}) {
        const test::Thrown thrown = test::thrown_by([&] { TextSource::read(bad); });
        CHECK(thrown.status == Status::file);
        REQUIRE(thrown.findings.size() == 1);
        CHECK(thrown.findings[0].place.file == bad);
    }
}
