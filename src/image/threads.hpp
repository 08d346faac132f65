// Threads of OpenImageIO and of OpenEXR: of one process, and with csgrt's floating-point state. And their errors.
#pragma once

#include <string>
#include <system_error>

#include <csgrt/error.hpp>

#include "base/process.hpp"
#include "base/thread.hpp"

namespace csgrt {

/// Throws an error of OpenImageIO, which turns all exceptions into text.
[[noreturn]] inline void throw_from(const std::string& what, const std::string& why) {
    throw Error(why.find("std::bad_alloc") == why.npos ? Status::file : Status::out_of_memory, what + why);
}

inline FirstUser pictures_user;

/// Calls work() on a thread from which the libraries' threads inherit their state. Throws Error (file) in a child of
/// the process that first did so: it would wait for threads that do not exist in it.
template <class Work>
auto with_image_threads(const std::string& name, const Work& work) {
    if (!pictures_user.is_this_process())
        throw Error(Status::file, name + ": a picture was read or written before this process was forked, by threads " +
                                      "of OpenImageIO's that this process has not");
    try {
        return start_async(work).get();
    } catch (const std::system_error& error) {
        throw Error(Status::file, name + ": OpenImageIO gets no thread: " + error.what());
    }
}

}  // namespace csgrt
