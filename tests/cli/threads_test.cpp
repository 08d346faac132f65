// Threads that the system does not give: the command does its work with fewer, or says why it cannot.
#include "cli/fail_each.hpp"

using namespace command_test;
using csgrt::test::all_faults, csgrt::test::some_faults;

namespace {

void lack_threads(unsigned long step) {
    NEEDS_COMMAND();
    fail_each("CSGRT_FAIL_THREAD", step, false, {5, 6, 7});
#ifdef CSGRT_HAVE_IMAGE
    fail_each("CSGRT_FAIL_THREAD", step, true, {5, 6, 7});
#endif
}

}  // namespace

TEST_CASE("a thread that is not to be had changes no answer, or the command says what it lacks", "[promise:failures]") {
    lack_threads(some_faults);
}

TEST_CASE("each thread that is not to be had changes no answer, or the command says what it lacks", "[.faults]") {
    lack_threads(all_faults);
}

#ifdef CSGRT_HAVE_IMAGE
TEST_CASE("threads that libraries do not get while they are loaded: the right answer, or what is lacking is said",
          "[.long][promise:failures]") {
    NEEDS_COMMAND();
    setenv("CSGRT_FAIL_THREAD_LOADS", "1", 1);
    fail_each("CSGRT_FAIL_THREAD", 1, true, {5, 6, 7, 130});
    unsetenv("CSGRT_FAIL_THREAD_LOADS");
}
#endif

namespace {

void lack_threads_in_pocl(unsigned long step) {
    NEEDS_COMMAND();
    const char* library = std::getenv("CSGRT_FAIL_LIBRARY");
    if (library == nullptr || !contains(run({"devices"}).out, "Portable Computing Language")) {
        WARN("no library or no PoCL: skipped");
        return;
    }
    const Folder folder;
    const std::string scene = folder.write("balls.asc", two_balls), told = folder / "told";
    csgrt::test::FaultDraw draw(step);
    int refused = 0;
    for (const bool on : {false, true})
        for (unsigned long number = draw.first();; number += step) {
            How how;
            how.environment = {{"LD_PRELOAD", library},
                               {"POCL_CACHE_DIR", folder / "cache"},
                               {"CSGRT_FAIL_THREAD", std::to_string(number)},
                               {"CSGRT_FAIL_THREAD_TOLD", told}};
            if (on) how.environment.push_back({"CSGRT_FAIL_THREAD_ON", "1"});
            fs::remove(told);
            const Result result =
                run({scene, "--device", "pocl", "--size", "8", "--first-hit", "--stats", folder / "stats.json"}, how);
            if (!fs::exists(told)) break;
            INFO(number << (on ? " on: " : ": ") << result.status << " " << result.err);
            refused += result.status == 7;
            if (result.status != 0) {
                CHECK(result.status == 7);
                CHECK(contains(result.err, "csgrt: error: "));
            }
        }
    if (step == all_faults) CHECK(refused > 0);
}

}  // namespace

TEST_CASE("a thread that PoCL does not get is the answer or status 7, and a sentence", "[promise:failures]") {
    lack_threads_in_pocl(some_faults);
}

TEST_CASE("each thread that PoCL does not get is the answer or status 7, and a sentence", "[.faults]") {
    lack_threads_in_pocl(all_faults);
}
