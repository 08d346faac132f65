// Ctrl-C and what is shown while it is awaited, on a terminal of the test's own.
#include <cerrno>
#include <chrono>
#include <csignal>
#include <thread>

#include <poll.h>
#include <pty.h>

#include "cli/command.hpp"

using namespace command_test;

namespace {

using Clock = std::chrono::steady_clock;
constexpr auto patience = std::chrono::seconds(60);

/// A frame that takes the reference far longer than any test waits.
std::vector<std::string> endless(const std::string& scene) {
    return {scene, "all.g", "--reference", "--size", "64", "--repeat", "1000000"};
}

/// Waits until the process has a handler for the signal.
bool catches(pid_t process, int signal) {
    for (const auto begin = Clock::now(); Clock::now() - begin < patience;) {
        const std::string status = read_file("/proc/" + std::to_string(process) + "/status");
        const std::size_t mask = status.find("SigCgt:");
        const bool own = contains(status, "Name:\tcsgrt\n");  // no longer the test before exec
        if (own && mask != status.npos && std::stoull(status.substr(mask + 7), nullptr, 16) >> (signal - 1) & 1)
            return true;
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    return false;
}

struct Screen {
    int status = -1;
    std::string text;
};

/// Runs the command with a terminal as its standard error and output; presses Ctrl-C once `awaited` is on it.
Screen run_on_terminal(std::vector<std::string> words, const std::string& awaited) {
    std::string program = command();
    std::vector<char*> pointers = {program.data()};
    for (std::string& word : words) pointers.push_back(word.data());
    pointers.push_back(nullptr);
    int terminal = -1;
    const pid_t child = forkpty(&terminal, nullptr, nullptr, nullptr);
    REQUIRE(child >= 0);
    if (child == 0) {
        setenv("TERM", "xterm", 1);
        execv(program.c_str(), pointers.data());
        _exit(127);
    }
    Screen screen;
    bool pressed = false;
    for (const auto begin = Clock::now(); Clock::now() - begin < patience;) {
        pollfd waiting{terminal, POLLIN, 0};
        poll(&waiting, 1, 100);
        char bytes[4096];
        if (waiting.revents != 0) {
            const ssize_t count = read(terminal, bytes, sizeof bytes);
            if (count <= 0) break;  // the command has closed its end
            screen.text.append(bytes, static_cast<std::size_t>(count));
        }
        if (!pressed && !awaited.empty() && contains(screen.text, awaited)) {
            REQUIRE(write(terminal, "\x03", 1) == 1);
            pressed = true;
        }
    }
    kill(child, SIGKILL);  // if it still runs, the test fails
    screen.status = wait_for(child);
    close(terminal);
    return screen;
}

}  // namespace

TEST_CASE("a terminal shows progress with the time left, and Ctrl-C exits with 130 and leaves nothing") {
    NEEDS_COMMAND();
    const Folder folder;
    auto words = endless(folder.write("balls.asc", two_balls));
    words.insert(words.end(), {"--stats", folder / "stats.json"});
    const Screen screen = run_on_terminal(words, " left");
    INFO(screen.text);
    CHECK(screen.status == 130);
    CHECK(contains(screen.text, "\r\033[Krendering  0 %  "));
    CHECK(contains(screen.text, "\r\033[Kcsgrt: \033[1;31merror:\033[0m interrupted\r\n"));
    CHECK(folder.files().size() == 1);
}

TEST_CASE("NO_COLOR is honoured, and short work shows nothing") {
    NEEDS_COMMAND();
    const Folder folder;
    const std::string scene = folder.write("balls.asc", two_balls);
    const Screen quick = run_on_terminal({scene, "--reference", "--size", "16", "--stats", folder / "stats.json"}, "");
    CHECK(quick.status == 0);
    CHECK(quick.text.empty());
    setenv("NO_COLOR", "1", 1);
    const Screen plain = run_on_terminal({scene}, "");
    unsetenv("NO_COLOR");
    CHECK(plain.status == 2);
    CHECK(plain.text.starts_with("csgrt: error: nothing to write\r\n"));
    CHECK(run_on_terminal({scene}, "").text.starts_with("csgrt: \033[1;31merror:\033[0m nothing to write\r\n"));
}

#ifdef CSGRT_HAVE_IMAGE
TEST_CASE("no picture is written to a terminal") {
    NEEDS_COMMAND();
    const Folder folder;
    const Screen screen = run_on_terminal({folder.write("balls.asc", two_balls), "--reference", "-o", "-"}, "");
    CHECK(screen.status == 2);
    CHECK(contains(screen.text, "a terminal cannot show a picture"));
}
#endif

TEST_CASE("a measure shows how its intervals shrink, and Ctrl-C prints what it has", "[promise:measure]") {
    NEEDS_COMMAND();
    const Folder folder;
    const std::string scene = folder.write("balls.asc", two_balls);
    const Screen screen = run_on_terminal({"measure", scene, "all.g", "--rel-error", "1e-9"}, "whole +- ");
    CAPTURE(screen.text);
    CHECK(screen.status == 130);
    CHECK(contains(screen.text, "0 of 2 regions within 1e-07 %"));
    CHECK(contains(screen.text, "volume "));
}

TEST_CASE("a check shows what it has found, and Ctrl-C prints it", "[promise:check]") {
    NEEDS_COMMAND();
    const Folder folder;
    std::string solids, regions, all;  // 512 balls, each of which overlaps its neighbours
    for (int i = 0; i < 512; ++i) {
        const std::string name = "\"" + std::to_string(i) + "\"";
        const auto at = [i](int k) { return std::to_string(18 * (i / k % 8)); };
        solids += (i ? "," : "") + name + R"(:{"type":"sphere","radius":10,"center":[)" + at(1) + "," + at(8) + "," +
                  at(64) + "]}";
        regions += "\"r" + name.substr(1) + ":{\"region\":true,\"tree\":" + name + "},";
        all += (i ? ",\"r" : "\"r") + name.substr(1);
    }
    const std::string scene =
        folder.write("balls.json", "{\"csgrt\":1,\"solids\":{" + solids + "},\"combinations\":{" + regions +
                                       "\"all\":{\"tree\":{\"union\":[" + all + "]}}}}");
    const Screen screen = run_on_terminal({"check", scene, "all", "--threads", "1"}, " rays");
    CAPTURE(screen.text);
    CHECK(screen.status == 130);
    CHECK(contains(screen.text, " overlaps: "));
    CHECK(contains(screen.text, "\nThe check was ended before it was complete.\r\n"));
}

TEST_CASE("SIGINT, SIGTERM and SIGHUP end a render, a wait for rays and a verification with 130, and leave no file",
          "[promise:interrupts]") {
    NEEDS_COMMAND();
    for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
        const Folder folder;
        const std::string scene = folder.write("balls.asc", two_balls);
        REQUIRE(mkfifo((folder / "pipe").c_str(), 0600) == 0);
        const int held = open((folder / "pipe").c_str(), O_RDWR);  // someone who might still write: no end of file
        REQUIRE(held >= 0);
        auto render = endless(scene);
        render.insert(render.end(), {"--stats", folder / "stats.json"});
        const std::vector<std::string> shoot = {"shoot", scene, "--rays", folder / "pipe", "-o", folder / "out.txt"};
        const std::vector<std::string> verify = {"verify",  scene,    "--reference",         "--rays",
                                                 "1000000", "--json", folder / "result.json"};
        for (const auto& words : {render, shoot, verify}) {
            const pid_t child = start(words, "/dev/null", "/dev/null", folder / "err");
            REQUIRE(catches(child, signal));
            std::this_thread::sleep_for(std::chrono::milliseconds(300));  // to get to work
            REQUIRE(kill(child, signal) == 0);
            CHECK(wait_for(child) == 130);
            CHECK(read_file(folder / "err") == "csgrt: error: interrupted\n");
            CHECK(folder.files().size() == 3);  // the scene, the pipe and the messages
        }
        close(held);
    }
}
