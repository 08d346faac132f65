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
    std::uint64_t max_memory = 0;  ///< bytes of memory to use on each device; 0: what the device has
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
    unsigned threads = 0;  ///< of the reference and of a native device; 0: one for each processor
    /// Called from time to time during a call with the done fraction, 0 to 1. If it returns false the call stops and
    /// throws Error (interrupted). The library calls it from its own threads or from the caller's, never from two at
    /// once. It must not use the object whose call it reports.
    std::function<bool(double)> progress = {};
};

}  // namespace csgrt
