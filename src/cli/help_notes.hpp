// Help notes: the texts on the help pages, below the options. Lines have at most 100 bytes.
#pragma once

namespace csgrt::cli {

inline constexpr const char* render_notes = R"(
Lengths are millimetres, whatever unit the scene's file has; angles are degrees.

An EXR holds these channels, 32-bit floats:
  R G B A        linear light; A is 1, or 0 in a transparent background
  Z              distance along the ray, mm; inf where nothing is hit
  N.X N.Y N.Z    unit normal of the surface, outward
  region, solid  numbers from 1; 0 where nothing is hit
  depth          segments on the ray
  partitions     partitions on the ray
  overlap        partitions on the ray that several regions claim
Its header names the regions and solids that occur in it (csgrt:regions, csgrt:solids: JSON texts
such as {"17": "/all.g/x.r"}). A PNG holds the colours, 8 bits each, encoded as sRGB; and A if any
pixel is transparent.

A picture, and the partitions along one ray:
  csgrt scenes/operators.json -o operators.png
  printf '0 -9000 0  0 1 0\n' | csgrt shoot scenes/operators.json --rays -
)";

inline constexpr const char* shoot_notes = R"(
A ray is a line of six numbers, separated by blanks: ox oy oz dx dy dz. Blank lines are skipped, and
# begins a comment.
  ox oy oz       origin, millimetres (whatever unit the scene's file has), each at most 1e18
  dx dy dz       direction of any length; its largest component is from 1e-250 to 1e250
A number too small for a double is read as 0; one too large is an error.

The text begins with lines that start with #: version and model; counts of rays, solids and regions,
whether air is kept (useair), the tolerance (tol.dist, mm); the box of the model (box, low and high
corner in mm, or 'unbounded' or 'empty'). Then each ray, in the order of the input, has a line of
four words:
  ray            this word
  INDEX          the ray's number, from 0
  PARTITIONS     how many lines of partitions follow
  OVERLAPS       how many lines of overlaps follow these
A partition is a stretch of the ray within one region. Partitions are listed from front to back,
one on a line of 13 words:
  region         its path in the model, /all.g/left.r
  in out         where the ray enters and leaves it, in lengths of the direction: mm if that is 1.
                 The point is origin + in * direction. What ends before the origin is left out; in
                 is negative if the ray starts inside. -inf or inf: the region has no end there
  inx iny inz    unit normal where the ray enters, pointing out of the region: against the ray
  outx outy outz unit normal where the ray leaves, pointing out of the region: along the ray
                 (normal and solid of an infinite end mean nothing)
  in-solid       the solid whose surface the ray enters through: one of the region's own, one that
                 is subtracted from it, or one of the region that has the partition before it
  out-solid      the solid whose surface the ray leaves through, likewise
  in-type out-type  their types, in BRL-CAD's names: ell, tgc, arb8, ...
An overlap is a stretch that several regions claim; one of them has the partition. Its line:
  overlap        this word
  in out         as above
  region region...  the paths of all regions that claim it
Numbers have 17 digits, so that they read back to the same bits. A blank or a backslash in a name
is written as \ooo, its byte in octal. Ends closer than the tolerance are one. Regions that only
touch do not overlap. If any line of the input is wrong, all wrong lines are reported, no ray is
shot, and the exit status is 6.

With --near or --far what lies outside of that range is cut off. A cut end has the bound as its
distance, the normal 0 0 0, and - as its solid and type.

The other formats have a row for each partition, cut at the range, and no overlaps. A ray that meets
nothing has no row.
  csv            a line of names, then a line a row: ray, the ray's number; reg_name, path_name and
                 reg_id, the region's name, path and number; x y z and d of each end in mm, d being
                 BRL-CAD's: it decreases along the ray; los, the length in mm; scaled_los, los times
                 the region's los / 100; obliq of each end, the angle between ray and normal in
                 degrees, empty where the range cuts the row
  npy            an array for NumPy, of records: ray <i8; region_id, in_solid, out_solid <i4; t_in,
                 t_out <f8; in_normal, out_normal 3 x <f8. region_id is the region's index as in
                 'csgrt info --json'; a solid is -1 where the range cuts the row
  binary         the same records, of 84 bytes each, and nothing else
)";

inline constexpr const char* sample_notes = R"(
Lengths are millimetres. A region is given by its index as in 'csgrt info --json'; -1: no region
holds the point; -2, of a pixel: several do, which overlap. Of regions that overlap at a point of
--points the first counts. A plane is seen from the side to which its normal points, z up, or y
where z is the normal; its pixels are square, and it shows the model's box.
  npy            an array of int32: of points (N,), of a plane (H, W), from the top left
  csv            of points x,y,z,region_id,path; of a plane column,row,region_id,path for each pixel
                 that is not -1
  png            each region in its colour, overlaps red, nothing transparent

If any line of the points is wrong, all wrong lines are reported, and the exit status is 6.
)";

inline constexpr const char* verify_notes = R"(
Rays and distances are as in 'csgrt help shoot'. Errors of distances are given in mm and in units of
the last place. The exit status is 8 if any ray that rounding does not decide has wrong regions, or
if device and reference differ in any bit.
)";

inline constexpr const char* measure_notes = R"(
Each figure has an interval that holds the true one in 95 of 100 measures; +- is half of it. The
table has what all regions have together, then the tree, then materials. --json and --csv have all
parts, and of each: volume, which regions own (an overlap counts for the first of them) and claim
(it counts for each), area (a face between two regions counts for each), mass, centroid, moments
(xx is the integral of y^2 + z^2) and products of inertia (xy that of x y), about the world's origin
and the centroid, and a box that holds the part. Units: mm, mm^2, mm^3, kg and kg mm^2; without
densities centroid and moments are those of volume, in mm^5. With densities they are those of mass,
density x volume x los / 100, and regions without one count as weightless and are named.

A wall is measured from a face, along its inward normal, to a face that looks away within 30
degrees. ~: its faces are not parallel. The exit status is 8 if a wall is below --wall-limit.

--grid divides the model's box into cells. FILE.npz has a row for each volume of a region or a
material in a cell, and FILE.vti fractions of each cell; docs/analysis.md tells the arrays' names.

The same seed gives the same figures on every device and any number of threads, unless --time or
Ctrl-C ends the measure. Ctrl-C prints what there is; the exit status is 130 then.
)";

inline constexpr const char* check_notes = R"(
Two regions overlap where both claim a part of space; regions that only touch do not. The table has
two lines for each overlap, the deepest first. The first:
  depth mm       diameter of the largest ball that was found in it. ?: an estimate, along rays. ~:
                 near the limit, from half of --min-depth to twice --min-depth: another seed may
                 decide otherwise. What is less than half as deep is only counted
  at most        no ball in it has a larger diameter
  volume mm^3    with half of its interval of 95 %
  place mm       the centre of the ball; then 'allowed', or 'less deep' than --min-depth, or
                 'perhaps deeper': less deep, but 'at most' is not below --min-depth
The second has the paths of both regions, as --allow reads them. There * stands for any characters,
? for one, [ab] for one of several, and \ before one of these takes away its meaning. A path stands
for all regions below it, too; a pattern with blanks stands in quotation marks; the order of the
two does not matter. Rows that no overlap needs are told. The exit status is 8 if an overlap at
least --min-depth deep is not allowed.

'largest ball that is not excluded': in pairs that are not listed an overlap may hold it, and none
that is larger. --certain MM works until it is below MM; it tells the number of rays before. A pair
that is listed as less deep may still hold the ball: the last line counts such pairs, and the exit
status does not.

The same seed gives the same figures on every device and any number of threads, unless Ctrl-C ends
the check. Ctrl-C prints what there is; the exit status is 130 then.
)";

inline constexpr const char* compare_notes = R"(
X is in the units of the channel or column: mm for Z, lengths of the direction for in and out, 0 to
1 for colours, 1 for counts and numbers of regions. The exit status is 0 if nothing differs, 8 if
something does.
)";

inline constexpr const char* devices_notes = R"(
Each entry begins with the number that --device takes. Memory is in GiB (2^30 bytes). Native devices
have kernels for double precision only, compiled ahead; the kernels of other devices are compiled
when they are first used. A note names a driver that cannot be used.
)";

inline constexpr const char* view_notes = R"(
The address of a page is printed, on which the model can be turned, cut open and asked: what is
behind a pixel, and how thick it is. Whoever has the address can see the model; only programs of
this machine can reach it, unless --address says more. From another machine: ssh -L P:127.0.0.1:P
MACHINE with the port P, and the same address there. When the scene's file changes, it is loaded
again. The page's button End and Ctrl-C end the command; with - as SCENE, so does the end of who
reads its output. docs/viewer.md tells what the page can do.
)";

inline constexpr const char* info_notes = R"(
'units' is the unit that the file names. 'bounds' is the box of the regions in millimetres, or
'unbounded' or 'empty'. The operators of a tree: u union, - difference, + intersection, ^ exclusive
or, ! complement.

The object that --json prints has the keys title, units, bounds (low and high corner), solids (how
many), regions (each with index, path, fastgen, region_id, air, material_id, los, color, state,
bounds) and warnings (each with object, place, reason). Bounds are millimetres; a box that is empty
and a number that is infinite are null.
)";

inline constexpr const char* convert_notes = R"(
The scene that is written has the same geometry to the last bit, and keeps the file's unit.
)";

inline constexpr const char* exit_status =
    "\nExit status: 0 done, 2 usage, 3 scene, 4 no device, 5 out of memory, 6 file, 7 device fault,\n"
    "8 a comparison or verification differs, a wall is too thin or regions overlap, 130 interrupted.\n";

}  // namespace csgrt::cli
