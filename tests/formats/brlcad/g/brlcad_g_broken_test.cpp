// Binary databases that are wrong: what is found, where, and that nothing else happens.
#include <limits>

#include "formats/brlcad/brlcad_asc_text.hpp"
#include "formats/brlcad/g/reader.hpp"
#include "formats/brlcad/g/bytes.hpp"
#include "formats/brlcad/g/brlcad_g_writer.hpp"
#include "thrown.hpp"

using namespace csgrt;
using namespace csgrt::g_test;

namespace {

std::vector<Diagnostic> findings_in(const std::string& bytes) {
    return asc_test::findings_by([&] { parse_brlcad_g(ByteSource("model.g", bytes)); });
}

/// One finding in the whole file.
void check_file(const std::string& bytes, std::int64_t offset, const std::string& object, const std::string& message) {
    INFO(message);
    const auto findings = findings_in(bytes);
    REQUIRE(findings.size() == 1);
    INFO(format(findings[0]));
    CHECK(findings[0].place.file == "model.g");
    CHECK(findings[0].place.offset == offset);
    CHECK(findings[0].place.pointer == object);
    CHECK(findings[0].message.find(message) != std::string::npos);
}

/// One finding in an object that stands between two sound ones; `offset` counts from its first byte.
void check_object(const std::string& bytes, std::int64_t offset, const std::string& object,
                  const std::string& message) {
    const std::string before = header + sphere("before");
    check_file(before + bytes + sphere("after"), static_cast<std::int64_t>(before.size()) + offset, object, message);
}

std::string changed(std::string bytes, std::size_t at, const std::string& by) {
    return bytes.replace(at, by.size(), by);
}

// The bytes before the body of an object "x" whose lengths have one byte: its head, its name, the body's length.
constexpr std::int64_t body_at = 7 + 3 + 1;
// And those of a combination's body before its matrices.
constexpr std::int64_t members_at = body_at + 6;

void check_members(const Members& members, std::int64_t offset, const std::string& message) {
    check_object(combination("x", members), offset, "x", message);
}

void check_body(int type, const std::string& body, std::int64_t offset, const std::string& message) {
    check_object(WrittenObject{.minor = type, .name = "x", .body = body}.bytes(), offset, "x", message);
}

}  // namespace

TEST_CASE("g: what is no database of release 5 is refused", "[g][broken]") {
    check_file("", 0, "", "empty");
    check_file("I\1v4" + std::string(100, '\0'), 0, "", "release 4");
    check_file("title {T}\nunits mm\n", 0, "", "no object starts here");
    check_file("v", 1, "", "only 0 are left");
    check_file(header.substr(0, 6), 6, "", "only 0 are left");
    check_file(header.substr(0, 7), 6, "", "the file ends after 7 bytes");
    check_file(sphere("a"), 0, "a", "does not start with the header");

    CHECK(test::says(test::failure(Status::file, [] { read_brlcad_g("no such folder/model.g"); }),
                     "no such folder/model.g"));
}

TEST_CASE("g: frames", "[g][broken]") {
    const std::string ball = sphere("x");
    const auto end = static_cast<std::int64_t>(ball.size());
    // Where the next object starts cannot be told after these, so they end the reading.
    check_object(changed(ball, 0, "w"), 0, "", "no object starts here");
    check_object(changed(ball, 6, "\xFF"), 6, "x", "255 times 8 bytes long, but the file ends after");
    check_object(changed(ball, 6, zero), 6, "x", "0 bytes long, less than");
    check_object(changed(ball, 6, "\1"), 7, "x", "not 0x35");
    check_object(changed(ball, static_cast<std::size_t>(end) - 1, "6"), end - 1, "x", "not 0x35");
    const std::string wide = WrittenObject{.minor = 3, .name = "x", .body = counted_reals(1, 12), .width = 3}.bytes();
    check_object(changed(wide, 6, number(~std::uint64_t{0}, 3)), 6, "x", "but the file ends after");
    check_object(changed(wide, 6, number(std::uint64_t{1} << 61, 3)), 6, "x", "but the file ends after");
    check_file(header + ball.substr(0, 20), 14, "x", "the file ends after 20");

    // After these, it goes on.
    check_object(changed(ball, 1, "\x23"), 1, "x", "neither data, nor header, nor free");
    check_object(header, 0, "", "second header");
    check_object(WrittenObject{.minor = 3, .body = counted_reals(1, 12)}.bytes(), 0, "", "no name");
    check_object(changed(ball, 7, "\xFF"), 8, "", "the name: 255 bytes are needed");
    check_object(changed(ball, 7, "\1"), 8, "", "the name does not end");
    check_object(changed(ball, 8, zero), 8, "", "the name is empty");
    check_object(changed(ball, 7, "\3"), 10, "", "the name goes on");
    check_object(changed(ball, 10, "\xFF"), 11, "x", "the body: 255 bytes are needed");
    check_object(changed(wide, 6 + 8 + 8 + 2, number(~std::uint64_t{0}, 3)), 6 + 8 + 8 + 2 + 8, "x",
                 "the body: 18446744073709551615 bytes");
}

TEST_CASE("g: solids that are wrong", "[g][broken]") {
    check_body(1, counted_reals(1, 7), body_at + 56, "r_h: 8 bytes are needed");
    check_body(2, counted_reals(1, 19), body_at + 144, "the body of the tgc should end here, but has 8 bytes more");
    check_body(3, "", body_at - 1, "V: 8 bytes are needed");
    check_body(4, counted_reals(1, 24) + "1", body_at + 192, "has 1 bytes more");
    check_body(6, reals({0, 0, std::numeric_limits<double>::quiet_NaN(), 1}), body_at + 16, "not a finite number");
    check_body(20, counted_reals(1, 11) + reals({std::numeric_limits<double>::infinity()}), body_at + 88,
               "c is not a finite");
    check_body(14, number(1, 1), body_at, "the number of planes");
    check_body(14, number(0, 2), body_at, "0 planes");
    check_body(14, number(0xFFFFFFFF, 2) + counted_reals(1, 4), body_at, "4294967295 of 32 bytes each do not fit");
    check_body(14, number(2, 2) + counted_reals(1, 4), body_at, "2 of 32 bytes each do not fit");
    const WrittenObject packed{.minor = 3, .name = "x", .body = counted_reals(1, 12), .compression = 1};
    check_object(packed.bytes(), body_at, "x", "compressed");
}

TEST_CASE("g: combinations that are wrong", "[g][broken]") {
    std::vector<double> not_a_number(16, 1);
    not_a_number[3] = std::numeric_limits<double>::quiet_NaN();

    check_body(31, "\4", body_at, "width of the numbers is 4");
    check_body(31, zero + "\1\1", body_at + 3, "the size of the leaves");
    check_object(WrittenObject{.minor = 31, .name = "x"}.bytes(), body_at - 1, "x", "the width of the numbers");
    check_members({.leaves = {{"a"}}, .matrix_count = 2}, body_at + 1, "2 matrices do not fit");
    constexpr auto most = std::numeric_limits<std::int64_t>::max();
    check_members({.leaves = {{"a"}}, .width = 3, .matrix_count = most}, body_at + 1, "matrices do not fit");
    check_members({.leaves = {{"a"}}, .width = 3, .leaf_bytes = most}, body_at + 1 + 5 * 8, "the leaves: ");
    check_members({.leaves = {{"a"}}, .width = 3, .leaf_count = most}, body_at + 1 + 5 * 8 + 2 + 8,
                  "the name of a leaf");
    check_members({.leaves = {{"a"}}, .leaf_bytes = 200}, members_at, "the leaves: 200 bytes are needed");
    check_members({.leaves = {{"a"}}, .leaf_bytes = 2}, members_at + 2, "the number of a leaf's matrix");
    check_members({.leaves = {{"a"}}, .leaf_bytes = 1}, members_at, "the name of a leaf does not end");
    check_members({.leaves = {{"a"}}, .leaf_count = 2}, members_at + 3, "the name of a leaf does not end");
    check_members({.leaves = {{"a"}}, .leaf_count = 0}, members_at, "the leaves go on");
    check_members({.leaves = {{""}}}, members_at, "the name of a leaf is empty");
    check_members({.leaves = {{"a", 0}}}, members_at + 2, "the leaf has matrix 0, but there are 0");
    check_members({.leaves = {{"a", -2}}}, members_at + 2, "the leaf has matrix -2");
    check_members({.leaves = {{"a", 0}}, .matrices = {not_a_number}}, members_at + 24, "not a finite number");
    check_members({.leaves = {{"a"}}, .expression = "\1", .expression_length = 5}, members_at + 3,
                  "the expression: 5 bytes");
    check_members({.leaves = {{"a"}}, .expression = "\1", .expression_length = 0}, members_at + 3, "the body goes on");
    check_members({.leaves = {{"a"}}, .expression = "\2"}, members_at + 3, "0 operands, not 2");
    check_members({.leaves = {{"a"}}, .expression = "\1\4"}, members_at + 4, "1 operands, not 2");
    check_members({.leaves = {{"a"}}, .expression = "\6\1"}, members_at + 3, "0 operands, not 1");
    check_members({.leaves = {{"a"}}, .expression = "\1\7"}, members_at + 4, "7 is no token");
    check_members({.leaves = {{"a"}}, .expression = "\1\1"}, members_at + 4, "needs more leaves than the 1");
    check_members({.leaves = {{"a"}, {"b"}}, .expression = "\1"}, members_at + 6, "uses 1 of 2 leaves");
    check_members({.leaves = {{"a"}, {"b"}}, .expression = "\1\1"}, members_at + 6, "leaves 2 operands");
}

TEST_CASE("g: attributes that are wrong", "[g][broken]") {
    // The attributes stand where the body would, whose length comes after them.
    const auto with = [](const std::string& keys) { return combination("x", {.leaves = {{"a"}}}, keys); };
    check_object(with("region"), body_at, "x", "an attribute does not end");
    check_object(with("region" + zero + "R"), body_at + 7, "x", "an attribute's value does not end");
    check_object(with("region" + zero), body_at + 7, "x", "an attribute's value does not end");
    check_object(with(attributes({"region", "maybe"})), body_at + 7, "x", "neither yes nor no");
    check_object(with(attributes({"los", "100", "color", "1/2/300"})), body_at + 8 + 6 + 4, "x", "outside 0 to 255");
    const WrittenObject packed{.major = 2, .name = "_GLOBAL", .attributes = attributes({"k", "v"}), .compression = 1};
    check_object(packed.bytes(), body_at + 6, "_GLOBAL", "compressed");
}

TEST_CASE("g: names must be unique", "[g][broken]") {
    const std::string first = sphere("a");
    check_file(header + first + sphere("a"), static_cast<std::int64_t>(8 + first.size()), "a",
               "this name is taken by the object at byte 8");
}

TEST_CASE("g: several findings are reported at once, in the order of the file", "[g][broken]") {
    const auto bad = [](const std::string& name) {
        return WrittenObject{.minor = 6, .name = name, .body = "123"}.bytes();
    };
    const auto findings = findings_in(header + bad("a") + sphere("s") + bad("b") + bad("c") + "rubbish");
    REQUIRE(findings.size() == 4);
    CHECK(findings[0].place.pointer == "a");
    CHECK(findings[1].place.pointer == "b");
    CHECK(findings[2].place.pointer == "c");
    CHECK(findings[3].message.find("no object starts here") != std::string::npos);

    std::string many = header;
    for (int i = 0; i < 200; ++i) many += bad("x");
    CHECK(findings_in(many).size() == FindingList::most + 1);
}

TEST_CASE("g: any end of a file, and any byte in it, gives a scene or findings", "[g][broken]") {
    const std::string members = combination("c",
                                            {.leaves = {{"a", 0}, {"b"}, {"n"}},
                                             .expression = "\1\1\2\1\6\4",
                                             .matrices = {{1, 0, 0, 4, 0, 1, 0, 6, 0, 0, 1, 8, 0, 0, 0, 0.5}}},
                                            attributes({"region", "R", "color", "1/2/3", "shader", "glass {tr 0.5}"}));
    const WrittenObject objects[] = {
        {.major = 2, .name = "_GLOBAL", .attributes = attributes({"units", "1", "regionid_colortable", "{1 2 3 4 5}"})},
        {.minor = 14, .name = "n", .body = number(1, 2) + counted_reals(1, 4)},
        {.kind = 2, .width = 1},
        {.minor = 37, .name = "b", .body = "surface", .width = 2},
    };
    std::string bytes = header + sphere("a") + members;
    for (const WrittenObject& object : objects) bytes += object.bytes();
    const auto parse = [](const std::string& changed) { parse_brlcad_g(ByteSource("model.g", changed)); };
    REQUIRE_NOTHROW(parse(bytes));
    const std::string values("\0\1\2\6\x1F\x20\x35\x60\x76\x7F\x80\xE0\xFF", 13);
    const asc_test::Attempts attempts = asc_test::changed(bytes, values, parse);
    CHECK(attempts.read > 500);
    CHECK(attempts.refused > 1000);
}

TEST_CASE("g: cells whose size is no number, or far too large, are refused with the object and its byte",
          "[g][broken]") {
    const auto at = [](const std::string& body, const std::string& value) {
        return body_at + static_cast<std::int64_t>(body.find(value));
    };
    for (const char* value : {"nan", "-nan", "inf"}) {
        const std::string vol = "file=b src=o w=1 n=2 d=3 size=1," + std::string(value) + ",3" + zero;
        check_body(13, vol, at(vol, value), "is not a");
        const std::string ebm = "file=b src=o w=2 n=3 d=" + std::string(value) + zero;
        check_body(12, ebm, at(ebm, value), "is not a");
        const std::string placed =
            "file=b src=o w=2 n=3 d=4 mat=1,0,0,5,0,1,0,6,0," + std::string(value) + ",1,7,0,0,0,1" + zero;
        check_body(12, placed, at(placed, value), "is not a");
    }
    Matrix elements = identity;
    elements[5] = std::numeric_limits<double>::quiet_NaN();
    const std::string dsp =
        number(2, 2) + number(2, 2) + reals({elements.begin(), elements.end()}) + number(1, 1) + "oLh" + zero;
    check_body(25, dsp, body_at + 8 + 5 * 8, "an element of the dsp's matrix is not a finite number");

    // Finite, and so they are read; but what is computed of them overflows.
    elements = identity;
    elements[0] = elements[5] = elements[10] = 1e200;
    const std::string before = header +
                               WrittenObject{.major = 9, .minor = 4, .name = "b", .body = "\1\2\3\4\5\6"}.bytes() +
                               WrittenObject{.major = 9, .minor = 5, .name = "h", .body = "\1\2\1\2\1\2\1\2"}.bytes();
    const auto refused = [&](int type, const std::string& body, const std::string& message) {
        INFO(message);
        const std::string x = WrittenObject{.minor = type, .name = "x", .body = body}.bytes();
        const Scene scene = parse_brlcad_g(ByteSource("model.g", before + x));
        const std::vector<Diagnostic> findings = validate(scene, {"x"});
        REQUIRE(findings.size() == 1);
        INFO(format(findings[0]));
        CHECK(findings[0].place.file == "model.g");
        CHECK(findings[0].place.offset == static_cast<std::int64_t>(before.size()));
        CHECK(findings[0].message.find("solid 'x': " + message) == 0);
        CHECK(findings[0].message.find("the largest size and distance from the origin is 1e+15 mm") !=
              std::string::npos);
    };
    refused(13, "file=b src=o w=1 n=2 d=3 lo=1 hi=9 size=1,1e200,3" + zero, "it has the number 1e+200; ");
    refused(12, "file=b src=o w=2 n=3 d=1e308" + zero, "it has the number 1e+308; ");
    refused(25, number(2, 2) + number(2, 2) + reals({elements.begin(), elements.end()}) + number(1, 1) + "oLh" + zero,
            "the matrix has a number that is not finite, or far too large: 1e+200; ");
}
