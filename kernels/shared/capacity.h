// Capacity: do a batch's rays fit the buffers? On a GPU the host queues the kernels before it knows how much the rays
// need, and states the buffers' capacity in the frame. If the capacity is too small, a kernel writes nothing. The host
// sees this in the batch's report and runs the batch again with exact sizes. Where the host counts first, as on
// processors, the capacity is COUNT_MAX.
#ifndef CSGRT_SHARED_CAPACITY_H
#define CSGRT_SHARED_CAPACITY_H

#include "layout.h"

// Returns the number of the batch's candidates; 0 if the buffers do not hold all of them. `places`: the sums over the
// rays' counts.
FN u32 candidates_of(GLOBAL const Frame* f, GLOBAL const CandidateCount* places) {
    const u32 count = places[f->ray_count].candidates;
    return count <= f->candidate_capacity ? count : 0;
}

// Do the buffers hold all segments of the batch, and the bits of their partitions? `offsets`: the sums over the rays'
// counts.
FN int segments_fit(GLOBAL const Frame* f, GLOBAL const RayCount* offsets) {
    const RayCount total = offsets[f->ray_count];
    return total.segments <= f->segment_capacity && total.words <= f->word_capacity;
}
FN u32 segments_of(GLOBAL const Frame* f, GLOBAL const RayCount* offsets) {
    return segments_fit(f, offsets) ? offsets[f->ray_count].segments : 0;
}

// Deep rays have more segments than this number. A deep ray's boundaries are sorted by merging. Its partitions are
// evaluated one after the other, from the changes between neighbours (3_deep_rays.cl). On processors this pays from 40
// segments on. But a GPU runs a batch with a deep ray again, and rays of the model havoc have up to 70 segments.
#ifndef DEEP_SEGMENTS
#define DEEP_SEGMENTS 96u
#endif
// A count of words that no buffer holds. It shows the host that the batch has a deep ray.
#define DEEP_WORDS 0x80000000u

#endif
