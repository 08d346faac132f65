// How a Renderer computes, and on what.
#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include <csgrt/method.hpp>

namespace csgrt {

/// What a Renderer, a Verifier and prepare_devices() are given. They copy it.
struct Settings {
    bool reference = false;  ///< true: the CPU reference computes, and no device
    /// Which device: a number (the index in devices()), "cpu", "gpu", or part of a device's or a platform's name.
    /// Several devices share the work of a call: "gpus" (all GPUs), or choices with commas between them ("0,1"). "": a
    /// GPU if there is one, else a native device, else any device, else the reference, with a warning.
    std::string device = {};
    /// A driver takes up to half a minute to compile the kernels for a GPU. Until then a native device computes, with
    /// the same bits. True: calls wait for the GPU instead, as measurements need it.
    bool wait_for_device = false;
    /// Seconds that a call waits for an answer of a device. A device that gives none is lost: the call throws Error
    /// (device_fault), and so do all later calls of the Renderer; what the driver holds stays until the process ends.
    /// 0: any time. Negative: 60 s for a GPU, any time for a processor, whose kernels take as long as the rays do. A
    /// call of the driver that does not return, such as its compiler's, is waited for.
    double device_timeout = -1;
    std::uint64_t max_memory = 0;  ///< bytes of memory to use on each device; 0: what the device has
    /// Most instances: solids, as often as the trees use them. They are counted before any is made, and a scene of more
    /// throws Error (scene). One with many parts counts as several (docs/limits.md). 0: Limits::instances, or twice as
    /// many as the scene's solids once each, if that is more. At most Limits::most_instances.
    std::uint64_t max_instances = 0;
    Precision precision = Precision::double_;
    Quartic quartic = Quartic::bracketed;
    /// On a device only: its compiler may contract a product and a sum into one operation (fma). Results then differ
    /// from the reference's.
    bool contraction = false;
    Tolerance tolerance_rule = Tolerance::length;
    double tolerance = -1;          ///< millimetres, for Tolerance::length; negative: the scene's tolerance
    bool air = false;               ///< true: air regions are part of the model
    bool skip_unsupported = false;  ///< true: solids of unknown types are left out with a warning, as in lenient scenes
    /// True: the model's colours are shaded as they are, as BRL-CAD does. False: they are decoded to linear light
    /// first.
    bool display_shading = false;
    /// n: the CPU reference traces the first batch of rays, and every n-th after it, as well. A call whose bits differ
    /// throws Error (device_fault) that names the pixel and the channel, or the ray. 0: none. Batches are as large as
    /// the device's memory and kind allow, and the reference is slower by far. Not with `contraction`.
    unsigned check = 0;
    /// That work on processors at a time: for the reference, a native device, the compilation of the scene and pixels
    /// on their way into a picture. 0: one for each processor. Renderers share them.
    unsigned threads = 0;
    /// Called with the done fraction, by the thread whose call it is, which waits while others work: with 0 at the
    /// beginning of a call, then every 20 ms, and with 1 when all is done. If it returns false before that, the call
    /// ends and throws Error (interrupted): on a processor within 50 ms, but for a single ray that takes longer and
    /// for a driver that compiles kernels; on a GPU after the kernels that are queued. The answer to the last call
    /// changes nothing. It must not use the object whose call it reports.
    std::function<bool(double)> progress = {};
};

}  // namespace csgrt
