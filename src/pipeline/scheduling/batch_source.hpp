// Ranges of a frame's rays, or of a list's, as they are taken -> batches of them, one after another.
#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <utility>
#include <vector>

#include "pipeline/scheduling/frame_parts.hpp"
#include "pipeline/batch.hpp"

namespace csgrt {

/// The next rays; empty: there are none left.
using TakeRays = std::function<RayNumbers()>;

class BatchSource {
public:
    /// `most`: rays of a batch, asked for when a range is taken. `row`: of a row of the screen's tiles, so that a batch
    /// is whole rows, or a part of one; 0: the rays are a list's.
    BatchSource(TakeRays take, std::function<std::uint64_t()> most, std::uint64_t row)
        : take_(std::move(take)), most_(std::move(most)), row_(row) {}

    /// Takes the next range if nothing is left of the last one.
    bool is_empty();
    /// Of no rays if there are none left. `most`: a further limit.
    RayBatch next(std::uint64_t most = std::numeric_limits<std::uint64_t>::max());
    /// The batch is to come again, before all others: the last one first, if there are several.
    void give_back(const RayBatch& batch) { left_.push_back({batch.first, std::uint64_t{batch.first} + batch.rays}); }
    /// The same in smaller batches. Throws Error (out_of_memory), which tells of `budget`, if it is of one ray.
    void halve(const RayBatch& batch, std::uint64_t budget);

private:
    TakeRays take_;
    std::function<std::uint64_t()> most_;
    std::uint64_t row_, size_ = 0;
    std::vector<RayNumbers> left_;
    bool has_ended_ = false;
};

}  // namespace csgrt
