// The views that MGED's saveview writes.
#include "catch.hpp"

#include <cmath>
#include <string>
#include <vector>

#include "formats/text_source.hpp"
#include "formats/brlcad/view_script.hpp"
#include "thrown.hpp"

using namespace csgrt;

namespace {

Camera view_of(const std::string& text) { return parse_view_script(TextSource("view.rt", text)); }

std::vector<Diagnostic> findings_in(const std::string& text) {
    const test::Thrown thrown = test::thrown_by([&] { view_of(text); });
    CHECK((thrown.status == Status::scene || thrown.status == Status::ok));
    return thrown.findings;
}

void check(const Vec3& found, double x, double y, double z, double within = 1e-9) {
    CHECK_THAT(found.x, Catch::Matchers::WithinAbs(x, within));
    CHECK_THAT(found.y, Catch::Matchers::WithinAbs(y, within));
    CHECK_THAT(found.z, Catch::Matchers::WithinAbs(z, within));
}

/// From the eye to what it looks at, of length 1.
Vec3 sight(const Camera& camera) {
    const Vec3 &a = *camera.eye, &b = *camera.look_at;
    const double length = std::hypot(b.x - a.x, b.y - a.y, b.z - a.z);
    return {(b.x - a.x) / length, (b.y - a.y) / length, (b.z - a.z) / length};
}

}  // namespace

TEST_CASE("view script: what saveview writes, with a shell around it", "[promise:views]") {
    const Camera camera = view_of(
        "#!/bin/sh\nrt -M -P2 -p40 \\\n -o view.pix\\\n $*\\\n 'moss.g'\\\n 'all.g' \\\n 2>> view.log\\\n <<EOF\n"
        "viewsize 2.78032073974600e+02;\n"
        // MGED's azimuth 35, elevation 25
        "orientation 2.480973490458727e-01 4.765905732660483e-01 7.480973490458729e-01 3.894348305183902e-01;\n"
        "eye_pt 3.77725447217079e+02 2.50271935188149e+02 1.83225388602861e+02;\n"
        "start 0; clean;\nend;\n\nEOF\n");
    CHECK(camera.perspective == 40);
    CHECK_FALSE(camera.view_size);  // the eye and the perspective give it
    check(*camera.eye, 377.725447217079, 250.271935188149, 183.225388602861, 0);
    const double a = 35 * 3.14159265358979323846 / 180, e = 25 * 3.14159265358979323846 / 180;
    check(sight(camera), -std::cos(e) * std::cos(a), -std::cos(e) * std::sin(a), -std::sin(e));
    check(*camera.up, -std::sin(e) * std::cos(a), -std::sin(e) * std::sin(a), std::cos(e));
}

TEST_CASE("view script: the commands alone, and other ways to say a direction") {
    const std::string rest = "viewsize 10; eye_pt 100 0 0;";
    for (const std::string direction : {"orientation 0.5 0.5 0.5 0.5", "ae 0 0", "lookat_pt 0 0 0", "lookat_pt 0 0 0 0",
                                        "viewrot 0 1 0 0  0 0 1 0  1 0 0 0  0 0 0 1", "orientation 1 1 1 1"}) {
        INFO(direction);
        const Camera camera = view_of(rest + direction + ";end;");
        CHECK(camera.perspective == 0);
        CHECK(camera.view_size == 10);
        check(sight(camera), -1, 0, 0);
        check(*camera.up, 0, 0, 1);
    }
    CHECK(view_of(rest + "ae 0 0; set perspective=25 rt_bot_minpieces=1; end;").perspective == 25);
    // Of several frames the first.
    CHECK(view_of(rest + "ae 0 0; start 0; end; start 1; viewsize 20; end;").view_size == 10);
    CHECK(view_of("\xef\xbb\xbf" + rest + "ae 90 0").view_size == 10);
}

TEST_CASE("view script: what is wrong is named, with its place") {
    const struct {
        const char *text, *says;
        int line;
    } cases[] = {
        {"viewsize 1;\nae 0 0;\n", "this view lacks its eye", 3},
        {"eye_pt 1 2 3;\nae 0 0;", "this view lacks its size", 2},
        {"eye_pt 1 2 3;\nviewsize 3;", "this view lacks its direction", 2},
        {"", "this view lacks its size", 1},
        {"viewsize nan;", "'nan' is not a finite number", 1},
        {"viewsize -3;", "greater than 0", 1},
        {"viewsize;", "'viewsize' takes 1 number", 1},
        {"eye_pt 1 2;", "'eye_pt' takes 3 numbers", 1},
        {"\n\norientation 0 0 0 0;", "no rotation", 3},
        {"viewrot 1 0 0 0  1 0 0 0  1 0 0 0  0 0 0 1;", "no rotation", 1},
        {"lookat_pt 1 2 3;", "must come after 'eye_pt'", 1},
        {"eye_pt 1 2 3; lookat_pt 1 2 3;", "stands at the point", 1},
        {"set perspective=200;", "below 180 degrees", 1},
        {"orientaton 1 0 0 0;", "is no command of a saved view", 1},
        {"#!/bin/sh\nrt -p190 x.g <<EOF\nviewsize 1;\nEOF\n", "below 180 degrees", 2},
        {"#!/bin/sh\nls\n", "feeds no commands to rt", 1},
        {"{\"csgrt\": 1}", "is no command of a saved view", 1},
    };
    for (const auto& [text, says, line] : cases) {
        INFO(text);
        const auto found = findings_in(text);
        REQUIRE_FALSE(found.empty());
        INFO(format(found[0]));
        CHECK(found[0].message.find(says) != std::string::npos);
        CHECK(found[0].place.line == line);
    }
}
