// Small files, large cost: each is read in a second or two and less than a gibibyte, or refused.
#include <functional>
#include <random>

#include "cli/command.hpp"
#include "sanitized.hpp"

using namespace command_test;

namespace {

const std::string head = "title {}\nunits mm\n", region = "put r comb region yes id 1 tree ";
const std::string still = "{1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1}";

std::string repeated(std::size_t count, const std::function<std::string(std::size_t)>& part) {
    std::string text;
    for (std::size_t i = 0; i < count; ++i) text += part(i);
    return text;
}
std::string number(std::size_t i) { return std::to_string(i); }
std::string ball(const std::string& name, double radius = 1) {
    const std::string r = std::to_string(radius);
    return "put {" + name + "} ell V {0 0 0} A {" + r + " 0 0} B {0 " + r + " 0} C {0 0 " + r + "}\n";
}
/// `count` combinations above `below`, each a union of two of the one before.
std::string doubled(const std::string& below, std::size_t count, bool is_region) {
    return repeated(count, [&](std::size_t i) {
        const std::string name = i == 0 ? below : "c" + number(i - 1);
        return "put c" + number(i) + " comb region " + (is_region && i + 1 == count ? "yes" : "no") + " tree {u {l " +
               name + " {1 0 0 " + number(3 << std::min<std::size_t>(i, 40)) + " 0 1 0 0 0 0 1 0 0 0 0 1}} {l " + name +
               "}}\n";
    });
}
std::string closed_sketch(std::size_t count) {
    return "put {sk} sketch V {0 0 0} A {1 0 0} B {0 1 0} VL { " +
           repeated(
               count,
               [&](std::size_t i) { return "{" + number(i) + " " + number(i % 2 + (i == 0 ? count : 0)) + "} "; }) +
           "} SL { " +
           repeated(count,
                    [&](std::size_t i) { return "{line S " + number(i) + " E " + number((i + 1) % count) + "} "; }) +
           "}\n";
}
std::string metaball(const std::string& name, int method, std::size_t points) {
    std::minstd_rand random(1);
    return "put " + name + " metaball method " + number(method) + " thresh 1 PL { " +
           repeated(points,
                    [&](std::size_t) {
                        const auto next = [&] { return number(random() % 1000) + " "; };
                        return "{" + next() + next() + next() + "2 1} ";
                    }) +
           "}\n";
}

/// Runs the command, within a gibibyte; `said` must be in what it prints.
void check(const std::vector<std::string>& words, int status, const std::string& said) {
    const Folder folder;
    rusage used{};
    const pid_t child = start(words, "/dev/null", folder / "out", folder / "err");
    int ended = 0;
    REQUIRE(wait4(child, &ended, 0, &used) == child);
    const std::string text = read_file(folder / "out") + read_file(folder / "err");
    INFO(said << "\n" << text.substr(0, 2000));
    CHECK((WIFEXITED(ended) ? WEXITSTATUS(ended) : 128 + WTERMSIG(ended)) == status);
    CHECK(contains(text, said));
    CHECK(used.ru_maxrss < 1 << 20);  // KiB
    CHECK(used.ru_utime.tv_sec < 20);
}

}  // namespace

TEST_CASE("small files of nine kinds cost little, or are refused", "[promise:untrusted][promise:limits]") {
    NEEDS_COMMAND();
    if (csgrt::test::sanitized) return;  // they cost the sanitizer minutes
    const Folder folder;
    const auto info = [&](const std::string& name, const std::string& text, int status, const std::string& said) {
        check({"info", folder.write(name, text), "--depth", "0"}, status, said);
    };
    const auto asc = [&](const std::string& text, int status, const std::string& said) {
        info("m.asc", head + text, status, said);
    };
    const std::string many = "instances; at most 300000 are allowed";

    // Graphs of unions: within one region, and of regions; of chains, and of long names.
    for (const std::size_t doublings : {20, 40}) {
        asc(ball("s") + doubled("s", doublings, true), 3, many);
        asc(ball("s") + region + "{l s}\n" + doubled("r", doublings, false), 3, many);
    }
    asc(ball("s") + doubled("s", 10, true), 0, "solids    1024");
    const std::string chain = repeated(900, [](std::size_t i) {
        return "put k" + number(i) + " comb region no tree {l " + (i == 0 ? "r" : "k" + number(i - 1)) + "}\n";
    });
    asc(ball("s") + region + "{l s}\n" + chain + doubled("k899", 14, false), 0,
        "references to combinations and solids");
    const std::string long_name(20'000, 'n');
    asc(ball(long_name) + doubled(long_name, 16, true), 3, many);

    // Names that nothing has, nesting.
    info("m.json",
         R"({"csgrt":1,"solids":{"b":{"type":"sphere","center":[0,0,0],"radius":1}},)"
         R"("combinations":{"c":{"tree":{"union":["b")" +
             repeated(20'000, [](std::size_t i) { return ",\"no" + number(i) + "\""; }) + "]}}}}",
         3, "and 19950 more errors");
    asc(ball("b") + repeated(5'000,
                             [](std::size_t i) {
                                 return "put c" + number(i) + " comb region no tree {u {l b} {l no" + number(i) +
                                        "}}\n";
                             }),
        0, "there is no such object");
    info("m.json", std::string(1'000'000, '['), 3, "brackets are nested more than 512 deep");
    asc(ball("s") + region + repeated(50'000, [](std::size_t) { return "{u {l s} "; }) + "{l s}" +
            std::string(50'000, '}') + "\n",
        0, "solids    1");

    // Cells, of one file under many names; sketches; meshes.
    std::string cells(32 * 32 * 32, '\0');
    for (std::size_t i = 0; i < cells.size(); ++i) cells[i] = static_cast<char>((i + i / 32 + i / 1024) & 1);
    folder.write("cells", cells);
    const auto vol = [](std::size_t i) {
        return "put v" + number(i) + " vol file " + repeated(i, [](std::size_t) { return "./"; }) +
               "cells src f w 32 n 32 d 32 lo 1 hi 255 size {1 1 1} mat " + still + "\n";
    };
    asc(vol(0), 0, "solids    1");
    asc(repeated(100, vol), 3, many);
    asc(closed_sketch(5'000) + repeated(100,
                                        [](std::size_t i) {
                                            return "put e" + number(i) +
                                                   " extrude V {0 0 0} H {0 0 1} A {1 0 0} B {0 1 0} S sk\n";
                                        }),
        3, many);
    const std::size_t edges = 5'000;  // on one line
    asc("put s bot mode volume orient no V { {0 1 0} {0 0 1} " +
            repeated(edges + 1, [](std::size_t i) { return "{" + number(i) + " 0 0} "; }) + "} F { " +
            repeated(edges, [](std::size_t i) { return "{0 2 " + number(i + 3) + "} {1 2 " + number(i + 3) + "} "; }) +
            "}\n",
        0, "too many of them lie on one another");

    // Metaballs.
    asc(metaball("s", 0, 1'000) + doubled("s", 12, true), 3, many);
    asc(repeated(20, [](std::size_t i) { return metaball("s" + number(i), 1, 1'000); }), 3, many);

    // Regions that overlap, and rays.
    const std::string overlap =
        folder.write("overlap.asc", head + repeated(500, [](std::size_t i) {
                                        return ball("s" + number(i), 100 + 0.001 * static_cast<double>(i)) + "put r" +
                                               number(i) + " comb region yes id 1 tree {l s" + number(i) + "}\n";
                                    }));
    check({"info", overlap, "--depth", "0"}, 0, "regions   500");
    check({"shoot", overlap, "--rays", folder.write("rays", "0 0 -1000 0 0 1\n")}, 0, "\n");
    check({"shoot", overlap, "--rays", folder.write("rays", std::string(1'000'000, '1'))}, 6, "the number");
    check({"shoot", overlap, "--rays", folder.write("rays", repeated(300'000, [](std::size_t) { return "0\n"; }))}, 6,
          "and 299950 more errors");
}

TEST_CASE("a scene runs no program", "[promise:untrusted]") {
    NEEDS_COMMAND();
    const Folder folder;
    const std::string made = folder / "made";
    for (const std::string& command :
         {"[exec touch " + made + "]", "exec touch " + made, "$[exec touch " + made + "]"}) {
        const std::string scene = folder.write(
            "m.asc", head + ball("s") + command + "\nput {" + command + "} comb region yes tree {l " + command + "}\n");
        run({"info", scene});
        run({"shoot", scene, "--rays", folder.write("rays", command + "\n")});
        CHECK(!fs::exists(made));
    }
}
