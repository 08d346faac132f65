// Settings: the methods, devices and limits of a Renderer.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>

#include <csgrt/method.hpp>

namespace csgrt {

/// The settings of a Renderer, a Verifier and prepare_devices(), which copy them.
struct Settings {
    bool reference = false;  ///< The CPU reference computes, not a device.
    /// Which device: its number in the list of devices, its type ("cpu", "gpu"), or part of its name or platform;
    /// several with commas between them, or all "gpus", share the work. "": a GPU if there is one, else a native
    /// device, else any device, else the reference, with a warning.
    std::string device = {};
    /// Calls wait until a GPU's kernels are compiled; else this processor computes until then, with the same bits. A
    /// driver takes up to half a minute to compile. Measurements need the GPU from the first call on.
    bool wait_for_device = false;
    /// Seconds that a device may take for an answer before it is given up; 0: no limit. Negative: 60 s for a GPU, no
    /// limit for a processor, whose kernels take as long as the rays do. A device that is given up is lost: the call
    /// throws Error (device_fault), and so do all later calls of the Renderer. The driver's memory is not freed until
    /// the process ends. Calls of the driver that do not return, for example of its compiler, have no time limit.
    double device_timeout = -1;
    /// Bytes of memory to use on each device; a frame that needs more is drawn in batches. 0: what the device has.
    std::uint64_t max_memory = 0;
    /// The largest number of instances: a solid that the trees use n times counts n times. They are counted before any
    /// is made. A scene with more instances throws Error (scene). A solid with many parts counts as several
    /// (docs/limits.md). 0: Limits::instances, or twice the number of the scene's solids if that is more. At most
    /// Limits::most_instances.
    std::uint64_t max_instances = 0;
    Precision precision = Precision::double_;      ///< Number type of the geometry; single precision is relative to the
                                                   ///< eye.
    Tolerance tolerance_rule = Tolerance::length;  ///< The rule by which boundaries of segments along a ray count as
                                                   ///< one point.
    double tolerance = -1;  ///< Millimetres along a ray, if tolerance_rule is a length; negative: the scene's.
    bool air = false;       ///< Regions of air are part of the model.
    /// Solids of types that csgrt does not know are left out, with a warning, as they always are in a BRL-CAD database
    /// that is not read strictly.
    bool skip_unsupported = false;
    /// The model's colours are shaded as they are, as BRL-CAD does; else they are decoded from sRGB to linear light
    /// first.
    bool display_shading = false;
    /// The CPU reference traces the first batch of rays and every N-th after it as well, and a call whose bits differ
    /// fails. The call throws Error (device_fault) that names the pixel and the channel, or the ray. 0: none. Batches
    /// are as large as the device's memory and kind allow. The reference is far slower than a device.
    unsigned check = 0;
    /// Threads that work on processors at a time, for all calls together. These threads compute for the reference and a
    /// native device, compile scenes and copy pixels into pictures. 0: one for each processor.
    unsigned threads = 0;
    /// A function that is called with the done fraction, and ends the call if it returns false. The calling thread
    /// calls it while other threads work: with 0 at the beginning, then every 20 ms, and with 1 when all is done. A
    /// call that it ends throws Error (interrupted): on a processor within 50 ms, except during a single ray that takes
    /// longer and while a driver compiles kernels; on a GPU after the kernels that are queued. The answer to the last
    /// call has no effect. It must not use the object whose call it reports.
    std::function<bool(double)> progress = {};
    /// Always empty for users. csgrt's own benchmarks choose methods by it.
    std::shared_ptr<const struct Laboratory> laboratory = {};
};

}  // namespace csgrt
