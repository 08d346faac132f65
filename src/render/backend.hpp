// Backend: draws pictures and traces lists, on devices or by the CPU reference. The renderer uses only this interface.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <csgrt/renderer.hpp>

#include "base/watch.hpp"
#include "compile/frame.hpp"
#include "compile/records/converter.hpp"
#include "pipeline/readback/registered_memory.hpp"
#include "pipeline/readback/picture.hpp"
#include "rays/list.hpp"
#include "rays/row_receivers.hpp"
#include "reference/reference_kernels.hpp"
#include "render/channel_table.hpp"

namespace csgrt {

/// The memory of a frame's picture.
struct FrameMemory {
    std::span<const ChannelMemory> channels;
    std::span<const ChannelSource* const> sources;  ///< the source of each channel
    std::vector<std::uint8_t>& covered;             ///< one byte a tile: 0 if the tile has only background
    std::uint64_t& drawn_by;                        ///< the number of the backend that drew last; 0: none
    std::shared_ptr<RegisteredMemory>& registered;  ///< with the devices of the backend that drew last
};

/// A model, and its data in the precision of the backend.
struct ModelInUse {
    std::shared_ptr<const void> owner;  ///< of the scene
    const CompiledScene& scene;
    std::unique_ptr<const RecordConverter> records;   ///< for devices; null: the reference draws
    std::unique_ptr<const ReferenceKernels> kernels;  ///< for the reference; null: devices draw
};

/// The interface of backends. One thread at a time. All calls throw Error (device_fault, out_of_memory, interrupted).
class Backend {
public:
    virtual ~Backend() = default;

    /// Sets the model of the next calls.
    virtual void set_model(std::shared_ptr<const ModelInUse> model) = 0;
    virtual bool is_reference() const { return false; }
    /// Waits until a device has the kernels for every partition, or for first hits. To be called before each render()
    /// or trace().
    virtual void prepare(bool every_partition) = 0;
    /// Whether render() is likely to draw the frame's edges (PreparedFrame::edges). To be called after prepare().
    virtual bool draws_edges(const PreparedFrame&) const { return false; }
    /// Whether the last render() drew the edges. It draws none if the picture was not on a device as a whole.
    virtual bool has_drawn_edges() const { return false; }
    virtual void render(const PreparedFrame& frame, const FrameMemory& memory, Watch& watch) = 0;
    /// Puts the rows of every ray into the receiver.
    virtual void trace(const kernel::Frame& frame, const RayList& rays, RowReceiver& receiver, Watch& watch) = 0;
    /// Compares the rows with the reference's before the call ends. See SpotCheck.
    virtual void check(const kernel::Frame&, const RayList&, const RowReceiver&, Watch&) {}

    /// The name of the device, or the names of the devices, for the next call.
    virtual std::string name() const = 0;
    /// Writes the last call's counts and times.
    virtual void report(Statistics& statistics) const = 0;
    /// The method that traces every partition, or first hits, in words.
    virtual std::string method(bool every_partition) const = 0;
    /// Milliseconds that the last prepare() and the call after it spent on building kernels.
    virtual double build_ms_in_call() const { return 0; }
    /// The device that will take over, see Statistics::awaited_device.
    virtual std::string awaited() const { return {}; }
    /// The fault that kept a device, which the user did not name, from taking over; returned once.
    virtual std::optional<std::string> take_fault() { return {}; }
};

}  // namespace csgrt
