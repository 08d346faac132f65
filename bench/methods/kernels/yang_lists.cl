// Yang's linked lists of segments (bench/methods/yang_lists.cpp). `heads`: of each ray its newest node. A node is a
// segment: two boundaries, and in `next` the node before it. One counter gives the nodes out. With `slices` work-items
// a ray, which share its candidates, the order in a list is that of arrival. slices 0: sorts the lists.
#define LIST_END 0xffffffffu

// The nodes of a candidate lie side by side. What does not fit is counted, and not written.
static void push_segments(Geometry g, u32 index, ray3 r, real t_min, u32 capacity, volatile __global u32* counter,
                          volatile __global u32* head, __global Boundary* boundaries, __global u32* next) {
    const SolidRecord solid = g.solids[index];
    const ray3 own = ray_at(solid, r);
    u32 near = 0, count = 0, first, i;
    if (collect_many(g, solid, index, own, t_min, 0, &count, &near)) {
#if (CSGRT_SOLIDS) & FLAT_FACED
        if (near) count = collect_beside(g, solid, index, r, t_min, 0, count);
#endif
        if (count == 0) return;
        first = atomic_add(counter, count);
        if (first + count > capacity) return;
        collect(g, solid, index, r, t_min, boundaries + 2 * (size_t)first);
    } else {
        const segments h = collect_few(g, solid, own, t_min);
        count = h.count;
        if (count == 0) return;
        first = atomic_add(counter, count);
        if (first + count > capacity) return;
        boundaries += 2 * (size_t)first;
        put_segment(boundaries, index, h.in0, h.in0_surface, h.out0, h.out0_surface);
        if (count > 1) put_segment(boundaries + 2, index, h.in1, h.in1_surface, h.out1, h.out1_surface);
    }
    for (i = first; i < first + count; ++i) next[i] = atomic_xchg(head, i);
}

static u32 is_before(__global const Boundary* boundaries, u32 a, u32 b) {
    const u32 solid_a = boundaries[2 * (size_t)a].solid, solid_b = boundaries[2 * (size_t)b].solid;
    return solid_a < solid_b || (solid_a == solid_b && a < b);
}

// By ascending solid, as kernel 2 stores segments. A list that is the wrong way round takes a step a node.
static void sort_list(__global u32* head, __global const Boundary* boundaries, __global u32* next) {
    u32 node = *head, sorted = LIST_END, after, place;
    while (node != LIST_END) {
        after = next[node];
        if (sorted == LIST_END || is_before(boundaries, node, sorted)) {
            next[node] = sorted;
            sorted = node;
        } else {
            for (place = sorted; next[place] != LIST_END && is_before(boundaries, next[place], node);)
                place = next[place];
            next[node] = next[place];
            next[place] = node;
        }
        node = after;
    }
    *head = sorted;
}

__kernel void yang_lists(__global const Frame* frame, __global const BvhNode* nodes, GEOMETRY_ARGS,
                         __global const RayRecord* rays, __global const u32* listed, u32 slices, u32 capacity,
                         volatile __global u32* counter, __global u32* heads, __global Boundary* boundaries,
                         __global u32* next) {
    const u32 id = (u32)get_global_id(0), ray = slices ? id / slices : id, slice = slices ? id % slices : 0;
    const Geometry g = GEOMETRY;
    ray3 r;
    ray_range wanted;
    if (ray >= frame->ray_count) return;
    if (slices == 0) {
        sort_list(heads + ray, boundaries, next);
    } else if (ray_of(frame, rays, number_of(frame, listed, ray), &r, &wanted)) {
        const ray_range within = range_of_boxes(frame, wanted);
        const slab_ray s = make_slab_ray(offset_from(frame_center(frame), r.o), r.d, REAL(frame->radius), within.t_min);
        const single range_end = end_of_range(s, REAL(frame->radius), within.t_max);
        bvh_cursor cursor = bvh_over(s.hits_sphere ? frame->node_count : 0);
        u32 solid = 0, end = frame->unbounded_count, candidate = 0, leaf;
        do {
            for (; solid < end; ++solid, ++candidate)
                if (candidate % slices == slice)
                    push_segments(g, solid, r, wanted.t_min, capacity, counter, heads + ray, boundaries, next);
            leaf = next_leaf_before(s, range_end, nodes, &cursor);
            solid = leaf >> BVH_LEAF_SHIFT;
            end = solid + (leaf & BVH_LEAF_MASK);
        } while (leaf);
    }
}
