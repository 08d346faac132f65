// Batch source: divides the ranges of a frame's or a list's rays into batches.
#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <utility>
#include <vector>

#include "pipeline/scheduling/frame_parts.hpp"
#include "pipeline/batch.hpp"

namespace csgrt {

/// Returns the next range of rays; empty: no rays are left.
using TakeRays = std::function<RayNumbers()>;

/// The source returns batches of rays, each as large as the memory allows. A batch that does not fit is given back, and
/// the source returns its rays again, whole or in halves.
class BatchSource {
public:
    /// Makes a source. `most`: the most rays of a batch, read when a range is taken. `row`: the rays of a row of the
    /// screen's tiles, so that a batch is whole rows, or a part of one row; 0: the rays of a list.
    BatchSource(TakeRays take, std::function<std::uint64_t()> most, std::uint64_t row)
        : take_(std::move(take)), most_(std::move(most)), row_(row) {}

    /// Returns true if no rays are left. Takes the next range if nothing is left of the last range.
    bool is_empty();
    /// Returns the next batch; a batch without rays if no rays are left. `most`: a further limit.
    RayBatch next(std::uint64_t most = std::numeric_limits<std::uint64_t>::max());
    /// Gives a batch back: next() will return it before all other rays. Of several batches the last comes first.
    void give_back(const RayBatch& batch) { left_.push_back({batch.first, std::uint64_t{batch.first} + batch.rays}); }
    /// Gives a batch back in two halves. Throws Error (out_of_memory) with `budget` in its message if the batch has one
    /// ray.
    void halve(const RayBatch& batch, std::uint64_t budget);

private:
    TakeRays take_;
    std::function<std::uint64_t()> most_;
    std::uint64_t row_, size_ = 0;
    std::vector<RayNumbers> left_;
    bool has_ended_ = false;
};

}  // namespace csgrt
