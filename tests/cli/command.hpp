// Runs the built command as a user would, and keeps what it prints.
#pragma once

#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csgrt/version.hpp>

#include "catch.hpp"
#include "folder.hpp"

namespace command_test {

namespace fs = std::filesystem;

/// The name that a program looks for: "csgrt" -> "libcsgrt.so.0.2".
inline std::string library_name(const std::string& library) {
    static_assert(CSGRT_VERSION_MAJOR == 0);  // then the name has no minor version
    return "lib" + library + ".so.0." + std::to_string(CSGRT_VERSION_MINOR);
}

/// The executable, from the environment; empty if it is not set.
inline std::string command() {
    const char* path = std::getenv("CSGRT_COMMAND");
    return path ? path : "";
}

#define NEEDS_COMMAND()                                     \
    if (command_test::command().empty()) {                  \
        WARN("CSGRT_COMMAND names no executable: skipped"); \
        return;                                             \
    }

using csgrt::test::Folder;
using csgrt::test::read_file;

struct Result {
    int status = -1;  ///< 128 + the signal that killed it
    std::string out, err;
};

struct How {
    std::string input = {};        ///< file to be standard input; empty: nothing
    std::string output = {};       ///< file to be standard output, e.g. /dev/full; empty: kept in Result::out
    rlim_t address_space = 0;      ///< bytes; 0: no limit
    std::vector<int> closed = {};  ///< standard files that are not open
    rlim_t file_size = 0;          ///< bytes that a file may have, as if the disk were full; 0: no limit
    std::vector<std::pair<std::string, std::string>> environment =
        {};                   ///< variables that are set, in place of this process's
    std::string errors = {};  ///< file to be standard error; empty: kept in Result::err
    unsigned patience = 0;    ///< seconds after which it gets ALRM, as after 30 s of loading, and TERM; 0: never
};

/// Starts the command in a child; the caller waits for it.
inline pid_t start(const std::vector<std::string>& arguments, const std::string& input, const std::string& output,
                   const std::string& errors, rlim_t address_space = 0, const std::vector<int>& closed = {},
                   rlim_t file_size = 0, const std::vector<std::pair<std::string, std::string>>& environment = {}) {
    std::string program = command();
    std::vector<std::string> words = arguments;
    std::vector<char*> pointers = {program.data()};
    for (std::string& word : words) pointers.push_back(word.data());
    pointers.push_back(nullptr);
    pid_t child = fork();
    if (child != 0) return child;
    const auto redirect = [](const std::string& path, int flags, int descriptor) {
        const int file = open(path.c_str(), flags, 0600);
        if (file < 0 || dup2(file, descriptor) < 0) _exit(126);
    };
    redirect(input, O_RDONLY, STDIN_FILENO);
    redirect(output, O_WRONLY | O_CREAT | O_TRUNC, STDOUT_FILENO);
    redirect(errors, O_WRONLY | O_CREAT | O_TRUNC, STDERR_FILENO);
    std::signal(SIGINT, SIG_DFL);  // a script in the background passes it on ignored
    const rlimit limit{address_space, address_space};
    if (address_space > 0 && setrlimit(RLIMIT_AS, &limit) != 0) _exit(126);
    const rlimit size{file_size, file_size};
    std::signal(SIGXFSZ, SIG_DFL);  // a program that does nothing about it is ended
    if (file_size > 0 && setrlimit(RLIMIT_FSIZE, &size) != 0) _exit(126);
    for (const int file : closed) close(file);
    for (const auto& [name, value] : environment) setenv(name.c_str(), value.c_str(), 1);
    execv(program.c_str(), pointers.data());
    _exit(127);
}

inline int wait_for(pid_t child) {
    int status = 0;
    waitpid(child, &status, 0);
    return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

inline Result run(const std::vector<std::string>& arguments, const How& how = {}) {
    const Folder folder;
    const std::string out = how.output.empty() ? folder / "out" : how.output,
                      err = how.errors.empty() ? folder / "err" : how.errors;
    const std::string input = how.input.empty() ? "/dev/null" : how.input;
    Result result;
    const pid_t child =
        start(arguments, input, out, err, how.address_space, how.closed, how.file_size, how.environment);
    siginfo_t ended{};
    for (unsigned i = 0; i < 100 * how.patience && ended.si_pid == 0; ++i) {
        usleep(10'000);
        waitid(P_PID, static_cast<id_t>(child), &ended, WEXITED | WNOHANG | WNOWAIT);
    }
    if (how.patience > 0 && ended.si_pid == 0) {
        kill(child, SIGALRM);
        usleep(200'000);
        kill(child, SIGTERM);
    }
    result.status = wait_for(child);
    if (how.output.empty()) result.out = read_file(out);
    if (how.errors.empty()) result.err = read_file(err);
    return result;
}

inline bool contains(const std::string& text, const std::string& part) { return text.find(part) != text.npos; }

/// Runs the command, which must end with `status` and say `words` on standard error.
inline Result check_run(const std::vector<std::string>& arguments, int status, const std::string& words,
                        const How& how = {}) {
    Result result = run(arguments, how);
    CAPTURE(arguments, result.out, result.err);
    CHECK(result.status == status);
    CHECK(contains(result.err, words));
    return result;
}

/// Two balls that overlap, radius 10 about the origin and about (15, 0, 0), and a cube of 4 cut out of the first.
inline constexpr const char* two_balls =
    "title {two balls}\n"
    "units mm\n"
    "put left.s ell V {0 0 0} A {10 0 0} B {0 10 0} C {0 0 10}\n"
    "put right.s ell V {15 0 0} A {10 0 0} B {0 10 0} C {0 0 10}\n"
    "put hole.s arb8 V1 {2 -2 -2} V2 {2 2 -2} V3 {2 2 2} V4 {2 -2 2} V5 {-2 -2 -2} V6 {-2 2 -2} V7 {-2 2 2} "
    "V8 {-2 -2 2}\n"
    "put left.r comb region yes id 1001 tree {- {l left.s} {l hole.s}}\n"
    "put right.r comb region yes id 1002 tree {l right.s}\n"
    "put all.g comb region no tree {u {l left.r} {l right.r}}\n";

}  // namespace command_test
