// Memory ends somewhere in the command: it says so with status 5, or gives the right answer.
#include "cli/fail_each.hpp"

using namespace command_test;
using csgrt::test::all_faults, csgrt::test::some_faults;

TEST_CASE("an allocation that fails ends the command with status 5 or changes nothing, and the old file stays",
          "[promise:failures]") {
    NEEDS_COMMAND();
    fail_each("CSGRT_FAIL_NEW", 50 * some_faults, false, {5});
}

TEST_CASE("every 50th allocation that fails ends the command with status 5 or changes nothing", "[.faults]") {
    NEEDS_COMMAND();
    fail_each("CSGRT_FAIL_NEW", 50, false, {5});
}

TEST_CASE("each allocation that fails ends the command with status 5 or changes nothing", "[.long][promise:failures]") {
    NEEDS_COMMAND();
    fail_each("CSGRT_FAIL_NEW", 1, false, {5});
}

namespace {

void end_memory_in_pocl(unsigned long step) {
    NEEDS_COMMAND();
    const char* const library = std::getenv("CSGRT_FAIL_LIBRARY");
    if (library == nullptr || !contains(run({"devices"}).out, "Portable Computing Language")) {
        WARN("no library or no PoCL: skipped");
        return;
    }
    const Folder folder;
    const std::string scene = folder.write("balls.asc", two_balls), told = folder / "told",
                      rays = folder.write("rays", "-100 0.1 0.2 1 0 0\n");
    const std::vector<std::string> words = {"shoot", scene, "--rays", rays, "--device", "pocl"};
    const std::string expected = run(words).out;  // compiles
    int refused = 0;
    for (unsigned long number = csgrt::test::FaultDraw(step).first();; number += step) {
        How how;
        how.environment = {{"LD_PRELOAD", library},
                           {"CSGRT_FAIL_NEW", std::to_string(number)},
                           {"CSGRT_FAIL_NEW_LEAST", "32768"},
                           {"CSGRT_FAIL_NEW_TOLD", told}};
        how.patience = 30;  // PoCL's lock
        fs::remove(told);
        const Result result = run(words, how);
        if (!fs::exists(told)) break;
        INFO(number << ": " << result.status << " " << result.err);
        CHECK((result.status == 5 || result.status == 7 || (result.status == 0 && result.out == expected)));
        refused += result.status == 5;
    }
    if (step == all_faults) CHECK(refused > 0);
#ifndef CSGRT_SANITIZED  // they need the address space themselves
    for (const rlim_t megabytes : {100, 200, 300}) {
        How how;
        how.address_space = megabytes << 20;
        const Result result = run(words, how);
        INFO(megabytes << " MB: " << result.status << " " << result.err);
        CHECK(result.status == 5);
    }
#endif
}

}  // namespace

TEST_CASE("memory that ends in PoCL ends the command with status 5 or 7, or changes nothing", "[promise:failures]") {
    end_memory_in_pocl(some_faults);
}

TEST_CASE("each time that memory ends in PoCL the command ends with status 5 or 7, or nothing changes", "[.faults]") {
    end_memory_in_pocl(all_faults);
}

#ifdef CSGRT_HAVE_IMAGE
// 6: what OpenImageIO says of it need not be that.
TEST_CASE("an allocation that fails where pictures are read or written is an error or changes nothing",
          "[promise:failures]") {
    NEEDS_COMMAND();
    fail_each("CSGRT_FAIL_NEW", 100 * some_faults, true, {5, 6});
}

TEST_CASE("every 1000th allocation that fails where pictures are read or written is an error or changes nothing",
          "[.faults]") {
    NEEDS_COMMAND();
    fail_each("CSGRT_FAIL_NEW", 1000, true, {5, 6});
}

TEST_CASE("every tenth allocation that fails where pictures are read or written is an error or changes nothing",
          "[.long][promise:failures]") {
    NEEDS_COMMAND();
    fail_each("CSGRT_FAIL_NEW", 10, true, {5, 6});
}
#endif
