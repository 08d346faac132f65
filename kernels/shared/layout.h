// THE one file for every record that crosses the bus, every opcode and every limit that host and device share. Sizes
// and offsets are asserted on the host (src/kernel_host/kernels.hpp) and reported by a probe kernel from the device.
#ifndef CSGRT_SHARED_LAYOUT_H
#define CSGRT_SHARED_LAYOUT_H

#include "vectors.h"

// ---- Solids ----
// A solid's parameters are `real`s from SolidRecord.first_real on; what they mean stands in geometry/<solid>.h.
// Solids of any size keep the rest in `words` (u32) from first_word on, which several may share: positions in `words`,
// `reals` and `inner_nodes` of what they are made of.
// Its planes (faces, end caps) are PlaneRefs in `words` from first_plane on, into the one world-space table of planes.

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
#define SOLID_CROSSED_ETO 16  // an eto whose ellipse reaches across the axis
#define SOLID_TYPES 17
// Types of which a ray that may run in a flat face is answered a step aside of it (geometry/beside.h).
#define FLAT_FACED (1u << SOLID_EXTRUDE | 1u << SOLID_REVOLVE | 1u << SOLID_MESH | 1u << SOLID_PLATE)

// How a revolve is cut.
#define REVOLVE_WHOLE 0  // not at all
#define REVOLVE_LESS 1   // at most half a turn: what lies between its two planes stays
#define REVOLVE_MORE 2   // more: what lies between them is cut off

// In eye-relative single precision a solid's center is known better than its parameters.
#ifdef CSGRT_EYE_RELATIVE
#define SOLID_CENTER wide center[3];
#else
#define SOLID_CENTER
#endif

typedef struct {
    u32 type;
    u32 first_real;
    u32 first_word;                // into words, for solids of any size: counts, indices
    u32 first_plane, plane_count;  // PlaneRefs in words
    u32 first_start, start_count;  // into starts
    u32 first_leaf, leaf_count;    // into trees: where it stands in terms of more than SCANNED_WORDS, ascending
    u32 begins;                    // BEGINS_x: where it may be that a term begins to be true
    u32 alone;                     // what claims where it alone covers: as PartitionNode.owner, or ALONE_UNKNOWN
    SOLID_CENTER
} SolidRecord;

#define BEGINS_AT_ENTRY 1u         // where a ray enters the solid: some term needs it
#define BEGINS_AT_EXIT 2u          // where it leaves it: it is removed from some term
#define ALONE_UNKNOWN 0xffffffffu  // its terms have to be looked at

// A plane of the world: inside is n . p <= d. Shared by all faces that lie in it, so that they are hit at the very
// same t.
typedef struct {
    wide nx, ny, nz, d;
} PlaneRecord;

// Above a surface is the side to which this direction points, which faces of models seldom contain: a ray that
// touches several surfaces is moved to the same side of all.
#define ABOVE_Y 0.6180339887498949
#define ABOVE_Z 0.3472963553338607

// A reference to a plane: index << 1 | flip. Flipped, inside is n . p >= d and the outward normal -n.
typedef u32 PlaneRef;

// ---- Regions and their trees ----
// Depth-first order, one word a node: 3 high bits the operator, 29 low bits the right child's position in `trees` or,
// for a leaf, the solid. The left child is the next word. There are no complements: the compiler has them vanish in
// differences.

#define OP_LEAF 0
#define OP_UNION 1
#define OP_INTERSECTION 2
#define OP_DIFFERENCE 3  // left and not right
#define OP_XOR 4
#define OP_REVERSE_DIFFERENCE 5  // right and not left: the compiler puts the deeper child second
#define TREE_SHIFT 29
#define TREE_MASK 0x1fffffffu

// The walk of a large term pushes only on the way into a left child, and the compiler puts the child that needs the
// deeper stack second, so a tree of n leaves needs at most log2(n) <= 29 entries (Sethi and Ullman 1970).
#define TREE_STACK 30

// Regions are numbered by rank, and those of one rank in the model's order: the claim of the least number is the
// first in the model among those of the first rank. Regions of different ranks never overlap: the later one yields,
// without a word.
#define RANK_SOLID 0
#define RANK_PLATE 1   // FASTGEN's
#define RANK_VOLUME 2  // FASTGEN's
#define RANK_AIR 3
#define RANK_HIDDEN 4  // lights that are not drawn: no pixel shows them
#define RANKS 5
// `ends`: Frame.rank_ends.
FN u32 same_rank(GLOBAL const u32* ends, u32 a, u32 b) {
    u32 rank, same = 1;
    for (rank = 0; rank < RANKS; ++rank) same &= (a < ends[rank]) == (b < ends[rank]);
    return same;
}

// A set of solids, known by a bit each, which others may share: what is not in the filter is not in the set.
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

// What a term is, as far as one solid alone says it: X - (A + B + (C - D)) is empty wherever A or B is covered, and
// needs X; only where C or D is covered have its words to be looked at. The table is open (linear probing): 32 - log2
// of its size, how many solids the term needs (NONE: more than solids), then entries, role << TREE_SHIFT | solid,
// NONE if free.
#define ROLE_BLOCKS 1u
#define ROLE_NEEDED 2u
#define ROLE_UNDECIDED 3u
#define ROLES_HEADER 2u
FN u32 place_of_role(u32 solid, u32 shift) { return solid * 0x9e3779b1u >> shift; }

// A region's tree is a union of terms. A term's starts are leaves such that some one of them is covered wherever the
// term is: all of a union, those of A in A - B, those of either in A and B. A record for each solid and term that it
// starts.
typedef struct {
    u32 region;
    u32 first_word, end_word;  // of the term, in trees
    SolidFilter needed;        // solids that all cover wherever the term is
    SolidFilter solids;        // all of the term's
    u32 roles;                 // where its table of roles begins, in trees; NONE: it has none
} StartRecord;
#define PLAIN_WORDS 16u     // of a term; a larger one has a table of roles
#define SCANNED_WORDS 256u  // of a term; a larger one is walked, by its covered leaves

// ---- Status trees: regions' trees for deep rays (boolean/status_tree.h) ----
// Clusters are numbered in pairs, each with its parent after it: 29 low bits a word of `links` the pair's parent, 3
// high bits what becomes of the parent's function. Of a pair that is a region's: REGION_LINK, and the region.
#define RAKE_NONE 0u     // nothing: the parent is part of the same path
#define RAKE_UNION 1u    // the parent is the union with what stays of the tree
#define RAKE_COMMON 2u   // the intersection
#define RAKE_MINUEND 3u  // the difference, from it
#define RAKE_REMOVED 4u  // the difference, of it
#define RAKE_XOR 5u
#define REGION_LINK 7u

typedef struct {
    float r, g, b;
    float specular, diffuse, ambient;
    u32 shine;
    float glow;  // what it shows of its colour whatever lights it
} MaterialRecord;

typedef struct {
    wide x, y, z;     // position, or the direction to it if it is infinitely far away
    wide w;           // 1, or 0 of such a light
    wide bx, by, bz;  // unit vector along the beam's axis
    wide cosine;      // of the angle between that and the beam's edge
    float r, g, b;    // colour x intensity
    u32 beam;         // 0: it shines everywhere, without regard to the axis
} LightRecord;

// A program for a scene whose lights are plain points, without glow and without hidden regions, is compiled without
// these: they take a GPU's registers.
#if defined(CSGRT_SHAPED_LIGHTS) || !defined(__OPENCL_VERSION__)
#define SHAPED_LIGHTS 1
#else
#define SHAPED_LIGHTS 0
#endif

// ---- Bounding volume hierarchy ----
// Depth-first order: an inner node's first child is the next node; `skip` is the next node when the box is missed, or
// after a leaf. Solids are numbered in the order of the leaves, so a walk meets them in ascending order.
// Boxes are relative to Frame.center, rounded outward and padded for the slab test in float.

typedef struct {
    float low[3];
    u32 skip;
    float high[3];
    u32 leaf;  // 0: inner; else first solid << 4 | number of solids (1..15)
} BvhNode;
#define BVH_LEAF_SHIFT 4
#define BVH_LEAF_MASK 15u

// ---- Rays ----

// The rays of a batch are listed by their tiles' numbers, by pixels' own numbers, or they are rays that the host gave.
#define WORK_TILES 0u
#define WORK_PIXELS 1u
#define WORK_RAYS 2u

// Pixels of a picture: columns left ... right - 1 and lines top ... bottom - 1. It begins with a tile of TILE * TILE
// pixels.
typedef struct {
    u32 left, top, right, bottom;
} ScreenBounds;

#define MOST_CLIPS 6u

// First the numbers that are `wide`, then what is the same in all precisions.
typedef struct {
    // Camera: the ray of the pixel in column c and row r from the top left starts at eye + u*x + v*y, direction
    // w + (perspective) u*x + v*y, where x is first_x + c and y is first_y - r.
    wide eye[3];      // perspective: the eye. Orthographic: the middle of where rays start, before the whole model
    wide u[3], v[3];  // one pixel to the right, one pixel up, millimetres on the picture plane
    wide w[3];        // perspective: from the eye to the picture plane's centre. Orthographic: unit direction of view
    wide center[3];   // of the sphere around all bounded solids; the hierarchy's boxes are relative to it
    wide first_x, first_y;  // of the first pixel's middle, in pixels to the right of the camera's middle and up from it
    PlaneRecord clip[MOST_CLIPS];  // the view's planes: what is beyond any of them is gone
    wide radius;
    wide t_min;      // segments that end before this distance are not wanted
    wide tolerance;  // ends closer than this along the ray are one
    wide ambient;
    float background[4];  // R G B A where a ray hits nothing
    u32 width, height;
    u32 perspective;           // 0 or 1
    u32 work;                  // WORK_x: which rays the kernels are run for
    u32 first_ray, ray_count;  // this batch
    u32 starting_node;         // the hierarchy's leaves before it are not seen alone: their solids start no term
    u32 unbounded_count, node_count, light_count;
    u32 every_partition;   // 0: only the first hits are wanted
    u32 channels;          // of the picture: CHANNEL_x bits
    ScreenBounds screen;   // the picture's pixels that can show anything; none of the others has a ray
    u32 rows;              // of the batch's picture if it is row-major; 0: it has a float a ray, in the rays' order
    u32 rank_ends[RANKS];  // the number behind the last region of each rank
    u32 candidate_capacity, segment_capacity, word_capacity;  // of the batch's buffers, see shared/capacity.h
    u32 first_row;                                            // 1: of each ray of a list the first row alone
    u32 whole_lines;  // 1: a solid's segments may lie outside its box, so a ray's range says nothing of boxes
    u32 clip_count;
} Frame;

// A float for each channel of a picture.
#define MOST_CHANNELS 14
typedef struct {
    float of[MOST_CHANNELS];
} ChannelValues;

// Rays are numbered in tiles of 8 x 8 pixels, so that the work-items of a group look at neighbours.
#define TILE 8u

// A ray of a list, and what of it is wanted. Distances count lengths of its direction.
typedef struct {
    wide ox, oy, oz, dx, dy, dz;
    wide t_near, t_far;
} RayRecord;

// 0 cull tiles -> first hits, and kernel 1 on processors: nodes of the hierarchy that hold all that a tile's rays may
// meet, each one thing once: leaves, or subtrees where there is much. For first hits the nearest comes first, for every
// partition they stand in the hierarchy's order. The last entry has no node.
typedef struct {
    u32 node;     // NONE: no more
    float entry;  // no ray of the tile comes there before this distance, less that of the scene's center
} TileNode;
#define LISTED_NODES 32u  // entries of a tile
#define PACKET_NODES 16u  // of a packet of a list, which makes them itself; their distances are the packet's own

// First hits of a list, in place of a region: the ray has more segments at a time than a sweep has room for.
#define HIT_UNKNOWN 0xffffffffu

// 1 count segments -> scan. Before the scan: this ray's counts; after it: the sum over the rays before it in the
// batch.
typedef struct {
    u32 segments;
    u32 words;  // of bit arrays: partitions_of(segments) * words_of(segments)
} RayCount;
#define COUNT_MAX 0xffffffffu  // sums saturate here, which tells the host that a batch is too large

// 1 find candidates -> scan -> 1, 2: the same of candidates, as RayCount, so that the scan adds them up.
typedef struct {
    u32 candidates, unused;
} CandidateCount;

// Of a batch whose picture is row-major: its tiles by what they cost, and what the host wants to know when it is drawn.
// Behind it stands a byte for each of the batch's tiles: not 0 if a ray of it sees something.
#define COST_CLASSES 48u
typedef struct {
    u32 tiles[COST_CLASSES];   // how many of each class; of class 0 those that see nothing
    u32 listed[COST_CLASSES];  // of them, those that have their place in the list, where class 0 has none
    u32 entries;               // of that list: tiles of all classes but 0, or parts of them
    u32 overflows;             // first hits: rays without room, in no order
    u32 candidates;            // every partition: what its rays have, whether there was room for it or not
    RayCount total;            // the same
} BatchReport;

// An entry of the list: a tile's number, and above it 0, or PARTS and more for each of its parts. Work-items of one
// warp wait for each other, the more so the more there is to do, so the few tiles that cost most have fewer rays in
// each warp. ASSUMED_WARP is the size of NVIDIA's; on a device of another the picture is the same.
#define PARTS 4u
#define PART_SHIFT 26u    // tiles are fewer: their rays have numbers of 32 bits
#define PARTED_CLASS 44u  // costs from 192 on (class_of in tile_list.cl)
#define ASSUMED_WARP 32u

FN u32 words_of(u32 segments) { return (segments + 31u) >> 5; }
FN u32 partitions_of(u32 segments) { return 2u * segments; }

// ---- What the five kernels hand on. One entry a ray unless said otherwise. ----

// 1 count segments -> 2 store segments: a solid that a ray may meet. Sorted by ray, then by solid.
typedef struct {
    u32 ray, solid;
    u32 count, before;  // segments: how many, and how many the ray has of earlier candidates
} Candidate;
#define UNCOUNTED COUNT_MAX       // of the segments, yet
#define IN_SOME_FACE 0x80000000u  // set in `count`: the ray may run in a face of the solid (2_rays_in_faces.cl)

// 2 store segments -> weave: two ends a segment, in then out, by ascending solid.
typedef struct {
    real t;
    u32 solid;
    u32 surface;  // which surface of the solid, see geometry/<solid>.h; and MISSED_...
} End;

// Set in End.surface of both ends of a segment along which the ray touches the solid, as far as rounding lets one
// say, because it runs in a face of it or along its wall: moved a little to that side, the ray misses the solid. Above
// and below are where ABOVE_Y and ABOVE_Z point, and against them; left and right are across both this and the ray
// (geometry/touch.h). boolean/claim.h tells what for.
#define MISSED_ABOVE 0x40000000u
#define MISSED_BELOW 0x20000000u
#define MISSED_LEFT 0x10000000u
#define MISSED_RIGHT 0x08000000u
#define MISSED (MISSED_ABOVE | MISSED_BELOW | MISSED_LEFT | MISSED_RIGHT)
#define SURFACE_MASK 0x07ffffffu  // the rest of End.surface; LEAVES (geometry/crossings.h) is the highest bit
// A ray in a face is looked at as it is, side 0, and on the four sides to which it is moved.
#define SIDES 5u
FN u32 missed_on(u32 side) { return side == 0 ? 0 : MISSED_ABOVE >> (side - 1u); }

// ---- Deep rays (capacity.h) ----
// A deep ray, and how far it is swept: places among its sorted ends.
typedef struct {
    u32 ray;
    u32 block, segment;   // blocks of ends to sort, and segments, of those before it
    u32 event, at;        // the event that is passed, and the one behind it
    u32 changed;          // before this, segments have been opened and closed
    u32 in_end, out_end;  // of the event: see weave
    u32 open, last;       // nodes: see weave
    u32 open_solids;
    u32 partitions;  // woven
    u32 sides;       // SIDES: some segment has MISSED_... set; else 1
} DeepRay;
#define DEEP_BLOCK 32u  // ends that a work-item sorts, or merges

// A segment of a deep ray.
typedef struct {
    u32 first;          // the first segment of its solid
    u32 is_open;        // bit 0: now; bit 1: before the event
    u32 covers[SIDES];  // of a solid's first segment: how many of the solid's are open on each side
} DeepSegment;

// 3 weave -> evaluate: linked lists by index into the ray's own 2 * segments nodes.
typedef struct {
    u32 in_end, out_end;  // ends (2 * segment + side) of this ray that bound the partition; NONE: the node is none
    u32 next;             // before weaving: the end that is in this place by distance; NONE: no more
    u32 owner;  // before evaluation: the ray; after it: the region that claimed the partition, or NONE; OVERLAP is set
                // if several of its rank wanted it
} PartitionNode;
#define NONE 0x7fffffffu
#define OVERLAP 0x80000000u
// The first partition of a ray, whose nodes stand in the order of its events; NONE: it has none.
FN u32 first_partition(GLOBAL const PartitionNode* nodes, u32 segments) {
    u32 k = 0;
    while (k < partitions_of(segments) && nodes[k].in_end == NONE) ++k;
    return k < partitions_of(segments) ? k : NONE;
}

// 3 weave -> shade -> the host, which wants the sums: as RayCount, so that the scan adds them up.
typedef struct {
    u32 partitions;  // woven
    u32 overlaps;    // of them, those that more than one region of the owner's rank wanted
} RayTally;

// 6 rows: what bounds a row of the answer to a list. Ends are those of the batch; NONE: the ray's range cuts it there.
typedef struct {
    u32 ray, in_end, out_end;
} RowEnds;

// 6 rows -> the host: a partition that several regions of the owner's rank claim, and its node among the ray's.
typedef struct {
    wide in, out;
    u32 ray, node;
} OverlapPiece;

// What is seen at one pixel; what of it the host gets is in Frame.channels.
typedef struct {
    float rgba[4];
    float z;
    float normal[3];
    u32 region, solid;  // + 1; 0: nothing
    u32 depth, partitions, overlap;
} Pixel;

// Channels by groups, in the order in which they stand in the picture. A channel is a float for each of the batch's
// rays, or for each pixel of its lines.
#define CHANNEL_COLOR 1u     // R G B A
#define CHANNEL_DISTANCE 2u  // Z
#define CHANNEL_NORMAL 4u    // N.X N.Y N.Z
#define CHANNEL_IDS 8u       // region, solid
#define CHANNEL_COUNTS 16u   // depth, partitions, overlap
#define CHANNEL_DISPLAY 32u  // R G B A of 8 bits in a word

// From light to a display's bytes: of each byte the least light that the next one shows; and of equal parts of 0 to 1
// the byte of the least light. Few parts hold the ends of several bytes.
#define DISPLAY_PARTS 4096u
#define DISPLAY_WORDS 1024u
typedef struct {
    float ends[256];           // the last one is never reached
    u32 first[DISPLAY_WORDS];  // of four parts, the first in the lowest byte
} DisplayBytes;

FN u32 width_of(ScreenBounds w) { return w.right - w.left; }
FN u32 tiles_across(ScreenBounds w) { return (width_of(w) + TILE - 1u) / TILE; }
FN u32 tiles_down(ScreenBounds w) { return (w.bottom - w.top + TILE - 1u) / TILE; }

#endif
