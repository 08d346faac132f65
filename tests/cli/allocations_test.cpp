// Memory ends somewhere in the command: it says so with status 5, whatever was being done, and keeps the old file.
#include "cli/command.hpp"

#include "integration/scenes.hpp"

using namespace command_test;

TEST_CASE("an allocation that fails ends the command with status 5 or changes nothing, and the old file stays") {
    NEEDS_COMMAND();
    const char* library = std::getenv("CSGRT_FAIL_NEW_LIBRARY");
    if (library == nullptr) {
        WARN("CSGRT_FAIL_NEW_LIBRARY names no library: skipped");
        return;
    }
    const Folder folder;
    const std::string scene = csgrt::test::folder("CSGRT_SCENES") + "/solids.json", model = folder / "model.json",
                      rays = folder.write("rays", "0 0 1000 0 0 -1\n1 2 1000 0 0 -1\n");
    const std::vector<std::vector<std::string>> commands = {
        {"devices"},
        {"info", scene},
        {"convert", scene, model},
        {scene, "--size", "24", "--device", "native", "--stats", "-"},
        {scene, "--size", "24", "--reference", "--threads", "3", "--stats", "-"},
        {"shoot", scene, "--rays", rays, "--device", "native"},
        {"verify", scene, "--rays", "20", "--device", "native"},
    };
    for (const std::vector<std::string>& words : commands) {
        int out_of_memory = 0;
        for (unsigned long number = 1; number < 100'000; number = number < 6 ? number + 1 : 3 * number) {
            folder.write("model.json", "old");
            How how;
            how.environment = {{"LD_PRELOAD", library}, {"CSGRT_FAIL_NEW", std::to_string(number)}};
            if (number % 2 == 1) how.environment.push_back({"CSGRT_FAIL_NEW_ON", "1"});
            const Result result = run(words, how);
            INFO(words[0] << " " << words[1 % words.size()] << ", allocation " << number << ": " << result.err);
            CHECK((result.status == 5 || result.status == 0));
            if (result.status != 5) continue;
            ++out_of_memory;
            CHECK(contains(result.err, "memory"));
            if (words[0] == "convert") CHECK(read_file(model) == "old");
        }
        CHECK(out_of_memory >= 6);
    }
}
