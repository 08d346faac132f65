// OpenImageIO's threads, and OpenEXR's: of one process, and with the state of csgrt's threads.
#pragma once

#include <string>

#include <csgrt/error.hpp>

#include "base/process.hpp"
#include "base/thread.hpp"

namespace csgrt {

inline FirstUser pictures_user;

/// Calls work(), by a thread from which theirs inherit. Throws Error (file) in a child of the process that did so
/// first: it would wait for threads that it has not.
template <class Work>
auto with_image_threads(const std::string& name, const Work& work) {
    if (!pictures_user.is_this_process())
        throw Error(Status::file, name + ": a picture was read or written before this process was forked, by threads " +
                                      "of OpenImageIO's that this process has not");
    return start_async(work).get();
}

}  // namespace csgrt
