// A list of rays as a call brings it -> the kernels' records.
#pragma once

#include <cstdint>
#include <span>

#include <csgrt/partitions.hpp>

#include "kernel_host/kernels.hpp"

namespace csgrt {

class RayList {
public:
    /// Throws Error (usage) that has the index of the first ray that Limits or its range excludes. What it is given
    /// must outlive it.
    RayList(std::span<const Ray> rays, const RayRanges& ranges);

    std::uint64_t size() const { return numbers_.empty() ? rays_.size() : numbers_.size(); }
    /// The rays of these numbers, which must outlive the list.
    RayList some(std::span<const std::uint32_t> numbers) const {
        RayList list = *this;
        list.numbers_ = numbers;
        return list;
    }
    /// A direction of unusual length is divided by a power of two, and the range multiplied by it.
    kernel::RayRecord record(std::uint64_t ray) const;
    /// Those of `records.size()` rays from the first on.
    void fill(std::uint64_t first, std::span<kernel::RayRecord> records) const {
        for (kernel::RayRecord& record : records) record = this->record(first++);
    }
    /// Distances in the answer become those in lengths of the rays' own directions.
    void restore_lengths(Partitions& answer) const;

private:
    std::span<const Ray> rays_;
    RayRanges ranges_;
    std::span<const std::uint32_t> numbers_;  ///< empty: all rays
    bool is_any_scaled_ = false;
};

}  // namespace csgrt
