// Does the device lay out the records of kernels/shared/layout.h as the host does?
#include "catch.hpp"

#include <regex>
#include <set>

#include "device/compiling_device.hpp"
#include "device/program.hpp"
#include "kernel_host/kernels.hpp"

using namespace csgrt;

// One list for both sides. That nothing of layout.h is missing here is a test of its own, below.
// clang-format off
#define CSGRT_LAYOUT(RECORD, FIELD) \
    RECORD(SolidRecord) FIELD(SolidRecord, type) FIELD(SolidRecord, first_real) FIELD(SolidRecord, first_word) \
    FIELD(SolidRecord, first_plane) FIELD(SolidRecord, plane_count) FIELD(SolidRecord, first_start) \
    FIELD(SolidRecord, start_count) FIELD(SolidRecord, first_leaf) FIELD(SolidRecord, leaf_count) \
    FIELD(SolidRecord, begins) FIELD(SolidRecord, alone) \
    RECORD(PlaneRecord) FIELD(PlaneRecord, nx) FIELD(PlaneRecord, ny) FIELD(PlaneRecord, nz) FIELD(PlaneRecord, d) \
    RECORD(SolidFilter) FIELD(SolidFilter, even) FIELD(SolidFilter, odd) \
    RECORD(StartRecord) FIELD(StartRecord, region) FIELD(StartRecord, first_word) FIELD(StartRecord, end_word) \
    FIELD(StartRecord, needed) FIELD(StartRecord, solids) FIELD(StartRecord, roles) RECORD(MaterialRecord) \
    FIELD(MaterialRecord, r) \
    FIELD(MaterialRecord, g) FIELD(MaterialRecord, b) FIELD(MaterialRecord, specular) FIELD(MaterialRecord, diffuse) \
    FIELD(MaterialRecord, ambient) FIELD(MaterialRecord, shine) FIELD(MaterialRecord, glow) RECORD(LightRecord) \
    FIELD(LightRecord, x) FIELD(LightRecord, y) FIELD(LightRecord, z) FIELD(LightRecord, w) FIELD(LightRecord, bx) \
    FIELD(LightRecord, by) \
    FIELD(LightRecord, bz) FIELD(LightRecord, cosine) FIELD(LightRecord, beam) FIELD(LightRecord, r) \
    FIELD(LightRecord, g) FIELD(LightRecord, b) \
    RECORD(BvhNode) FIELD(BvhNode, low) FIELD(BvhNode, skip) FIELD(BvhNode, high) FIELD(BvhNode, leaf) RECORD(Frame) \
    FIELD(Frame, eye) FIELD(Frame, u) FIELD(Frame, v) FIELD(Frame, w) FIELD(Frame, center) FIELD(Frame, radius) \
    FIELD(Frame, t_min) FIELD(Frame, tolerance) FIELD(Frame, ambient) FIELD(Frame, background) FIELD(Frame, width) \
    FIELD(Frame, height) FIELD(Frame, perspective) FIELD(Frame, work) FIELD(Frame, first_ray) \
    FIELD(Frame, ray_count) FIELD(Frame, starting_node) FIELD(Frame, unbounded_count) FIELD(Frame, node_count) \
    FIELD(Frame, light_count) FIELD(Frame, every_partition) FIELD(Frame, channels) \
    FIELD(Frame, screen) FIELD(Frame, rows) FIELD(Frame, rank_ends) \
    FIELD(Frame, candidate_capacity) FIELD(Frame, segment_capacity) FIELD(Frame, word_capacity) \
    FIELD(Frame, first_row) FIELD(Frame, first_x) FIELD(Frame, first_y) FIELD(Frame, clip) FIELD(Frame, clip_count) \
    FIELD(Frame, whole_lines) \
    RECORD(DisplayBytes) FIELD(DisplayBytes, ends) FIELD(DisplayBytes, first) \
    RECORD(ScreenBounds) \
    FIELD(ScreenBounds, left) FIELD(ScreenBounds, top) FIELD(ScreenBounds, right) FIELD(ScreenBounds, bottom) \
    RECORD(RayRecord) \
    FIELD(RayRecord, ox) FIELD(RayRecord, oy) FIELD(RayRecord, oz) FIELD(RayRecord, dx) FIELD(RayRecord, dy) \
    FIELD(RayRecord, dz) FIELD(RayRecord, t_near) FIELD(RayRecord, t_far) RECORD(RowBoundaries) \
    FIELD(RowBoundaries, ray) FIELD(RowBoundaries, in_boundary) FIELD(RowBoundaries, out_boundary) \
    RECORD(OverlapRecord) FIELD(OverlapRecord, in) FIELD(OverlapRecord, out) FIELD(OverlapRecord, ray) \
    FIELD(OverlapRecord, node) RECORD(TileNode) \
    FIELD(TileNode, node) FIELD(TileNode, entry) \
    RECORD(BatchReport) FIELD(BatchReport, candidates) FIELD(BatchReport, total) FIELD(BatchReport, tiles) \
    FIELD(BatchReport, listed) \
    FIELD(BatchReport, entries) FIELD(BatchReport, overflows) RECORD(RayCount) FIELD(RayCount, segments) \
    FIELD(RayCount, words) RECORD(CandidateCount) FIELD(CandidateCount, candidates) \
    FIELD(CandidateCount, unused) RECORD(Candidate) \
    FIELD(Candidate, ray) FIELD(Candidate, solid) FIELD(Candidate, count) FIELD(Candidate, before) RECORD(Boundary) \
    FIELD(Boundary, t) FIELD(Boundary, solid) FIELD(Boundary, surface) RECORD(PartitionNode) \
    FIELD(PartitionNode, in_boundary) FIELD(PartitionNode, out_boundary) FIELD(PartitionNode, next) \
    FIELD(PartitionNode, owner) \
    RECORD(DeepRay) FIELD(DeepRay, ray) FIELD(DeepRay, block) FIELD(DeepRay, segment) FIELD(DeepRay, event) \
    FIELD(DeepRay, at) FIELD(DeepRay, changed) FIELD(DeepRay, in_boundary) FIELD(DeepRay, out_boundary) \
    FIELD(DeepRay, open) FIELD(DeepRay, last) FIELD(DeepRay, open_solids) FIELD(DeepRay, partitions) \
    FIELD(DeepRay, sides) RECORD(DeepSegment) FIELD(DeepSegment, first) FIELD(DeepSegment, is_open) \
    FIELD(DeepSegment, covers) \
    RECORD(RayTally) FIELD(RayTally, partitions) FIELD(RayTally, overlaps) RECORD(Pixel) \
    FIELD(Pixel, rgba) FIELD(Pixel, z) FIELD(Pixel, normal) FIELD(Pixel, region) FIELD(Pixel, solid) \
    FIELD(Pixel, depth) FIELD(Pixel, partitions) FIELD(Pixel, overlap) RECORD(ChannelValues) FIELD(ChannelValues, of)
// clang-format on

namespace {

struct Measure {
    std::string what;
    std::size_t host;
};

std::vector<Measure> host_measures() {
#define CSGRT_RECORD(record) {#record, sizeof(kernel::record)},
#define CSGRT_FIELD(record, field) {#record "." #field, offsetof(kernel::record, field)},
    return {CSGRT_LAYOUT(CSGRT_RECORD, CSGRT_FIELD)};
#undef CSGRT_RECORD
#undef CSGRT_FIELD
}

std::string probe_kernel() {
#define CSGRT_RECORD(record) "    out[i++] = (uint)sizeof(" #record ");\n"
#define CSGRT_FIELD(record, field) \
    "    { " #record " r; out[i++] = (uint)((__private char*)&r." #field " - (__private char*)&r); }\n"
    return "\n__kernel void probe(__global uint* out) {\n    uint i = 0;\n" CSGRT_LAYOUT(CSGRT_RECORD,
                                                                                         CSGRT_FIELD) "}\n";
#undef CSGRT_RECORD
#undef CSGRT_FIELD
}

/// "Record" and "Record.field" for every struct in the text of layout.h.
std::set<std::string> names_in_layout() {
    std::string text;
    for (const KernelFile& file : kernel_files()) {
        if (std::string(file.name) == "shared/layout.h") text = file.text;
    }
    text = std::regex_replace(text, std::regex("//[^\n]*"), "");
    std::set<std::string> names;
    const std::regex record("typedef struct \\{([^}]*)\\}\\s*(\\w+);"), statement("\\s*\\w+\\s+([^;]*);"),
        field("(\\w+)(\\[\\w+\\])*");
    for (std::sregex_iterator r(text.begin(), text.end(), record), end; r != end; ++r) {
        names.insert((*r)[2]);
        const std::string body = (*r)[1];
        for (std::sregex_iterator s(body.begin(), body.end(), statement); s != end; ++s) {
            const std::string fields = (*s)[1];
            for (std::sregex_iterator f(fields.begin(), fields.end(), field); f != end; ++f) {
                names.insert((*r)[2].str() + "." + (*f)[1].str());
            }
        }
    }
    return names;
}

}  // namespace

TEST_CASE("the probe looks at every record and field of layout.h", "[device]") {
    std::set<std::string> probed;
    for (const Measure& measure : host_measures()) probed.insert(measure.what);
    CHECK(probed == names_in_layout());
}

TEST_CASE("sizes and offsets of every record are the same on the device", "[device]") {
    const std::vector<Measure> expected = host_measures();
    Device device(test::compiling_device());
    Program program(device, assemble_program({"shared/layout.h"}) + probe_kernel());
    Buffer out(device, "measures", expected.size() * sizeof(cl_uint));
    program.kernel("probe").launch(1, 1, out);
    const std::vector<cl_uint> measured = out.read<cl_uint>(expected.size());
    for (std::size_t i = 0; i < expected.size(); ++i) {
        INFO(expected[i].what);
        CHECK(measured[i] == expected[i].host);
    }
}
