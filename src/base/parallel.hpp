// Parallel work on the host's processors, whose results do not depend on the number of processors.
#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <exception>
#include <functional>
#include <mutex>
#include <optional>
#include <type_traits>
#include <utility>
#include <vector>

#include "base/shared_vector.hpp"
#include "base/pool.hpp"

namespace csgrt {

/// The number of processors that this process may use.
inline unsigned processor_count() { return std::max(1u, std::thread::hardware_concurrency()); }

/// The number of threads to use. `wanted` = 0 stands for all that this thread may use.
inline unsigned thread_count(unsigned wanted) {
    if (wanted == 0) wanted = threads_allowed;
    return wanted != 0 ? wanted : processor_count();
}

/// Runs work() on this thread and on up to threads - 1 others of the pool (Pool::run). work() must not throw.
template <class Work>
void on_threads(unsigned threads, const Work& work) {
    threads > 1 ? Pool::own().run(threads, std::cref(work)) : work();
}

/// Calls work(first, last, chunk) for chunk = 0, 1, ...: the chunks divide the numbers 0 ... count - 1 into ranges of
/// `size`. Calls are in any order, several at once. If calls throw, no more chunks begin, and the first chunk's
/// exception is passed on.
template <class Work>
void for_chunks(std::size_t count, std::size_t size, unsigned threads, const Work& work) {
    const std::size_t chunks = (count + size - 1) / size;
    std::atomic<std::size_t> next{0};
    std::mutex mutex;
    std::size_t foremost = chunks;
    std::exception_ptr thrown;
    const auto run = [&] {
        for (std::size_t chunk = next++; chunk < chunks; chunk = next++) {
            try {
                work(chunk * size, std::min(count, (chunk + 1) * size), chunk);
            } catch (...) {
                const std::lock_guard lock(mutex);
                if (chunk < foremost) thrown = std::current_exception();
                foremost = std::min(foremost, chunk);
                next = chunks;  // earlier chunks have begun
            }
        }
    };
    on_threads(static_cast<unsigned>(std::min<std::size_t>(thread_count(threads), std::max<std::size_t>(chunks, 1))),
               run);
    if (thrown) std::rethrow_exception(thrown);
}

/// Reserves memory for `count` elements. All threads touch its pages in parallel, because the system clears a page at
/// the first touch. For large memory, one thread alone would spend much of its time on this.
template <class T>
void reserve_cleared(std::vector<T>& all, std::size_t count) {
    constexpr std::size_t page = 4096, piece = std::size_t{1} << 22;
    all.reserve(count);
    const std::size_t bytes = (all.capacity() - all.size()) * sizeof(T);
    if (bytes < 2 * piece) return;
    auto* const memory =
        reinterpret_cast<volatile unsigned char*>(all.data() + all.size());  // no element is constructed there yet
    for_chunks(bytes, piece, 0, [memory](std::size_t first, std::size_t last, std::size_t) {
        for (std::size_t i = first; i < last; i += page) memory[i] = 0;
    });
}

/// Resizes to `count` elements; new memory is cleared as in reserve_cleared().
template <class T>
void resize_cleared(std::vector<T>& all, std::size_t count) {
    reserve_cleared(all, count);
    all.resize(count);
}
template <class T>
void resize_cleared(SharedVector<T>& all, std::size_t count) {
    resize_cleared(all.own(), count);
}

/// Calls make(first, last) for the chunks of for_chunks(), several at once. Calls take(result) in the order of chunks,
/// one at a time, as soon as a result is there.
template <class Make, class Take>
void for_chunks_in_order(std::size_t count, std::size_t size, unsigned threads, const Make& make, const Take& take) {
    std::mutex mutex;
    std::vector<std::optional<std::invoke_result_t<Make, std::size_t, std::size_t>>> made((count + size - 1) / size);
    std::size_t next = 0;
    bool is_taking = false;
    for_chunks(count, size, threads, [&](std::size_t first, std::size_t last, std::size_t chunk) {
        auto mine = make(first, last);
        std::unique_lock lock(mutex);
        made[chunk].emplace(std::move(mine));
        if (is_taking) return;
        is_taking = true;  // until the next result is missing; for ever if take() throws
        for (; next < made.size() && made[next]; ++next) {
            auto it = std::exchange(made[next], std::nullopt);
            lock.unlock();
            take(*it);
            lock.lock();
        }
        is_taking = false;
    });
}

}  // namespace csgrt
