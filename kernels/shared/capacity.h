// Memory for what a batch's rays need. The host has kernels queued before it knows how much that is; each kernel
// compares the sums with the capacity of the buffers at hand, and where that does not do it writes nothing. The host,
// which learns from the batch's tally (kernel 5) that it did not do, has the rays counted, allocates exactly what they
// need, and has them run again.
#ifndef CSGRT_SHARED_CAPACITY_H
#define CSGRT_SHARED_CAPACITY_H

#include "layout.h"

// How many candidates `places`, the sums over the rays' counts, has; none if there is no memory for all of them.
FN u32 candidates_of(GLOBAL const Frame* f, GLOBAL const RayCount* places) {
    const u32 count = places[f->ray_count].segments;
    return count <= f->candidate_capacity ? count : 0;
}

// Is there memory for all segments that `offsets`, the sums over the rays' counts, has, and for their partitions' bits?
FN int segments_fit(GLOBAL const Frame* f, GLOBAL const RayCount* offsets) {
    const RayCount total = offsets[f->ray_count];
    return total.segments <= f->segment_capacity && total.words <= f->word_capacity;
}
FN u32 segments_of(GLOBAL const Frame* f, GLOBAL const RayCount* offsets) {
    return segments_fit(f, offsets) ? offsets[f->ray_count].segments : 0;
}

#endif
