// Compiling many solids: several threads and batches, the same answer.
#include <cmath>
#include <numbers>
#include <random>
#include <string>
#include <unordered_map>

#include "base/identical.hpp"
#include "catch.hpp"
#include "compile/compiled_scene.hpp"
#include "compile/solids/pack_one.hpp"
#include "sanitized.hpp"
#include "stress/build.hpp"
#include "stress/parts.hpp"

using namespace csgrt;

namespace {

/// What `compiled` has of its solids, made of one solid after the other.
void require_as_one_by_one(const Scene& scene, const CompiledScene& compiled) {
    CompiledScene alone;
    alone.center = compiled.center;
    alone.radius = compiled.radius;
    PlaneTable planes(compiled.center, compiled.radius * std::sqrt(3.0));
    SurfaceTable surfaces(compiled.center, compiled.radius);
    SharedParts shared;
    const FlatScene flat = flatten(scene, {"all"}, false);
    std::unordered_map<std::string, std::size_t> by_name;
    for (std::size_t i = 0; i < compiled.solids.size(); ++i) by_name[compiled.solid_info[i].name] = i;
    for (const Instance& instance : flat.instances) {
        const std::size_t number = by_name.at(name_of(scene.objects[instance.object]));
        test::pack_one(shape_of(scene, flat, instance), *instance.matrix, compiled.solid_boxes[number], alone, planes,
                       surfaces, shared);
    }
    REQUIRE(alone.reals.size() == compiled.reals.size());
    REQUIRE(alone.words.size() == compiled.words.size());
    const std::vector<kernel::PlaneRecord> records = planes.records();
    REQUIRE(records.size() == compiled.planes.size());
    // Numbers and planes lie elsewhere, as the solids are numbered.
    for (std::size_t i = 0; i < flat.instances.size(); ++i) {
        const kernel::SolidRecord& one = alone.solids[i];
        const kernel::SolidRecord& other =
            compiled.solids[by_name.at(name_of(scene.objects[flat.instances[i].object]))];
        REQUIRE(one.plane_count == other.plane_count);
        for (std::uint32_t k = 0; k < one.plane_count; ++k) {
            const kernel::PlaneRef a = alone.words[one.first_plane + k], b = compiled.words[other.first_plane + k];
            REQUIRE((a & 1) == (b & 1));
            REQUIRE(same_bits(records[a >> 1], compiled.planes[b >> 1]));
        }
        const std::size_t end = i + 1 < flat.instances.size() ? alone.solids[i + 1].first_real : alone.reals.size();
        if (end <= one.first_real) continue;  // it has the numbers of an earlier solid
        REQUIRE(std::equal(alone.reals.begin() + one.first_real, alone.reals.begin() + static_cast<std::ptrdiff_t>(end),
                           compiled.reals.begin() + other.first_real));
    }
}

}  // namespace

TEST_CASE("batches of solids give what packing them one by one gives") {
    const Scene scene = stress::scene_of_parts(70'000);  // more than one batch
    const CompiledScene compiled = compile(scene);
    if (test::sanitized) return;  // batches have been seen; each solid alone is by other tests
    CHECK(compile(scene).hash == compiled.hash);
    require_as_one_by_one(scene, compiled);
}

TEST_CASE("planes across an axis are shared as one by one, also with some that are tilted by little") {
    // Pairs of flush blocks of a metre within 10 km, whose tops lie where the cells meet that shards are made of
    // (planes.cpp), or beside. One of a pair is tilted: not at all, by no more than rounding, by so little that its top
    // is the other's still, and by more.
    constexpr double size = 1e7, block = 1e3, cell = std::numbers::sqrt3 * (std::numbers::sqrt3 / 2 * size) / 8192;
    constexpr int pairs = 4000;
    Scene scene;
    std::vector<Tree> members;
    const auto add = [&](const std::string& name, const Vec3& low, const Vec3& high) {
        scene.objects.push_back(Solid{name, stress::box(low, high), {}});
    };
    const auto region = [&](const std::string& name, const std::vector<Tree>& solids) {
        Combination combination{.name = name, .tree = stress::operate(Operator::union_, solids), .region = true};
        members.push_back(stress::leaf(name));
        scene.objects.push_back(std::move(combination));
    };
    add("first", {0, 0, 0}, {1, 1, 1});
    add("last", {size - 1, size - 1, size - 1}, {size, size, size});
    region("corners", {stress::leaf("first"), stress::leaf("last")});
    std::mt19937_64 random(5);
    std::uniform_real_distribution<double> inside(3 * block, size - 3 * block);
    for (int i = 0; i < pairs; ++i) {
        const double x = inside(random), y = inside(random), aside = i % 8 < 4 ? 0 : 1e-5,
                     top = 0.5 * size + (i - pairs / 2 + 0.5) * cell + aside;
        const double tilts[] = {0, 9e-16, 3e-11, 5e-10}, tilt = tilts[i % 4];
        const std::string one = "s" + std::to_string(2 * i), other = "s" + std::to_string(2 * i + 1);
        add(one, {x - block, y, top - block}, {x, y + block, top});
        add(other, {0, 0, -block}, {block, block, 0});
        Matrix m = identity;  // turned about x, then to where it stands
        m[6] = -tilt;
        m[9] = tilt;
        m[3] = x;
        m[7] = y;
        m[11] = top;
        region("pair" + std::to_string(i), {stress::leaf(one), stress::leaf(other, m)});
    }
    Combination all;
    all.name = "all";
    all.tree = stress::operate(Operator::union_, members);
    scene.objects.push_back(std::move(all));
    scene.top = {"all"};
    const CompiledScene compiled = compile(scene);
    CHECK(std::fabs(compiled.radius - std::numbers::sqrt3 / 2 * size) < 1);
    std::size_t tops_shared = 0;
    const auto top_of = [&](std::size_t solid) {
        const kernel::SolidRecord& record = compiled.solids[solid];
        for (std::uint32_t k = 0; k < record.plane_count; ++k) {
            const kernel::PlaneRef ref = compiled.words[record.first_plane + k];
            if ((ref & 1 ? -1 : 1) * compiled.planes[ref >> 1].nz > 0.5) return ref;
        }
        return kernel::PlaneRef{0xffffffff};
    };
    std::unordered_map<std::string, std::size_t> numbers;
    for (std::size_t i = 0; i < compiled.solids.size(); ++i) numbers[compiled.solid_info[i].name] = i;
    for (int i = 0; i < pairs; ++i)
        tops_shared +=
            top_of(numbers.at("s" + std::to_string(2 * i))) == top_of(numbers.at("s" + std::to_string(2 * i + 1)));
    CHECK(tops_shared == pairs * 3 / 4);
    require_as_one_by_one(scene, compiled);
}
