// Layout: the records, opcodes and limits that host and device share. They are defined in this file alone. The host
// asserts their sizes and offsets (src/kernel_host/kernels.hpp), and a probe kernel reports the device's.
#ifndef CSGRT_SHARED_LAYOUT_H
#define CSGRT_SHARED_LAYOUT_H

#include "vectors.h"

// ---- Solids ---- A solid's parameters are `real`s from SolidRecord.first_real on; geometry/<solid>.h gives their
// meaning. Types without a fixed size (meshes, sketches) keep more in `words` (u32) from first_word on: the positions
// of their elements in `words`, `reals` and `inner_nodes`. Several solids may share these words. A solid's planes
// (faces, end caps) are PlaneRefs in `words` from first_plane on, into the one world-space table of planes.

#define SOLID_ELL 0
#define SOLID_TGC 1
#define SOLID_ARB 2  // arb4 to arb8 and arbn: a convex polyhedron, given by its planes
#define SOLID_HALF 3
#define SOLID_TOR 4
#define SOLID_EHY 5
#define SOLID_QUADRIC 6  // epa, rpc, rhc, hyp: one quadric cut by planes
#define SOLID_ETO 7
#define SOLID_PART 8
#define SOLID_SUPERELL 9
#define SOLID_HRT 10
#define SOLID_METABALL 11
#define SOLID_MESH 12     // closed surfaces of triangles: bot, ars, nmg, dsp, vol
#define SOLID_PLATE 13    // triangles with thickness
#define SOLID_EXTRUDE 14  // what curves enclose, moved along a line: extrude, ebm
#define SOLID_REVOLVE 15
#define SOLID_CROSSED_ETO 16  // an eto whose ellipse crosses the axis
#define SOLID_TYPES 17
// Types with flat faces. A ray that may run in such a face is moved a little to its side (geometry/beside.h).
#define FLAT_FACED (1u << SOLID_EXTRUDE | 1u << SOLID_REVOLVE | 1u << SOLID_MESH | 1u << SOLID_PLATE)

// Cuts of a revolve.
#define REVOLVE_WHOLE 0  // the whole turn
#define REVOLVE_LESS 1   // at most half a turn: the part between its two planes stays
#define REVOLVE_MORE 2   // more than half a turn: the part between its two planes is cut off

// Centers of solids: in eye-relative single precision they have more bits than the solids' parameters.
#ifdef CSGRT_EYE_RELATIVE
#define SOLID_CENTER wide center[3];
#else
#define SOLID_CENTER
#endif

// A solid: its type, and where its numbers, words, planes and starts are.
typedef struct {
    u32 type;
    u32 first_real;
    u32 first_word;                // into words, for types without a fixed size: counts, indices
    u32 first_plane, plane_count;  // PlaneRefs in words
    u32 first_start, start_count;  // into starts
    u32 first_leaf, leaf_count;    // into trees: the solid's leaves in terms of more than SCANNED_WORDS, ascending
    u32 begins;                    // BEGINS_x: where a term may begin to be true
    u32 alone;                     // the claim where no other solid covers: as PartitionNode.owner, or ALONE_UNKNOWN
    SOLID_CENTER
} SolidRecord;

#define BEGINS_AT_ENTRY 1u         // where a ray enters the solid: some term needs the solid
#define BEGINS_AT_EXIT 2u          // where a ray leaves the solid: some term removes the solid
#define ALONE_UNKNOWN 0xffffffffu  // the solid's terms have to be evaluated

// A plane of the world: inside is n . p <= d. All faces that lie in the plane share it, so that a ray hits them at the
// very same t.
typedef struct {
    wide nx, ny, nz, d;
} PlaneRecord;

// A direction that faces of models seldom contain. Above a surface is the side to which the direction points: a ray
// that touches several surfaces is moved to the same side of all.
#define ABOVE_Y 0.6180339887498949
#define ABOVE_Z 0.3472963553338607

// A reference to a plane: index << 1 | flip. If the flip is 1, inside is n . p >= d and the outward normal is -n.
typedef u32 PlaneRef;

// ---- Regions and their trees ---- Trees are stored in depth-first order, one word a node: 3 high bits for the
// operator, 29 low bits for the right child's position in `trees` or, in a leaf, for the solid. The left child is the
// next word. There are no complements: the scene compiler turns them into differences.

#define OP_LEAF 0
#define OP_UNION 1
#define OP_INTERSECTION 2
#define OP_DIFFERENCE 3  // left and not right
#define OP_XOR 4
#define OP_REVERSE_DIFFERENCE 5  // right and not left: the compiler puts the deeper child second
#define TREE_SHIFT 29
#define TREE_MASK 0x1fffffffu

// The depth of the stack of walk_term (boolean/claim.h). The walk pushes an entry only for a left child, and the scene
// compiler puts the child that needs the deeper stack second. So a tree of n leaves needs at most log2(n) <= 29 entries
// (Sethi and Ullman 1970).
#define TREE_STACK 30

// Ranks of regions. Regions are numbered by rank, and regions of one rank in the model's order. So the claimant of the
// least number is the first of the model among the claimants of the first rank. Regions of different ranks never
// overlap: the claim of the later rank is ignored, and no overlap is reported.
#define RANK_SOLID 0
#define RANK_PLATE 1   // FASTGEN's
#define RANK_VOLUME 2  // FASTGEN's
#define RANK_AIR 3
#define RANK_HIDDEN 4  // lights that are not drawn
#define RANKS 5
// Do two regions have the same rank? `ends`: Frame.rank_ends.
FN u32 same_rank(GLOBAL const u32* ends, u32 a, u32 b) {
    u32 rank, same = 1;
    for (rank = 0; rank < RANKS; ++rank) same &= (a < ends[rank]) == (b < ends[rank]);
    return same;
}

// A (Bloom) filter of a set of solids. Each solid has one bit, which several solids may share. A solid whose bit is not
// set is not in the set.
typedef struct {
    u32 even, odd;
} SolidFilter;

FN SolidFilter filter_of(u32 solid) {
    SolidFilter f;
    u32 bit = 1u << (solid >> 1 & 31u);
    f.even = solid & 1u ? 0u : bit;
    f.odd = solid & 1u ? bit : 0u;
    return f;
}
FN SolidFilter with(SolidFilter a, SolidFilter b) {
    a.even |= b.even;
    a.odd |= b.odd;
    return a;
}
FN u32 meet(SolidFilter a, SolidFilter b) { return (a.even & b.even) || (a.odd & b.odd); }
FN u32 within(SolidFilter a, SolidFilter b) { return !(a.even & ~b.even) && !(a.odd & ~b.odd); }

// Roles. The role of a solid says what it alone decides about a term: X - (A + B + (C - D)) is false wherever A or B is
// covered, and needs X; only where C or D is covered the term's words have to be evaluated. The table is open (linear
// probing): first 32 - log2 of its size, then how many solids the term needs (NONE: it also needs undecided solids),
// then the entries, role << TREE_SHIFT | solid, NONE if free.
#define ROLE_BLOCKS 1u
#define ROLE_NEEDED 2u
#define ROLE_UNDECIDED 3u
#define ROLES_HEADER 2u
FN u32 place_of_role(u32 solid, u32 shift) { return solid * 0x9e3779b1u >> shift; }

// A start. A region's tree is a union of terms. A term's starts are leaves such that some start is covered wherever the
// term holds: all leaves of a union, the starts of A in A - B, the starts of either operand in A and B. There is a
// record for each solid and each term that the solid starts.
typedef struct {
    u32 region;
    u32 first_word, end_word;  // of the term, in trees
    SolidFilter needed;        // solids that all cover wherever the term holds
    SolidFilter solids;        // all solids of the term
    u32 roles;                 // where the term's table of roles begins, in trees; NONE: it has no table
} StartRecord;
#define PLAIN_WORDS 16u     // words of a term; a larger term has a table of roles
#define SCANNED_WORDS 256u  // words of a term; a larger term is walked from covered leaf to covered leaf

// ---- Status trees: regions' trees for deep rays (boolean/status_tree.h) ---- Clusters are numbered in pairs: pair i
// is the clusters 2 i and 2 i + 1, and its parent is a cluster of an earlier pair. Each pair has a word in `links`: 29
// low bits are the parent, 3 high bits are the operator that sets the parent's function. The pair of a region's root
// has REGION_LINK and the region.
#define RAKE_NONE 0u     // no operator: the parent is part of the same path
#define RAKE_UNION 1u    // the parent is the union with the rest of the tree
#define RAKE_COMMON 2u   // the intersection
#define RAKE_MINUEND 3u  // the difference: the path is the minuend
#define RAKE_REMOVED 4u  // the difference: the path is removed
#define RAKE_XOR 5u
#define REGION_LINK 7u

// The appearance of a region.
typedef struct {
    float r, g, b;
    float specular, diffuse, ambient;
    u32 shine;
    float glow;  // the share of its colour that it shows in any light
} MaterialRecord;

// A light.
typedef struct {
    wide x, y, z;     // position, or the direction to the light if it is infinitely far away
    wide w;           // 1, or 0 if the light is infinitely far away
    wide bx, by, bz;  // unit vector along the beam's axis
    wide cosine;      // of the angle between the beam's axis and its edge
    float r, g, b;    // colour x intensity
    u32 beam;         // 0: the light shines everywhere, and the axis has no meaning
} LightRecord;

// SHAPED_LIGHTS: lights with beams, glow and hidden regions. A program for a scene with plain point lights alone is
// compiled without this code, which takes a GPU's registers.
#if defined(CSGRT_SHAPED_LIGHTS) || !defined(__OPENCL_VERSION__)
#define SHAPED_LIGHTS 1
#else
#define SHAPED_LIGHTS 0
#endif

// ---- Bounding volume hierarchy ---- Nodes are stored in depth-first order: an inner node's first child is the next
// node. `skip` is the node that follows after a missed box or a leaf. Solids are numbered in the order of the leaves,
// so a walk meets them in ascending order. Boxes are relative to Frame.center, rounded outward and padded for the slab
// test in float.

typedef struct {
    float low[3];
    u32 skip;
    float high[3];
    u32 leaf;  // 0: inner; else first solid << 4 | number of solids (1..15)
} BvhNode;
#define BVH_LEAF_SHIFT 4
#define BVH_LEAF_MASK 15u

// ---- Rays ----

// The rays of a batch: rays of tiles, whose numbers are listed; rays of pixels, whose numbers are listed; or the
// records of a list of rays.
#define WORK_TILES 0u
#define WORK_PIXELS 1u
#define WORK_RAYS 2u

// Pixels of a picture: columns left ... right - 1 and lines top ... bottom - 1. The rectangle begins with a tile of
// TILE * TILE pixels.
typedef struct {
    u32 left, top, right, bottom;
} ScreenBounds;

#define MOST_CLIPS 6u

// A frame: everything that the rays of a call share, such as camera, range and tolerance. First come the members whose
// type depends on the precision (`wide`), then the others.
typedef struct {
    // Camera: the ray of the pixel in column c and row r from the top left starts at eye + u*x + v*y, direction w +
    // (perspective) u*x + v*y, where x is first_x + c and y is first_y - r.
    wide eye[3];      // perspective: the eye. Orthographic: the middle of the rays' origins, before the whole model
    wide u[3], v[3];  // one pixel to the right, one pixel up, millimetres on the picture plane
    wide w[3];        // perspective: from the eye to the picture plane's centre. Orthographic: unit direction of view
    wide center[3];   // of the sphere around all bounded solids; the hierarchy's boxes are relative to it
    wide first_x, first_y;  // of the first pixel's middle, in pixels to the right of the camera's middle and up from it
    PlaneRecord clip[MOST_CLIPS];  // the view's planes: the part of the model beyond any of them is cut away
    wide radius;
    wide t_min;      // segments that end before this distance are not wanted
    wide tolerance;  // boundaries closer than this along the ray are one event
    wide ambient;
    float background[4];  // R G B A where a ray hits nothing
    u32 width, height;
    u32 perspective;           // 0 or 1
    u32 work;                  // WORK_x: which rays the kernels are run for
    u32 first_ray, ray_count;  // the batch's range of rays
    u32 starting_node;         // leaves before this node are not seen alone: their solids start no term
    u32 unbounded_count, node_count, light_count;
    u32 every_partition;   // 0: only the first hits are wanted
    u32 channels;          // of the picture: CHANNEL_x bits
    ScreenBounds screen;   // the picture's pixels that can show anything; rays are traced only for them
    u32 rows;              // of the batch's picture if it is row-major; 0: the picture has a float a ray, in the rays'
                           // order
    u32 rank_ends[RANKS];  // the number after the last region of each rank
    u32 candidate_capacity, segment_capacity, word_capacity;  // of the batch's buffers, see shared/capacity.h
    u32 first_row;                                            // 1: the answer is the first row of each ray of a list
    u32 whole_lines;  // 1: a solid's segments may lie outside its box, so boxes outside a ray's range are tested, too
    u32 clip_count;
} Frame;

// A float for each channel of a picture.
#define MOST_CHANNELS 14
typedef struct {
    float of[MOST_CHANNELS];
} ChannelValues;

// The width of a tile. Rays are numbered in tiles of 8 x 8 pixels, so that the work-items of a group have neighbouring
// rays.
#define TILE 8u

// A ray of a list, and its range. Distances count lengths of the ray's direction.
typedef struct {
    wide ox, oy, oz, dx, dy, dz;
    wide t_near, t_far;
} RayRecord;

// An entry of a tile's list of nodes. Kernel 0 makes the list; first hits and, on processors, kernel 1 read it. The
// nodes hold every solid that the tile's rays may meet, each solid once. They are leaves, or whole subtrees where the
// list would be too long. For first hits the nearest node comes first; for every partition the nodes are in the
// hierarchy's order. The last entry has no node.
typedef struct {
    u32 node;     // NONE: the last entry
    float entry;  // a lower bound of the distance where the tile's rays enter the node, minus the distance of the
                  // scene's center
} TileNode;
#define LISTED_NODES 32u  // entries of a tile
#define PACKET_NODES 16u  // entries of a packet of listed rays, which makes its own list (list_hits.cl)

// The region of a list's first hit if it is unknown: the ray has more segments at a time than a sweep holds.
#define HIT_UNKNOWN 0xffffffffu

// The counts of a ray, which kernel 1 makes. After the scan they are the sums over the batch's earlier rays.
typedef struct {
    u32 segments;
    u32 words;  // of bit arrays: partitions_of(segments) * words_of(segments)
} RayCount;
#define COUNT_MAX 0xffffffffu  // sums saturate here, which tells the host that a batch is too large

// The count of a ray's candidates, which kernel 1 makes; kernels 1 and 2 read the sums. It has the form of RayCount, so
// that the scan can add up the counts.
typedef struct {
    u32 candidates, unused;
} CandidateCount;

// The report of a batch whose picture is row-major: its tiles by cost, and counts that the host reads when the batch is
// drawn. After the report comes a byte for each of the batch's tiles: not 0 if a ray of the tile sees something.
#define COST_CLASSES 48u
typedef struct {
    u32 tiles[COST_CLASSES];   // tiles in each class; class 0 has the tiles that see nothing
    u32 listed[COST_CLASSES];  // tiles of each class that are in the list already; class 0 is not listed
    u32 entries;               // of the list: tiles of all classes but 0, or their parts
    u32 overflows;             // first hits: rays with more segments at a time than a sweep holds
    u32 candidates;            // every partition: number of the rays' candidates, even if the buffers were too small
    RayCount total;            // of the rays' counts, also if the buffers were too small
} BatchReport;

// An entry of the list of tiles: a tile's number, and from bit PART_SHIFT on 0 for the whole tile, or PARTS + k for its
// part k. Work-items of one warp wait for each other, and in costly tiles they wait longest. So the few tiles that cost
// most have fewer rays in each warp. ASSUMED_WARP is the size of NVIDIA's warps; on a device of another size the
// picture is the same.
#define PARTS 4u
#define PART_SHIFT 26u    // numbers of tiles have 26 bits, since numbers of their 64 rays have 32
#define PARTED_CLASS 44u  // costs from 192 on (class_of in tile_list.cl)
#define ASSUMED_WARP 32u

FN u32 words_of(u32 segments) { return (segments + 31u) >> 5; }
FN u32 partitions_of(u32 segments) { return 2u * segments; }

// ---- Records that one kernel makes and a later kernel reads. One entry a ray unless said otherwise. ----

// A candidate: a solid that a ray may meet. Kernel 1 makes the candidates, sorted by ray, then by solid. Kernel 2 reads
// them.
typedef struct {
    u32 ray, solid;
    u32 count, before;  // segments of this candidate, and of the ray's earlier candidates
} Candidate;
#define UNCOUNTED COUNT_MAX       // `count` before the segments are counted
#define IN_SOME_FACE 0x80000000u  // set in `count`: the ray may run in a face of the solid (2_rays_in_faces.cl)

// A boundary of a segment. Kernel 2 stores two boundaries for each segment, in then out. A ray's segments are sorted by
// solid.
typedef struct {
    real t;
    u32 solid;
    u32 surface;  // which surface of the solid, see geometry/<solid>.h; and MISSED_...
} Boundary;

// Marks in Boundary.surface of both boundaries of a segment. The ray touches the solid along the segment, as far as
// rounding lets csgrt tell, because it runs in a face of the solid or along its wall. If the ray is moved a little to
// the mark's side, it misses the solid. Above is where ABOVE_Y and ABOVE_Z point, and below is the opposite side. Left
// and right are across both this direction and the ray (geometry/touch.h). boolean/claim.h uses the marks.
#define MISSED_ABOVE 0x40000000u
#define MISSED_BELOW 0x20000000u
#define MISSED_LEFT 0x10000000u
#define MISSED_RIGHT 0x08000000u
#define MISSED (MISSED_ABOVE | MISSED_BELOW | MISSED_LEFT | MISSED_RIGHT)
#define SURFACE_MASK \
    0x07ffffffu  // the other bits of Boundary.surface; LEAVES (geometry/crossings.h) is the highest bit
// The sides of a ray in a face: the ray as it is, side 0, and the four sides to which it is moved.
#define SIDES 5u
FN u32 missed_on(u32 side) { return side == 0 ? 0 : MISSED_ABOVE >> (side - 1u); }

// ---- Deep rays (capacity.h) ----
// A deep ray, and how far it is swept. Positions count its sorted boundaries.
typedef struct {
    u32 ray;
    u32 block, segment;             // numbers of blocks to sort and of segments that earlier deep rays have
    u32 event, at;                  // the positions of the current event and of the next event
    u32 changed;                    // the segments of boundaries before this position have been opened and closed
    u32 in_boundary, out_boundary;  // of the event: see weave
    u32 open, last;                 // nodes: see weave
    u32 open_solids;
    u32 partitions;  // woven
    u32 sides;       // SIDES: some segment has MISSED_... set; else 1
} DeepRay;
#define DEEP_BLOCK 32u  // boundaries that a work-item sorts, or merges

// A segment of a deep ray.
typedef struct {
    u32 first;          // the first segment of its solid
    u32 is_open;        // bit 0: now; bit 1: before the event
    u32 covers[SIDES];  // of a solid's first segment: how many of the solid's segments are open on each side
} DeepSegment;

// A node of a ray's linked list of partitions, which kernel 3 makes. Links are indices among the ray's 2 * segments
// nodes.
typedef struct {
    u32 in_boundary, out_boundary;  // indices, 2 * segment + side, among the ray's; NONE: the node is free
    u32 next;                       // before weaving: the boundary at this position by distance; NONE: the last node
    u32 owner;  // before evaluation: the ray; after it: the region that claimed the partition, or NONE; OVERLAP is set
                // if several regions of its rank claim it
} PartitionNode;
#define NONE 0x7fffffffu
#define OVERLAP 0x80000000u
// The first partition of a ray; NONE: the ray has none. A ray's nodes are stored in the order of its events.
FN u32 first_partition(GLOBAL const PartitionNode* nodes, u32 segments) {
    u32 k = 0;
    while (k < partitions_of(segments) && nodes[k].in_boundary == NONE) ++k;
    return k < partitions_of(segments) ? k : NONE;
}

// Counts of a ray's partitions. The host needs the sums, so the counts have the form of RayCount, which the scan adds
// up.
typedef struct {
    u32 partitions;  // woven
    u32 overlaps;    // partitions that more than one region of the owner's rank claims
} RayTally;

// The boundaries of a row (kernel 6), as indices among the batch's boundaries; NONE: the ray's range cuts the row
// there.
typedef struct {
    u32 ray, in_boundary, out_boundary;
} RowBoundaries;

// An overlap, which kernel 6 gives to the host: a partition that several regions of the owner's rank claim, and the
// partition's index among the ray's nodes.
typedef struct {
    wide in, out;
    u32 ray, node;
} OverlapRecord;

// The values of one pixel. Frame.channels selects the values that the host gets.
typedef struct {
    float rgba[4];
    float z;
    float normal[3];
    u32 region, solid;  // number + 1; 0: nothing is hit
    u32 depth, partitions, overlap;
} Pixel;

// Channels by groups, in the order in which a picture stores them. A channel is a float for each of the batch's rays,
// or for each pixel of its lines.
#define CHANNEL_COLOR 1u     // R G B A
#define CHANNEL_DISTANCE 2u  // Z, the distance
#define CHANNEL_NORMAL 4u    // N.X N.Y N.Z
#define CHANNEL_IDS 8u       // region, solid
#define CHANNEL_COUNTS 16u   // depth, partitions, overlap
#define CHANNEL_DISPLAY 32u  // R G B A of 8 bits in a word

// The table that turns light into a display's bytes. `ends` has for each byte the least light that shows the next byte.
// `first` has for each of equal parts of the range 0 to 1 the byte of the part's least light; the search begins there.
#define DISPLAY_PARTS 4096u
#define DISPLAY_WORDS 1024u
typedef struct {
    float ends[256];           // the last of the ends is infinity
    u32 first[DISPLAY_WORDS];  // of four parts, the first in the lowest byte
} DisplayBytes;

FN u32 width_of(ScreenBounds w) { return w.right - w.left; }
FN u32 tiles_across(ScreenBounds w) { return (width_of(w) + TILE - 1u) / TILE; }
FN u32 tiles_down(ScreenBounds w) { return (w.bottom - w.top + TILE - 1u) / TILE; }

#endif
