// The process's pool of threads: who works, how many at a time, and what is thrown.
#include "base/parallel.hpp"

#include <algorithm>
#include <chrono>
#include <memory>
#include <set>
#include <stdexcept>
#include <string>
#include <thread>

#include "catch.hpp"

using namespace csgrt;

namespace {

/// The threads that did a work which lasts until `threads` have come, or half a second.
std::set<std::thread::id> workers_of(Pool& pool, unsigned threads, unsigned awaited) {
    std::mutex mutex;
    std::set<std::thread::id> workers;
    pool.run(threads, [&] {
        const auto end = std::chrono::steady_clock::now() + std::chrono::milliseconds(500);
        for (bool all = false; !all && std::chrono::steady_clock::now() < end; std::this_thread::yield()) {
            const std::lock_guard lock(mutex);
            workers.insert(std::this_thread::get_id());
            all = workers.size() >= awaited;
        }
    });
    return workers;
}

}  // namespace

TEST_CASE("a pool's works are done by the caller and as many threads as it asks for, which are used again",
          "[promise:models][promise:bits]") {
    Pool pool;
    const std::set<std::thread::id> all = workers_of(pool, 5, 5);
    CHECK(all.size() == 5);
    CHECK(all.contains(std::this_thread::get_id()));
    CHECK(workers_of(pool, 5, 5) == all);
    CHECK(workers_of(pool, 1, 1) == std::set{std::this_thread::get_id()});
    const std::set<std::thread::id> three = workers_of(pool, 3, 4);  // no fourth one comes
    CHECK(three.size() == 3);
    CHECK(std::includes(all.begin(), all.end(), three.begin(), three.end()));
}

TEST_CASE("works of several threads, and works within works, share a pool and all end",
          "[promise:models][promise:bits]") {
    Pool pool;
    std::atomic<int> done{0};
    std::vector<std::thread> callers;
    for (int i = 0; i < 4; ++i)
        callers.emplace_back([&] {
            for (int k = 0; k < 50; ++k) {
                std::atomic<int> left{20};
                pool.run(3, [&] {
                    while (left-- > 0)
                        pool.run(2, [&, is_mine = std::make_shared<std::atomic<bool>>(true)] {
                            if (is_mine->exchange(false)) ++done;
                        });
                });
            }
        });
    for (std::thread& caller : callers) caller.join();
    CHECK(done == 4 * 50 * 20);
}

TEST_CASE("chunks are all numbers, each once, and those that other threads begin obey the caller's limit") {
    for (const unsigned threads : {0u, 1u, 7u}) {
        const AllowedThreads allowed(threads);
        CHECK(thread_count(0) == (threads ? threads : processor_count()));
        std::vector<int> times(10'007);
        std::atomic<bool> is_limited{true}, is_chunk{true};
        for_chunks(times.size(), 100, 0, [&](std::size_t first, std::size_t last, std::size_t chunk) {
            if (first != 100 * chunk) is_chunk = false;
            if (threads_allowed != threads) is_limited = false;
            for (; first < last; ++first) ++times[first];
        });
        CHECK(is_chunk);
        CHECK(is_limited);
        CHECK(times == std::vector<int>(10'007, 1));
        start_async([&] { is_limited = threads_allowed == threads; }, std::launch::async).get();
        CHECK(is_limited);
    }
    CHECK(threads_allowed == 0);
    // A thread that has worked for one caller has the next one's limit.
    Pool pool;
    for (const unsigned threads : {3u, 5u}) {
        const AllowedThreads allowed(threads);
        const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(5);
        std::atomic<int> begun{0}, limited{0};
        pool.run(2, [&] {
            limited += threads_allowed == threads;
            for (++begun; begun < 2 && std::chrono::steady_clock::now() < end;) std::this_thread::yield();
        });
        CHECK(limited == 2);
    }
}

TEST_CASE("what the foremost chunk throws is thrown when all that have begun have ended, and few begin after it") {
    for (int round = 0; round < 50; ++round) {
        std::atomic<int> begun{0}, ended{0};
        std::string what;
        try {
            for_chunks(10'000, 1, 4, [&](std::size_t, std::size_t, std::size_t chunk) {
                ++begun;
                if (chunk == 20 || chunk == 21 || chunk == 25) {
                    if (chunk == 20) std::this_thread::sleep_for(std::chrono::microseconds(200));
                    ++ended;
                    throw std::runtime_error(std::to_string(chunk));
                }
                std::this_thread::yield();
                ++ended;
            });
        } catch (const std::runtime_error& error) {
            what = error.what();
        }
        CHECK(what == "20");
        CHECK(begun == ended);
        CHECK(begun < 10'000);
    }
}
