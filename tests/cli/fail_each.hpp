// Commands of which the first thing of a kind fails, then the second, and so on: each gives the answer that it gives
// otherwise, or says why it cannot, and keeps the old file.
#pragma once

#include <set>
#include <string>
#include <vector>

#include "cli/command.hpp"
#include "faults/draw.hpp"

namespace command_test {

/// One of `step` of what tests/faults/ counts under the variable `kind`, alone and with all that follow, in commands
/// that read or write pictures, or in others. One that does not give its answer ends with one of `refusals`; with 130
/// among these, one that waits for libraries and says so is interrupted.
inline void fail_each(const std::string& kind, unsigned long step, bool pictures, const std::set<int>& refusals) {
    const char* library = std::getenv("CSGRT_FAIL_LIBRARY");
    if (library == nullptr) {
        WARN("CSGRT_FAIL_LIBRARY names no library: skipped");
        return;
    }
    const Folder inputs, folder;
    const std::string scene = inputs.write("balls.asc", two_balls), told = inputs / "told",
                      rays = inputs.write("rays", "-100 0.1 0.2 1 0 0\n0 0 1000 0 0 -1\n"), shot = inputs / "shot",
                      drawn = inputs / "drawn.exr", model = folder / "x.json", answers = folder / "x.txt",
                      picture = folder / "x.exr";
    REQUIRE(run({"shoot", scene, "--rays", rays, "--device", "native", "-o", shot}).status == 0);
    std::vector<std::vector<std::string>> commands = {
        {"devices"},
        {"compare", shot, shot},
        {"convert", scene, model},
        {"shoot", scene, "--rays", rays, "--device", "native", "--threads", "3", "-o", answers},
        {"shoot", scene, "--rays", rays, "--reference", "--threads", "3", "-o", answers},
        {"verify", scene, "--rays", "20", "--device", "native", "--threads", "3"},
    };
    if (pictures) {
        REQUIRE(run({scene, "--size", "24", "--device", "native", "-o", drawn}).status == 0);
        commands = {
            {"compare", drawn, drawn},
            {scene, "--size", "24", "--device", "native", "--threads", "3", "-o", picture},
            {scene, "--size", "24", "--reference", "--threads", "3", "-o", picture},
        };
    }
    csgrt::test::FaultDraw draw(step);
    int all_runs = 0;
    for (const std::vector<std::string>& words : commands) {
        std::string line;
        for (const std::string& word : words) line += fs::path(word).filename().string() + " ";
        const std::string target = words.back().starts_with(folder / "") ? words.back() : "";
        const auto answer = [&](const How& how) {
            std::error_code ignored;
            fs::remove(told, ignored);
            if (!target.empty()) std::ofstream(target) << "old";
            Result result = run(words, how);
            if (!target.empty()) result.out += read_file(target);
            return result;
        };
        const Result expected = answer({});
        REQUIRE(expected.status == 0);
        unsigned long last = 0;
        int runs = 0, refused = 0;
        for (const bool on : {false, true})
            for (unsigned long number = draw.first();; number += step) {
                How how;
                how.environment = {{"LD_PRELOAD", library}, {kind, std::to_string(number)}, {kind + "_TOLD", told}};
                if (on) how.environment.push_back({kind + "_ON", "1"});
                if (refusals.contains(130)) how.patience = 10;
                const Result result = answer(how);
                if (!fs::exists(told)) break;
                INFO(line << kind << " " << number << (on ? " on: " : ": ") << result.status << " " << result.err);
                last = std::max(last, number);
                ++runs;
                if (result.status == 0) {  // OpenCL's devices may be missing, which is told
                    CHECK((result.out == expected.out || contains(result.out, "\nnote: OpenCL cannot be used")));
                } else {
                    ++refused;
                    CHECK(refusals.contains(result.status));
                    CHECK(contains(result.err, "csgrt: error: "));
                    if (result.status == 130) CHECK(contains(result.err, "have not come back from their start"));
                    if (!target.empty()) CHECK(result.out == "old");
                }
                for (const std::string& file : folder.files()) CHECK(!file.ends_with(".part"));
            }
        WARN(line << "- " << kind << " 1 to " << last << ": " << runs << " runs, " << refused << " refused, "
                  << runs - refused << " with the same answer");
        if (step == csgrt::test::all_faults) CHECK(runs > 0);
        all_runs += runs;
    }
    CHECK(all_runs > 0);
}

}  // namespace command_test
