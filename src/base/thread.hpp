// Threads of csgrt: they compute with csgrt's floating-point state, and leave the host's signals to the host's threads.
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

/// Blocks signals from outside for its thread while it lives. Such a signal goes to another thread, or waits. Threads
/// that are started meanwhile, also by a driver, block these signals for ever.
class BlockedSignals {
public:
#ifdef _WIN32
    BlockedSignals() {}
#else
    BlockedSignals() noexcept {
        sigset_t all;
        sigfillset(&all);
        // Signals that a thread causes itself are not blocked.
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

/// The number of threads that this thread's work may use, this thread included (Settings::threads). 0: one for each
/// processor.
inline constinit thread_local unsigned threads_allowed = 0;

/// Sets `threads_allowed` while it lives, also for Threads started meanwhile and for threads of the pool that help.
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

/// A std::thread that does `work`. Throws std::system_error if no thread is available.
class Thread : public std::thread {
public:
    template <class Work>
    explicit Thread(Work work) : Thread(std::move(work), BlockedSignals()) {}

private:
    template <class Work>
    Thread(Work work, const BlockedSignals&) : std::thread(in_own_state(std::move(work))) {}
};

/// Threads that the destructor joins.
class JoinedThreads {
public:
    JoinedThreads() = default;
    JoinedThreads(const JoinedThreads&) = delete;
    JoinedThreads& operator=(const JoinedThreads&) = delete;
    ~JoinedThreads() {
        for (Thread& thread : threads_) thread.join();
    }

    /// Adds a thread that does `work`. False if none is available: the existing threads do the work.
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

/// std::async in csgrt's floating-point state and with signals blocked. By default, if no thread is available, the
/// thread that waits for the result does the work.
template <class Work>
auto start_async(Work work, std::launch how = std::launch::async | std::launch::deferred) {
    const BlockedSignals blocked;
    return std::async(how, in_own_state(std::move(work)));
}

}  // namespace csgrt
