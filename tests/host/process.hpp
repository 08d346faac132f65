// Processes of a test's own: what csgrt does to a process shows in one that has done nothing else.
#pragma once

#include <cerrno>
#include <csignal>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iostream>
#include <set>
#include <string>

#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csgrt/csgrt.hpp>

#include "catch.hpp"
#include "integration/scenes.hpp"

namespace csgrt::test {

constexpr int failed = 1, skipped = 77;

/// Thrown in such a process where the machine lacks what is looked at.
struct Skip {};

/// Runs `work` in a child, and tells how that ended: its exit status, 0 if `work` returned; or minus the signal that
/// ended it. A child that hangs is ended after two minutes.
inline int status_of(const std::function<void()>& work) {
    std::cout.flush();
    std::fflush(nullptr);
    const pid_t child = fork();
    REQUIRE(child >= 0);
    if (child == 0) {
        for (const int signal : {SIGINT, SIGILL, SIGFPE, SIGSEGV, SIGTERM, SIGABRT}) std::signal(signal, SIG_DFL);
        alarm(120);
        int status = 0;
        try {
            work();
        } catch (const Skip&) {
            status = skipped;
        } catch (const std::exception& error) {
            std::fprintf(stderr, "%s\n", error.what());
            status = failed;
        } catch (...) {  // a REQUIRE
            status = failed;
        }
        std::cout.flush();
        std::fflush(nullptr);
        _exit(status);
    }
    int status = 0;
    while (waitpid(child, &status, 0) < 0) REQUIRE(errno == EINTR);
    return WIFSIGNALED(status) ? -WTERMSIG(status) : WEXITSTATUS(status);
}

/// The same for work on something that the machine may lack.
inline void require_good(const std::string& what, const std::function<void()>& work) {
    INFO(what);
    const int status = status_of(work);
    if (status == skipped)
        WARN(what << " is not there");
    else
        REQUIRE(status == 0);
}

/// Who computes: the native device, PoCL or "reference".
inline Settings on(const std::string& who) {
    Settings settings{.threads = 3};
    if (who == "reference")
        settings.reference = true;
    else
        settings.device = who;
    settings.wait_for_device = true;
    return settings;
}

inline Renderer renderer_on(const Scene& scene, const Settings& settings) try {
    return Renderer(scene, {}, settings);
} catch (const Error& error) {
    if (error.status() == Status::no_device) throw Skip();
    throw;
}

/// The numbers of this process's threads.
inline std::set<std::string> threads() {
    std::set<std::string> all;
    for (const auto& task : std::filesystem::directory_iterator("/proc/self/task"))
        all.insert(task.path().filename().string());
    return all;
}

/// All threads but this one and those that were there `before` must leave signals to the host's. How many there are.
inline std::size_t require_silent_threads(const std::set<std::string>& before = {}) {
    std::size_t others = 0;
    for (const std::string& number : threads()) {
        if (before.contains(number) || number == std::to_string(syscall(SYS_gettid))) continue;
        std::ifstream status("/proc/self/task/" + number + "/status");
        std::uint64_t blocked = ~std::uint64_t{0};  // it may have ended
        for (std::string line; std::getline(status, line);)
            if (line.starts_with("SigBlk:")) blocked = std::stoull(line.substr(7), nullptr, 16);
        for (const int signal : {SIGINT, SIGTERM, SIGALRM, SIGCHLD, SIGUSR1, SIGPROF, SIGRTMAX}) {
            INFO("thread " << number << ", signal " << signal);
            REQUIRE((blocked >> (signal - 1) & 1) == 1);
        }
        ++others;
    }
    return others;
}

inline Scene small_scene() { return load_scene(test::folder("CSGRT_SCENES") + "/operators.json"); }

/// First hits: few kernels to compile.
inline View small_view() { return {.width = 24, .height = 18, .every_partition = false}; }

}  // namespace csgrt::test
