// List tracers: the interface that traces lists of rays. A Model traces on the caller's thread, a Renderer by its
// backend.
#pragma once

#include "rays/list.hpp"
#include "rays/row_receivers.hpp"

namespace csgrt {

/// The regions that claim partitions: all regions, the regions that pictures show, or only the ghosts.
enum class ClaimingRegions { all, shown, ghosts };

class ListTracer {
public:
    virtual ~ListTracer() = default;
    /// Traces a list and puts its rows into the receiver.
    virtual void trace(const RayList& list, RowReceiver& receiver, ClaimingRegions claims) const = 0;
};

}  // namespace csgrt
