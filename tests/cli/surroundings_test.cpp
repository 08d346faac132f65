// Every command in surroundings that fail: what it needs not, changes nothing; what it lacks, it says.
#include "cli/command.hpp"
#include "faults/draw.hpp"
#include "sanitized.hpp"

using namespace command_test;

namespace {

enum class Ends {
    same,    ///< with the same answer
    file,    ///< with status 6: no answer can be written
    memory,  ///< with the same answer, or status 5
};

struct Surroundings {
    std::string name;
    How how;
    Ends ends = Ends::same;
};

using Variables = std::vector<std::pair<std::string, std::string>>;

Surroundings with(const std::string& name, const Variables& variables) {
    Surroundings result{name, {}};
    result.how.environment = variables;
    return result;
}

std::vector<Surroundings> all_surroundings(const Folder& folder) {
    const std::string file = folder.write("file", "no folder, no library"), fifo = folder / "fifo";
    REQUIRE(mkfifo(fifo.c_str(), 0600) == 0);
    const auto home = [](const std::string& at) {
        return Variables{{"HOME", at}, {"XDG_CACHE_HOME", ""}, {"POCL_CACHE_DIR", ""}};
    };
    std::vector<Surroundings> all = {
        with("no home", home("")),
        with("a home that is not there", home("/dev/null/none")),
        with("a home that nobody can write", home("/proc")),
        with("a home that is a file", home(file)),
        with("neither home nor temporary folder",
             {{"HOME", "/proc"}, {"XDG_CACHE_HOME", ""}, {"POCL_CACHE_DIR", ""}, {"TMPDIR", "/proc/none"}}),
    };
    for (const char* variable : {"POCL_CACHE_DIR", "XDG_CACHE_HOME", "CSGRT_CACHE_DIR"})
        for (const std::string& place : {file, fifo, std::string("/dev/full"), std::string("/proc")})
            all.push_back(with(std::string(variable) + " " + place, {{variable, place}}));
    const std::pair<const char*, std::string> drivers[] = {
        {"empty", ""}, {"missing", "/none/libdriver.so\n"}, {"text", file + "\n"}, {"junk", std::string(5000, '\x91')}};
    for (const auto& [name, content] : drivers) {
        fs::create_directory(folder / name);
        folder.write(std::string(name) + "/driver.icd", content);
        all.push_back(with(std::string("a driver's file that is ") + name,
                           {{"OCL_ICD_VENDORS", folder / name + "/"}, {"OCL_ICD_FILENAMES", ""}}));
    }
    all.push_back({"a full standard output", {.output = "/dev/full"}, Ends::file});
    all.push_back({"no standard output", {.closed = {STDOUT_FILENO}}, Ends::file});
    all.push_back({"an output with a limit", {.file_size = 10}, Ends::file});
    all.push_back({"a full standard error", {.errors = "/dev/full"}});
    all.push_back({"no standard error", {.closed = {STDERR_FILENO}}});
#ifndef CSGRT_SANITIZED  // they need the address space themselves
    for (const rlim_t megabytes : {30, 60, 100, 200, 300, 400, 500, 600, 800})
        all.push_back({std::to_string(megabytes) + " MB", {.address_space = megabytes << 20}, Ends::memory});
#endif
    return all;
}

void run_in_surroundings(unsigned long step) {
    NEEDS_COMMAND();
    const Folder folder;
    const std::string scene = folder.write("balls.asc", two_balls), rays = folder.write("rays", "-100 0.1 0.2 1 0 0\n"),
                      shot = folder / "shot";
    REQUIRE(run({"shoot", scene, "--rays", rays, "--reference", "-o", shot}).status == 0);
    const std::vector<std::vector<std::string>> commands = {
        {"--help"},
        {"devices"},
        {"convert", scene, "-"},
        {"shoot", scene, "--rays", rays},
        {"verify", scene, "--rays", "20"},
        {"compare", shot, shot},
#ifdef CSGRT_HAVE_IMAGE
        {scene, "--size", "8", "-o", "-"},
#endif
    };
    const std::vector<Surroundings> surroundings = all_surroundings(folder);
    csgrt::test::FaultDraw draw(step);
    int runs = 0, without_memory = 0;
    for (const std::vector<std::string>& words : commands) {
        const Result expected = run(words);
        REQUIRE(expected.status == 0);
        for (const auto& [name, how, ends] : surroundings) {
            if (!draw.draws()) continue;
            const Result result = run(words, how);
            ++runs;
            INFO(words[0] << ", " << name << ": " << result.status << " " << result.err);
            if (ends == Ends::file) {
                CHECK(result.status == 6);
            } else if (ends == Ends::memory && result.status != 0) {
                ++without_memory;
                CHECK(result.status == 5);
                CHECK(contains(result.err, "memory"));
            } else {
                CHECK(result.status == 0);
                // Drivers may be missing from the list.
                CHECK((result.out == expected.out || (words[0] == "devices" && contains(result.out, "csgrt"))));
            }
        }
    }
    WARN(commands.size() << " commands, " << surroundings.size() << " surroundings, " << runs << " runs, "
                         << without_memory << " without memory");
#ifndef CSGRT_SANITIZED
    if (step == csgrt::test::all_faults) CHECK(without_memory > 0);
#endif
}

}  // namespace

TEST_CASE("in any surroundings a command gives its answer, or says with the right status what it lacks",
          "[promise:failures]") {
    run_in_surroundings(csgrt::test::some_faults);
}

TEST_CASE("in all surroundings each command gives its answer, or says with the right status what it lacks",
          "[.faults]") {
    run_in_surroundings(csgrt::test::all_faults);
}
