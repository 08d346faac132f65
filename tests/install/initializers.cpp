// Designated initializers may leave out any member of a public struct: compiled with -Wextra, which includes
// -Wmissing-field-initializers, and with warnings as errors.
#include <csgrt/csgrt.hpp>

using namespace csgrt;

namespace {

// One member each, so that all others are left out.
[[maybe_unused]] void initialize_each() {
    [[maybe_unused]] const Vec3 vec3{.y = 1};
    [[maybe_unused]] const Box box{.high = {.x = 1}};
    [[maybe_unused]] const Plane plane{.distance = 1};
    [[maybe_unused]] const Place place{.line = 1};
    [[maybe_unused]] const Diagnostic diagnostic{.message = "m"};
    [[maybe_unused]] const Warning warning{.reason = "r"};
    [[maybe_unused]] const Image image{.width = 1};
    [[maybe_unused]] const DeviceInfo device{.type = "gpu"};
    [[maybe_unused]] const Settings settings{.device = "gpu"};
    [[maybe_unused]] const View view{.width = 64, .channels = channel::color};
    [[maybe_unused]] const Camera camera{.perspective = 40};
    [[maybe_unused]] const Ray ray{.direction = {.x = 1}};
    [[maybe_unused]] const Partition partition{.out = 1};
    [[maybe_unused]] const Overlap overlap{.in = 1};
    [[maybe_unused]] const RayPartitions partitions{.overlaps = {}};
    [[maybe_unused]] const RegionInfo region_info{.air = 1};
    [[maybe_unused]] const SolidInfo solid_info{.piece = 1};
    [[maybe_unused]] const ChildInfo child_info{.op = Operator::xor_};
    [[maybe_unused]] const Statistics statistics{.rays = 1};
    [[maybe_unused]] const Light light{.intensity = 0.5};
    [[maybe_unused]] const RegionColor region_color{.high = 1};
    [[maybe_unused]] const Emission emission{.angle = 20};
    [[maybe_unused]] const Finish finish{.shine = 4};
    [[maybe_unused]] const TreeNode node{.object = "o"};
    [[maybe_unused]] const Tree tree{.nodes = {{.op = Operator::not_, .arity = 1}}};
    [[maybe_unused]] const Combination combination{.name = "c", .region = true};
    [[maybe_unused]] const Solid solid{.shape = Ell{.a = {1, 0, 0}, .b = {0, 1, 0}, .c = {0, 0, 1}}};
    [[maybe_unused]] const Scene scene{.ambient = 0.3};
    [[maybe_unused]] const RegionDifference difference{.found = {}};
    [[maybe_unused]] const Verification verification{.rays = 1};
    [[maybe_unused]] const Tgc tgc{.h = {0, 0, 1}};
    [[maybe_unused]] const Arb arb{.vertices = {}};
    [[maybe_unused]] const Arbn arbn{.planes = {{.distance = 1}}};
    [[maybe_unused]] const Half half{.plane = {}};
    [[maybe_unused]] const Tor tor{.r_a = 1};
    [[maybe_unused]] const Ehy ehy{.c = 1};
    [[maybe_unused]] const Part part{.r_v = 1};
    [[maybe_unused]] const Epa epa{.r_1 = 1};
    [[maybe_unused]] const Rpc rpc{.r = 1};
    [[maybe_unused]] const Rhc rhc{.c = 1};
    [[maybe_unused]] const Eto eto{.r_d = 1};
    [[maybe_unused]] const Hyp hyp{.neck = 0.5};
    [[maybe_unused]] const Superell superell{.e = 2};
    [[maybe_unused]] const Hrt hrt{.d = 1};
    [[maybe_unused]] const Metaball metaball{.points = {{.strength = 1}}};
    [[maybe_unused]] const Pipe pipe{.points = {{.outer = 1}}};
    [[maybe_unused]] const Cline cline{.radius = 1};
    [[maybe_unused]] const Bot bot{.mode = Bot::Mode::plate};
    [[maybe_unused]] const Ars ars{.curves = {}};
    [[maybe_unused]] const Nmg nmg{.vertices = {}};
    [[maybe_unused]] const Ebm ebm{.height = 1};
    [[maybe_unused]] const Vol vol{.high = 9};
    [[maybe_unused]] const Dsp dsp{.smooth = true};
    [[maybe_unused]] const Sketch lines{.vertices = {{.u = 1}}, .curves = {Sketch::Line{.end = 1}}};
    [[maybe_unused]] const Sketch arcs{.curves = {Sketch::Arc{.end = 1}}};
    [[maybe_unused]] const Sketch splines{.curves = {Sketch::Bezier{.points = {}}, Sketch::Nurb{.order = 2}}};
    [[maybe_unused]] const Extrude extrude{.h = {0, 0, 1}};
    [[maybe_unused]] const Revolve revolve{.angle = 1};
    [[maybe_unused]] const Unsupported unsupported{.type = "grip"};
}

}  // namespace

bool initializers_keep_defaults() {
    const View view{.width = 64};
    const Settings settings{.air = true};
    return view.height == 1024 && view.every_partition && view.channels == channel::all && view.camera.azimuth == 35 &&
           settings.tolerance == -1 && settings.precision == Precision::double_ && !settings.progress;
}
