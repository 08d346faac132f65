// The answers to a list from one stage alone: from the reference, or from a partition pass.
#pragma once

#include <vector>

#include "device/discovery.hpp"
#include "native/driver.hpp"
#include "pipeline/passes/partitions.hpp"
#include "rays/along.hpp"
#include "rays/list.hpp"
#include "rays/row_receivers.hpp"
#include "reference/reference.hpp"

namespace csgrt::test {

/// Until this is gone, a native device's lists go through OpenCL's functions as other devices' do.
struct ByOpenCl {
    const OpenCl functions = native::functions();
    const NativeTable table{&functions};
};

inline std::vector<kernel::RayRecord> records_of(const std::vector<Ray>& rays) {
    const RayList list(rays, {.all = whole_line});
    std::vector<kernel::RayRecord> records(rays.size());
    list.fill(0, records);
    return records;
}

inline std::vector<RayPartitions> answers_of(const Reference& reference, const kernel::Frame& frame,
                                             const std::vector<Ray>& rays, ReferenceCounts& counts) {
    Partitions answer;
    RowCollector sink(answer, all_fields, rays.size());
    reference.trace(frame, RayList(rays, {.all = whole_line}), sink, nullptr, counts);
    return along_rays(answer);
}

/// Of the rays that the pass has traced.
inline std::vector<RayPartitions> answers_of(PartitionPass& pass, const PartitionPass::Input& input) {
    TimedKernels timed;
    Partitions answer;
    RowCollector sink(answer, all_fields, input.rays);
    if (!pass.write_rows(input, 0, all_fields, timed)) return {};
    wait_for(timed.back().second);
    pass.start_copy();
    sink.put(pass.rows().wait());
    return along_rays(answer);
}

}  // namespace csgrt::test
