// How csgrt starts threads: they compute as csgrt does, whatever state a thread has by birth, and leave the host's
// signals to the host's threads.
#pragma once

#include <cstddef>
#include <exception>
#include <future>
#include <thread>
#include <utility>
#include <vector>

#ifndef _WIN32
#include <csignal>

#include <pthread.h>
#endif

#include "base/floating_point.hpp"

namespace csgrt {

/// While it lives, signals that come from outside wait for another thread, or for its end. Threads that are started
/// meanwhile, by a driver, too, never get one.
class BlockedSignals {
public:
#ifdef _WIN32
    BlockedSignals() {}
#else
    BlockedSignals() noexcept {
        sigset_t all;
        sigfillset(&all);
        // What a thread does itself is told to nobody else.
        for (const int own : {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGTRAP, SIGSYS, SIGABRT}) sigdelset(&all, own);
        pthread_sigmask(SIG_SETMASK, &all, &before_);
    }
    ~BlockedSignals() { pthread_sigmask(SIG_SETMASK, &before_, nullptr); }
#endif
    BlockedSignals(const BlockedSignals&) = delete;
    BlockedSignals& operator=(const BlockedSignals&) = delete;

#ifndef _WIN32
private:
    sigset_t before_;
#endif
};

/// How many threads the work of this thread may use, with itself (Settings::threads); 0: one for each processor.
inline constinit thread_local unsigned threads_allowed = 0;

/// While it lives, so many. Threads that are started meanwhile, and those of the pool that help, have the same limit.
class AllowedThreads {
public:
    explicit AllowedThreads(unsigned count) noexcept : before_(std::exchange(threads_allowed, count)) {}
    AllowedThreads(const AllowedThreads&) = delete;
    AllowedThreads& operator=(const AllowedThreads&) = delete;
    ~AllowedThreads() { threads_allowed = before_; }

private:
    unsigned before_;
};

template <class Work>
auto in_own_state(Work work) {
    return [work = std::move(work), threads = threads_allowed]() mutable {
        const FloatingPoint own;
        const AllowedThreads allowed(threads);
        return work();
    };
}

/// A std::thread that does `work`. Throws std::system_error if there is none to be had.
class Thread : public std::thread {
public:
    template <class Work>
    explicit Thread(Work work) : Thread(std::move(work), BlockedSignals()) {}

private:
    template <class Work>
    Thread(Work work, const BlockedSignals&) : std::thread(in_own_state(std::move(work))) {}
};

/// Threads that are joined at the end, whatever ends it.
class JoinedThreads {
public:
    JoinedThreads() = default;
    JoinedThreads(const JoinedThreads&) = delete;
    JoinedThreads& operator=(const JoinedThreads&) = delete;
    ~JoinedThreads() {
        for (Thread& thread : threads_) thread.join();
    }

    /// One more, which does `work`. False where none is to be had: those that there are do the work.
    template <class Work>
    bool add(const Work& work) noexcept {
        try {
            threads_.emplace_back(work);
            return true;
        } catch (const std::exception&) {  // std::system_error, std::bad_alloc
            return false;
        }
    }
    std::size_t size() const noexcept { return threads_.size(); }

private:
    std::vector<Thread> threads_;
};

/// std::async of such threads; by default the work is done by who waits for it where there is no thread to be had.
template <class Work>
auto start_async(Work work, std::launch how = std::launch::async | std::launch::deferred) {
    const BlockedSignals blocked;
    return std::async(how, in_own_state(std::move(work)));
}

}  // namespace csgrt
