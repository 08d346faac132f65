// Memory for what a tile's rays need. The host counts it (kernel 1), then allocates exactly that, and has kernels run by as many
// work-items as there are entries. Or, while other tiles are under way (CSGRT_AHEAD), it has all kernels queued before it knows, and
// tells them what room there is: each looks whether that does, and its work-items take several entries, or none. What the rays need
// stands behind the sums over them, and in the tile's tally (kernel 5). `first`: of the launches before this one, how many items.
#ifndef CSGRT_ROOM_H
#define CSGRT_ROOM_H

#include "shared/layout.h"

#ifdef CSGRT_AHEAD
FN u32 has_room(__global const Frame* frame, __global const RayCount* sums, RayCount room) {
    const RayCount needed = sums[frame->ray_count];
    return needed.segments <= room.segments && needed.words <= room.words;
}
// Of those that `sums` places: none if there is no room for them.
FN u32 entries_of(__global const Frame* frame, __global const RayCount* sums, RayCount room) {
    return has_room(frame, sums, room) ? sums[frame->ray_count].segments : 0;
}
#define FOR_ENTRIES_FROM(first, id, size) for (id = (first) + (u32)get_global_id(0); id < (size); id += (u32)get_global_size(0))
#else
#define has_room(frame, sums, room) 1
#define entries_of(frame, sums, room) (room).segments
#define FOR_ENTRIES_FROM(first, id, size) if ((id = (first) + (u32)get_global_id(0)) < (size))
#endif
#define FOR_ENTRIES(id, size) FOR_ENTRIES_FROM(0, id, size)

#endif
