// Rays that run in faces and edges of blocks and wedges, whose corners are whole numbers: around such a ray there are
// wedges, and in each of them it is decided exactly which solids are there. A region has the ray where it holds in a
// wedge, evaluated wholly there; so what is empty is never met, and no overlap is made of two wedges.
#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <string>
#include <vector>

#include "catch.hpp"
#include "formats/json/parse_text.hpp"
#include "integration/same_answers.hpp"
#include "integration/stress/check.hpp"
#include "integration/tree_value.hpp"
#include "sanitized.hpp"
#include "stress/build.hpp"

using namespace csgrt;
using namespace csgrt::stress;

namespace {

/// A block, or half of a block on one side of a diagonal.
struct Part {
    Vec3 low, high;
    int across = -1;  ///< 0, 1, 2: the axis along which the diagonal runs; -1: it is whole
    bool below = false;

    bool holds(const Vec3& p) const {
        const double x[] = {p.x, p.y, p.z}, l[] = {low.x, low.y, low.z}, h[] = {high.x, high.y, high.z};
        for (int k = 0; k < 3; ++k)
            if (!(x[k] > l[k] && x[k] < h[k])) return false;
        if (across < 0) return true;
        const int u = (across + 1) % 3, v = (across + 2) % 3;
        return ((x[u] - l[u]) * (h[v] - l[v]) < (x[v] - l[v]) * (h[u] - l[u])) == below;
    }
    Shape shape() const {
        if (across < 0) return box(low, high);
        const int u = (across + 1) % 3, v = (across + 2) % 3;
        const double l[] = {low.x, low.y, low.z}, h[] = {high.x, high.y, high.z};
        double away[] = {0, 0, 0};
        away[u] = h[v] - l[v];
        away[v] = l[u] - h[u];
        const double sign = below ? 1 : -1;
        Arbn arbn;
        const Vec3 axes[] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
        for (int k = 0; k < 3; ++k) {
            arbn.planes.push_back({axes[k], h[k]});
            arbn.planes.push_back({-1.0 * axes[k], -l[k]});
        }
        const Vec3 n = unit(sign * Vec3{away[0], away[1], away[2]});
        arbn.planes.push_back({n, dot(n, low)});
        return arbn;
    }
    /// n and d of n . p = d of each face.
    std::vector<std::array<double, 4>> planes() const {
        std::vector<std::array<double, 4>> all;
        for (const Plane& p : std::holds_alternative<Arbn>(shape()) ? std::get<Arbn>(shape()).planes : block_planes())
            all.push_back({p.normal.x, p.normal.y, p.normal.z, p.distance});
        return all;
    }

private:
    std::vector<Plane> block_planes() const {
        return {{{1, 0, 0}, low.x},  {{1, 0, 0}, high.x}, {{0, 1, 0}, low.y},
                {{0, 1, 0}, high.y}, {{0, 0, 1}, low.z},  {{0, 0, 1}, high.z}};
    }
};

struct Model {
    Scene scene;
    std::vector<Part> parts;
    std::vector<Tree> regions;
    std::set<std::string> used;  ///< names of parts in regions
};

Tree random_tree(Random& random, const std::vector<std::string>& names, int depth) {
    const auto some = [&] { return leaf(names[random.below(static_cast<std::uint32_t>(names.size()))]); };
    if (depth == 0 || random.below(5) == 0) return some();
    const Tree a = random_tree(random, names, depth - 1), b = random_tree(random, names, depth - 1);
    switch (random.below(6)) {
        case 0:
            return operate(Operator::union_, {a, b});
        case 1:
            return operate(Operator::intersection, {a, b});
        case 2:
            return operate(Operator::difference, {a, b});
        case 3:
            return operate(Operator::xor_, {a, b});
        case 4:
            return operate(Operator::difference, {a, operate(Operator::difference, {a, b})});
        default:
            return operate(Operator::difference, {a, operate(Operator::not_, {b})});
    }
}

Model random_model(Random& random) {
    Model model;
    std::vector<std::string> names;
    const int count = random.whole(2, 5);
    const bool has_diagonals = random.coin();
    for (int i = 0; i < count; ++i) {
        double low[3], high[3];
        for (int k = 0; k < 3; ++k) {
            low[k] = random.whole(0, 3);
            high[k] = low[k] + random.whole(1, 2);
        }
        Part part{{low[0], low[1], low[2]}, {high[0], high[1], high[2]}};
        if (has_diagonals && random.coin()) {
            part.across = random.whole(0, 2);
            part.below = random.coin();
        }
        model.parts.push_back(part);
        names.push_back("s" + std::to_string(i));
        model.scene.objects.push_back(Solid{names.back(), part.shape(), {}});
    }
    for (int i = random.whole(1, 3); i > 0; --i) {
        Combination region{.name = "r" + std::to_string(i), .region = true};
        region.tree = random_tree(random, names, random.whole(0, 3));
        model.regions.push_back(region.tree);
        for (const TreeNode& node : region.tree.nodes)
            if (node.op == Operator::leaf) model.used.insert(node.object);
        model.scene.top.push_back(region.name);
        model.scene.objects.push_back(std::move(region));
    }
    return model;
}

/// Along the axes and diagonals, on whole numbers or between them.
Ray random_ray(Random& random) {
    const Vec3 at{0.5 * random.whole(0, 10), 0.5 * random.whole(0, 10), 0.5 * random.whole(0, 10)};
    const Vec3 whole{1.0 * random.whole(0, 5), 1.0 * random.whole(0, 5), 1.0 * random.whole(0, 5)};
    Vec3 d = random.axis();
    if (random.below(3) == 0) d = d + random.axis();
    if (d.x == 0 && d.y == 0 && d.z == 0) d = {1, 0, 0};
    const Vec3 from = random.coin() ? whole : at;
    return {from - 16.0 * d, d};
}

struct Tally {
    std::size_t rays = 0, faces = 0, edges = 0;
};

std::set<std::int32_t> regions_at(const Model& model, const Vec3& p) {
    std::set<std::int32_t> found;
    const auto holds = [&](const std::string& name) { return model.parts[std::stoul(name.substr(1))].holds(p); };
    for (std::size_t r = 0; r < model.regions.size(); ++r)
        if (test::value_of(model.regions[r], holds)) found.insert(static_cast<std::int32_t>(r));
    return found;
}

void judge(const Model& model, const Ray& ray, const RayPartitions& answer, Tally& tally) {
    // Where the ray passes planes; and the planes that it runs in.
    std::set<double> passes;
    std::set<std::array<double, 3>> normals;
    for (const Part& part : model.parts)
        for (const auto& [x, y, z, d] : part.planes()) {
            const Vec3 n{x, y, z};
            const double rate = dot(n, ray.direction), above = dot(n, ray.origin) - d;
            if (std::fabs(rate) > 1e-9) {
                passes.insert(-above / rate);
            } else if (std::fabs(above) < 1e-9) {
                const double sign = x < 0 || (x == 0 && (y < 0 || (y == 0 && z < 0))) ? -1 : 1;
                normals.insert({std::round(64 * sign * x), std::round(64 * sign * y), std::round(64 * sign * z)});
            }
        }
    ++tally.rays;
    tally.faces += normals.size() == 1;
    tally.edges += normals.size() > 1;
    const Vec3 d = unit(ray.direction), above{1, 0.6180339887498949, 0.3472963553338607};
    const Vec3 left = unit(cross(dot(d, above) < 0 ? -1.0 * d : d, above)), up = unit(above - dot(above, d) * d);
    for (auto pass = passes.begin(); pass != passes.end() && std::next(pass) != passes.end(); ++pass) {
        if (*std::next(pass) - *pass < 1e-9) continue;
        const double t = 0.5 * (*pass + *std::next(pass));
        const Vec3 at = ray.origin + t * ray.direction;
        const auto beside = [&](const Vec3& way) { return regions_at(model, at + 1e-3 * way); };
        std::set<std::int32_t> somewhere;
        std::vector<std::set<std::int32_t>> wedges;
        for (int k = 0; k < 64; ++k) {
            const double turn = (k + 0.37) * std::acos(-1) / 32;
            wedges.push_back(beside(std::cos(turn) * up + std::sin(turn) * left));
            somewhere.insert(wedges.back().begin(), wedges.back().end());
        }
        std::int32_t found = -1;
        for (const Partition& p : answer.partitions)
            if (p.in < t && t < p.out) found = static_cast<std::int32_t>(p.region);
        std::set<std::int32_t> overlap;
        for (const Overlap& o : answer.overlaps)
            if (o.in < t && t < o.out) overlap.insert(o.regions.begin(), o.regions.end());

        INFO("at " << t << ", " << normals.size() << " planes: region " << found << " of " << somewhere.size()
                   << " that hold beside it");
        REQUIRE((found < 0 || somewhere.contains(found)));
        if (!overlap.empty()) {
            REQUIRE(*overlap.begin() == found);
            REQUIRE(std::ranges::find(wedges, overlap) != wedges.end());
        }
        std::int32_t first = -1;
        for (const Vec3& side : {up, -1.0 * up, left, -1.0 * left})
            if (const auto here = beside(side); !here.empty() && (first < 0 || *here.begin() < first))
                first = *here.begin();
        std::set<std::string> touched;
        for (int k = 0; k < 64; ++k) {
            const double turn = (k + 0.37) * std::acos(-1) / 32;
            for (const std::string& part : model.used)
                if (model.parts[std::stoul(part.substr(1))].holds(at +
                                                                  1e-3 * (std::cos(turn) * up + std::sin(turn) * left)))
                    touched.insert(part);
        }
        if (touched.size() > 1 || first >= 0) REQUIRE(found == first);
        if (touched.size() == 1) REQUIRE(found == (somewhere.empty() ? -1 : *somewhere.begin()));
        if (normals.size() < 2) REQUIRE(found == (somewhere.empty() ? -1 : *somewhere.begin()));
    }
}

void judge_models(std::uint64_t seed, int models, int rays) {
    Random random(seed);
    Tally tally;
    for (int i = 0; i < models; ++i) {
        const Model model = random_model(random);
        std::vector<Ray> list;
        for (int k = 0; k < rays; ++k) list.push_back(random_ray(random));
        Renderer device(model.scene, {}, test::on_native_device()), reference(model.scene, {}, test::on_reference());
        const std::vector<RayPartitions> answers = device.shoot(list);
        test::require_same(answers, reference.shoot(list));
        for (std::size_t k = 0; k < list.size(); ++k) {
            INFO("model " << i << ", ray " << list[k].origin.x << ' ' << list[k].origin.y << ' ' << list[k].origin.z
                          << "  " << list[k].direction.x << ' ' << list[k].direction.y << ' ' << list[k].direction.z);
            judge(model, list[k], answers[k], tally);
        }
    }
    CHECK(4 * tally.faces > tally.rays / 2);
    CHECK(10 * tally.edges > tally.rays);
}

}  // namespace

TEST_CASE("a region has a ray in a face or an edge where it holds in a wedge around it", "[promise:contact]") {
    judge_models(1, test::tries(200), 40);
}

TEST_CASE("100,000 rays in faces and edges are in regions that hold in a wedge around them", "[.long]") {
    judge_models(2, 2000, 60);
}

TEST_CASE("what two blocks that touch have in common is empty") {
    const char* const tree =
        GENERATE(R"({"intersection": ["a", "b"]})", R"({"difference": ["a", {"difference": ["a", "b"]}]})",
                 R"({"difference": ["a", {"not": "b"}]})");
    const Scene scene = scene_of(R"({"csgrt": 1, "solids": {
        "a": {"type": "box", "low": [0, 0, 0], "high": [4, 4, 4]},
        "b": {"type": "box", "low": [0, 0, 4], "high": [4, 4, 8]}},
        "combinations": {"r": {"region": true, "tree": )" +
                                 std::string(tree) + "}}}");
    Renderer renderer(scene, {"r"}, GENERATE(test::on_device(), Settings{.reference = true}));
    for (const double y : {0.0, 2.0, 4.0})
        for (const double sign : {1.0, -1.0}) {
            INFO("y " << y);
            CHECK(renderer.shoot({{{-5 * sign + 2, y, 4}, {sign, 0, 0}}})[0].partitions.empty());
        }
    Array<std::int32_t> at;
    renderer.region_at(std::vector<Vec3>{{2, 2, 4}}, at);
    CHECK(at[0] == -1);
}
