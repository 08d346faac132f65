// Commands that are ended at any time: the file that they write is the old one or the new one, whole, and what a
// SIGKILL leaves beside it is gone after the next run.
#include <chrono>
#include <random>
#include <thread>

#include "cli/command.hpp"
#include "sanitized.hpp"

using namespace command_test;

namespace {

/// A scene of n balls, which takes some milliseconds to convert.
std::string balls(int n) {
    std::string text = "title balls\nunits mm\n", all;
    for (int i = 0; i < n; ++i) {
        const std::string name = std::to_string(i);
        text += "put " + name + ".s ell V {" + std::to_string(3 * i % 500) + " " + std::to_string(i / 100) +
                " 0} A {2 0 0} B {0 2 0} C {0 0 2}\nput " + name + ".r comb region yes id 1001 tree {l " + name +
                ".s}\n";
    }
    return text;
}

void end_at_random_times(int kills) {
    const Folder folder;
    const std::string scenes[] = {folder.write("few.asc", balls(2000)), folder.write("many.asc", balls(4000))};
    std::string rays;
    for (int i = 0; i < 4000; ++i) rays += std::to_string(i / 8.) + " 0.1 -9 0 0 1\n";
    folder.write("rays", rays);
    const std::vector<std::vector<std::string>> commands = {
        {"convert", "", folder / "x.json"},
        {"shoot", "", "--rays", folder / "rays", "--device", "native", "-o", folder / "x.txt"},
#ifdef CSGRT_HAVE_IMAGE
        {"render", "", "--device", "native", "--size", "400", "-o", folder / "x.exr"},
#endif
    };
    struct Writer {
        std::vector<std::string> words[2];  ///< with either scene
        std::string target, answers[2];
        double seconds;  ///< that it takes
    };
    std::vector<Writer> writers(commands.size());
    const auto seconds_since = [](auto begin) {
        return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    };
    for (std::size_t i = 0; i < commands.size(); ++i)
        for (const int which : {0, 1}) {
            Writer& writer = writers[i];
            writer.words[which] = commands[i];
            writer.words[which][1] = scenes[which];
            writer.target = commands[i].back();
            const auto begin = std::chrono::steady_clock::now();
            REQUIRE(run(writer.words[which]).status == 0);
            writer.seconds = seconds_since(begin);
            writer.answers[which] = read_file(writer.target);
            REQUIRE(!writer.answers[which].empty());
        }
    const std::size_t files = folder.files().size();
    std::mt19937 random(1);
    int ended = 0, replaced = 0, left = 0;
    for (int i = 0; i < kills; ++i) {
        Writer& writer = writers[static_cast<std::size_t>(i) % writers.size()];
        const int which = read_file(writer.target) == writer.answers[0];  // the other answer
        const int signal = std::vector{SIGKILL, SIGTERM, SIGKILL, SIGINT, SIGKILL, SIGHUP}[random() % 6];
        const double wait = writer.seconds * std::uniform_real_distribution(0., 1.1)(random);
        INFO(writer.target << ", signal " << signal << " after " << wait << " s");
        const pid_t child = start(writer.words[which], "/dev/null", "/dev/null", "/dev/null");
        std::this_thread::sleep_for(std::chrono::duration<double>(wait));
        kill(child, signal);
        const int status = wait_for(child);
        CHECK((status == 0 || status == 128 + signal || (status == 130 && signal != SIGKILL)));
        const std::string found = read_file(writer.target);
        CHECK((found == writer.answers[0] || found == writer.answers[1]));
        if (status == 0) CHECK(found == writer.answers[which]);
        ended += status != 0;
        replaced += found == writer.answers[which];
        if (folder.files().size() == files) continue;
        CHECK(signal == SIGKILL);
        ++left;
        CHECK(run(writer.words[which]).status == 0);
        CHECK(read_file(writer.target) == writer.answers[which]);
        CHECK(folder.files().size() == files);
    }
    WARN(kills << " signals: " << ended << " commands ended, " << replaced << " files replaced, " << left
               << " files left and removed by the next run");
    CHECK(ended > 0);
}

}  // namespace

TEST_CASE("a command that is ended at any time leaves the old file or the new one, whole, and nothing else") {
    NEEDS_COMMAND();
    end_at_random_times(csgrt::test::tries(9));
}

TEST_CASE("200 commands that are ended at any time leave the old file or the new one, whole",
          "[.long][promise:files]") {
    NEEDS_COMMAND();
    end_at_random_times(200);
}
