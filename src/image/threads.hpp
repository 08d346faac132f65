// OpenImageIO's threads, and OpenEXR's: of one process, and with the state of csgrt's threads. And its errors.
#pragma once

#include <string>
#include <system_error>

#include <csgrt/error.hpp>

#include "base/process.hpp"
#include "base/thread.hpp"

namespace csgrt {

/// OpenImageIO turns all exceptions into words.
[[noreturn]] inline void throw_from(const std::string& what, const std::string& why) {
    throw Error(why.find("std::bad_alloc") == why.npos ? Status::file : Status::out_of_memory, what + why);
}

inline FirstUser pictures_user;

/// Calls work(), by a thread from which theirs inherit. Throws Error (file) in a child of the process that did so
/// first: it would wait for threads that it has not.
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
