// The kernel of a method that looks at each partition by itself: KERNEL is its name, REGION_HOLDS(tables, coverage,
// region) the method's own function. A work-item is a node.
//
// Regions are numbered by rank, so the least that claims is the owner. Overlaps are not looked for.
#define FIRST_CLAIM(region)              \
    region = next_region(tables, &c, 0); \
    while (region != NONE && !REGION_HOLDS(tables, &c, region)) region = next_region(tables, &c, region + 1);

__kernel void KERNEL(__global const Frame* frame, __global const RayCount* offsets,
                     __global const Boundary* all_boundaries, __global const u32* all_bits,
                     __global PartitionNode* nodes, __global const u32* tables, __global u32* memory) {
    const u32 id = (u32)get_global_id(0);
    coverage c;
    RayCount offset;
    u32 ray, owner = NONE, side, here, moved;
    (void)memory;
    if (id >= 2 * segments_of(frame, offsets) || nodes[id].in_boundary == NONE) return;
    ray = nodes[id].owner;
    offset = offsets[ray];
    c.segments = offsets[ray + 1].segments - offset.segments;
    c.boundaries = all_boundaries + 2 * (size_t)offset.segments;
    c.bits = all_bits + offset.words + (id - 2 * offset.segments) * words_of(c.segments);
    list_coverage(&c, 0);
    moved = c.marked && !is_alone(&c);  // to each side of the face that the ray runs in
    for (side = moved; side < (moved ? SIDES : 1u); ++side) {
        if (moved) list_coverage(&c, missed_on(side));
        FIRST_CLAIM(here)
        if (here < owner) owner = here;
    }
    nodes[id].owner = owner;
}
#undef FIRST_CLAIM
