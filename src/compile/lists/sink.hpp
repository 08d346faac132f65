// Rows of batches that end in any order -> the caller's arrays, in the order of the rays.
#pragma once

#include <condition_variable>
#include <cstdint>
#include <map>
#include <mutex>

#include "compile/lists/rows.hpp"

namespace csgrt {

class RowSink {
public:
    /// Empties the arrays. `rays`: how many there will be. `answer` must outlive this.
    RowSink(Partitions& answer, Fields fields, std::uint64_t rays);

    Fields fields() const { return fields_; }
    /// Any thread. Copies what the caller may then use again. Waits while too much is kept that earlier rays must come
    /// before; the batch that all wait for never does.
    void put(const RowView& rows);
    /// A batch will not come: nobody waits any more.
    void stop();
    /// Calls make(), which is to put a batch; if it throws, the batch will not come.
    template <class Make>
    void guard(const Make& make) {
        try {
            make();
        } catch (...) {
            stop();
            throw;
        }
    }

private:
    void append(const RowView& rows);

    Partitions& answer_;
    const Fields fields_;
    std::mutex mutex_;
    std::condition_variable moved_;
    std::uint64_t next_ = 0;  ///< the ray whose rows come next
    std::map<std::uint64_t, RowMemory> kept_;
    std::size_t kept_bytes_ = 0;
    bool is_stopped_ = false;
};

}  // namespace csgrt
