// Threads of OpenImageIO and OpenEXR, which have csgrt's floating-point state and exist in one process only; and errors
// of these libraries.
#pragma once

#include <string>
#include <system_error>

#include <csgrt/error.hpp>

#include "base/process.hpp"
#include "base/thread.hpp"

namespace csgrt {

/// Throws an error that OpenImageIO reported as text.
[[noreturn]] inline void throw_from(const std::string& what, const std::string& why) {
    throw Error(why.find("std::bad_alloc") == why.npos ? Status::file : Status::out_of_memory, what + why);
}

inline FirstUser pictures_user;

/// Calls work() on a thread with csgrt's floating-point state, which the libraries' threads inherit. Throws Error
/// (file) in a fork of the process that called this first, because work() would wait for threads that do not exist
/// there.
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
