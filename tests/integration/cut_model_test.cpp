// A model that a half-space in the tree cuts: what is left is what rays meet of the whole model on one side of it.
#include <algorithm>
#include <cmath>
#include <map>

#include "catch.hpp"
#include "integration/same_answers.hpp"
#include "stress/build.hpp"

using namespace csgrt;
using namespace csgrt::stress;

namespace {

/// Groups of balls and blocks, less others, in regions of one and of many.
Scene model() {
    Random random(11);
    Scene scene;
    std::vector<Tree> regions;
    const auto part = [&] {
        const std::string name = "s" + std::to_string(scene.objects.size());
        const Vec3 at = 10.0 * random.in_cube();
        if (random.coin())
            scene.objects.push_back(Solid{name, Ell{at, {2, 0, 0}, {0, 1.5, 0}, {0, 0, 1}}, {}});
        else
            scene.objects.push_back(Solid{name, Tgc{at, {0, 1, 2}, {1, 0, 0}, {0, 1, 0}, {1, 0, 0}, {0, 1, 0}}, {}});
        return leaf(name);
    };
    for (int i = 0; i < 40; ++i) {
        std::vector<Tree> parts;
        for (int k = i % 5; k >= 0; --k) parts.push_back(operate(Operator::difference, {part(), part()}));
        Combination region{.name = "r" + std::to_string(i), .region = true};
        region.tree = parts.size() == 1 ? parts[0] : operate(i % 7 == 1 ? Operator::xor_ : Operator::union_, parts);
        scene.objects.push_back(region);
        regions.push_back(leaf(region.name));
    }
    Combination all;
    all.name = "all";
    all.tree = operate(Operator::union_, regions);
    scene.objects.push_back(all);
    return scene;
}

/// How far the rays are in each region, on the side of the plane that is kept, from where they start.
std::map<std::string, double> lengths(Renderer& renderer, const std::vector<Ray>& rays, const Plane& plane,
                                      bool keeps_inside) {
    std::map<std::string, double> result;
    const std::vector<RayPartitions> answers = renderer.shoot(rays);
    for (std::size_t i = 0; i < rays.size(); ++i) {
        const Vec3 &o = rays[i].origin, &d = rays[i].direction, &n = plane.normal;
        const double above = n.x * o.x + n.y * o.y + n.z * o.z - plane.distance,
                     rate = n.x * d.x + n.y * d.y + n.z * d.z;
        const double t = -above / rate;
        for (const Partition& p : answers[i].partitions) {
            const bool before = (rate > 0) == keeps_inside;
            const double in = before ? p.in : std::max(p.in, t), out = before ? std::min(p.out, t) : p.out;
            const std::string& path = renderer.model().regions()[static_cast<std::size_t>(p.region)].path;
            result[path.substr(path.rfind('/'))] += std::max(0.0, out - std::max(in, 0.0));
        }
    }
    return result;
}

}  // namespace

TEST_CASE("a half-space cuts a whole model: the device has the reference's bits, and what is left is right") {
    Scene scene = model();
    Renderer whole(scene, {"all"}, test::on_device());
    const std::vector<Ray> rays = test::random_rays(whole.model().bounds(), 2000);
    for (const Plane& plane : {Plane{{1, 0, 0}, 0.5}, Plane{{0.48, 0.6, 0.64}, -1}, Plane{{0, 0, -1}, 40}}) {
        for (const Operator op : {Operator::intersection, Operator::difference}) {
            Scene cut = scene;
            cut.objects.push_back(Solid{"half", Half{plane}, {}});
            Combination top{.name = "cut", .tree = operate(op, {leaf("all"), leaf("half")})};
            cut.objects.push_back(top);
            Settings settings = test::on_device();
            Renderer device(cut, {"cut"}, settings);
            settings.reference = true;
            settings.device.clear();
            Renderer reference(cut, {"cut"}, settings);
            CHECK(device.model().regions().size() == whole.model().regions().size());
            test::require_same(device.shoot(rays), reference.shoot(rays));
            View view{.width = 64, .height = 64};
            for (const bool every_partition : {true, false}) {
                view.every_partition = every_partition;
                test::require_same(device.render(view), reference.render(view));
            }
            const bool keeps_inside = op == Operator::intersection;
            const Plane anything{plane.normal, keeps_inside ? 1e9 : -1e9};
            const auto found = lengths(device, rays, anything, keeps_inside);
            double left = 0;
            for (const auto& [name, length] : lengths(whole, rays, plane, keeps_inside)) {
                INFO(name);
                CHECK(std::fabs((found.contains(name) ? found.at(name) : 0) - length) < 1e-9 * (1 + length));
                left += length;
            }
            CHECK((left > 0) == !(plane.distance == 40 && !keeps_inside));
        }
    }
}
