// Drivers that end the process that loads them, or never come back: the command says so, and can be ended.
#include <chrono>
#include <thread>

#include <dlfcn.h>

#include "cli/command.hpp"

using namespace command_test;

namespace {

using Variables = std::vector<std::pair<std::string, std::string>>;

/// Where the OpenCL loader finds that driver alone; empty: there is none, or no loader.
Variables with_driver(const Folder& vendors, const std::string& that_does) {
    const char* const driver = std::getenv("CSGRT_BAD_DRIVER");
    if (driver == nullptr || dlopen("libOpenCL.so.1", RTLD_LAZY) == nullptr) return {};
    vendors.write("bad.icd", std::string(driver) + "\n");
    return {{"OCL_ICD_VENDORS", vendors / ""}, {"OCL_ICD_FILENAMES", ""}, {"CSGRT_BAD_DRIVER_DOES", that_does}};
}

/// A command that waits for a library: one TERM ends it within 5 seconds, two within 2.
void check_ends_in_time(const std::vector<std::string>& words, const Variables& environment) {
    const Folder folder;
    for (const bool twice : {false, true}) {
        const pid_t child = start(words, "/dev/null", "/dev/null", folder / "err", 0, {}, 0, environment);
        std::this_thread::sleep_for(std::chrono::milliseconds(700));  // to get to the library
        const auto begin = std::chrono::steady_clock::now();
        REQUIRE(kill(child, SIGTERM) == 0);
        if (twice) {
            std::this_thread::sleep_for(std::chrono::milliseconds(100));
            kill(child, SIGTERM);
        }
        CHECK(wait_for(child) == 130);
        const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - begin;
        CHECK(seconds.count() < (twice ? 2 : 5));
        if (!twice) CHECK(contains(read_file(folder / "err"), "interrupted"));
    }
}

}  // namespace

TEST_CASE("a driver that ends the process is status 7 with what to remove, and a note among the devices",
          "[promise:failures]") {
    NEEDS_COMMAND();
    const Folder folder, vendors;
    const std::string scene = folder.write("balls.asc", two_balls);
    for (const char* does : {"abort", "crash"}) {
        How how;
        how.environment = with_driver(vendors, does);
        if (how.environment.empty()) return;
        how.environment.push_back({"POCL_CACHE_DIR", folder / "cache"});
        const Result drawn = run({scene, "--device", "pocl", "--size", "8", "--stats", "-"}, how);
        INFO(does << ": " << drawn.err);
        CHECK(drawn.status == 7);
        CHECK(contains(drawn.err, std::string("csgrt: error: ended by ") + (does[0] == 'a' ? "SIGABRT" : "SIGSEGV")));
        CHECK(contains(drawn.err, "remove the folder " + (folder / "cache")));
        const Result listed = run({"devices"}, how);
        CHECK((listed.status == 0 || listed.status == 4));  // without a native device there is none
        CHECK(contains(listed.out + listed.err, "one of its drivers ends the process that loads it"));
        CHECK(run({scene, "--device", "native", "--size", "8", "--stats", "-"}, how).status != 7);
    }
}

TEST_CASE("a driver that never comes back: one TERM ends the command within 5 seconds, two within 2",
          "[promise:interrupts][promise:failures]") {
    NEEDS_COMMAND();
    const Folder folder, vendors;
    auto environment = with_driver(vendors, "hang");
    if (environment.empty()) return;
    check_ends_in_time({"devices"}, environment);
    // Without threads main() loads the driver itself, and a signal reaches the thread of interrupt.cpp alone.
    if (const char* const library = std::getenv("CSGRT_FAIL_LIBRARY"))
        environment.insert(environment.end(),
                           {{"LD_PRELOAD", library}, {"CSGRT_FAIL_THREAD", "2"}, {"CSGRT_FAIL_THREAD_ON", "1"}});
    const std::string scene = folder.write("balls.asc", two_balls);
    check_ends_in_time({scene, "--device", "pocl", "--size", "8", "--stats", "-"}, environment);
}

#ifdef CSGRT_HAVE_IMAGE
TEST_CASE("a library for pictures that ends the process is status 6, and one that never comes back can be ended",
          "[promise:failures]") {
    NEEDS_COMMAND();
    const char* const bad = std::getenv("CSGRT_BAD_DRIVER");
    if (bad == nullptr) return;
    const Folder folder, libraries;
    fs::create_symlink(fs::absolute(command()).parent_path() / library_name("csgrt"),
                       libraries / library_name("csgrt"));
    fs::copy_file(bad, libraries / library_name("csgrt_image"));
    const std::string scene = folder.write("balls.asc", two_balls), picture = folder.write("x.png", "old");
    const std::vector<std::string> drawing = {scene, "--device", "native", "--size", "8", "-o", picture};
    const auto that = [&](const char* does) -> How {
        How how;
        how.environment = {{"LD_LIBRARY_PATH", libraries / ""}, {"CSGRT_BAD_DRIVER_DOES", does}};
        return how;
    };
    for (const char* does : {"abort", "crash"}) {
        const Result result = run(drawing, that(does));
        INFO(does << ": " << result.err);
        CHECK(result.status == 6);
        CHECK(contains(result.err, "while the libraries for pictures were in use"));
    }
    check_ends_in_time(drawing, that("hang").environment);
    CHECK(read_file(picture) == "old");
}
#endif
