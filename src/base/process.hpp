// Which process this is. A fork makes another one, which has the memory of the first, and of its threads the one that
// forked.
#pragma once

namespace csgrt {

/// Another number in a child of fork() than in its parent. Any thread.
unsigned process_number() noexcept;

/// Deletes what this process made. What it has from a parent stays as it is, which costs nothing but addresses: threads
/// that are not there cannot be waited for, and a driver does not know this process.
struct DeleteOwn {
    unsigned process = process_number();
    template <class T>
    void operator()(T* object) const {
        if (process == process_number()) delete object;
    }
};

}  // namespace csgrt
