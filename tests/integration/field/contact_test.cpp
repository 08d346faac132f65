// Parts that touch: a ray in the face where they meet is in exactly one of them, from whichever end it comes, and
// nothing overlaps. What is right follows from how the scenes are made: the ray's middle lies within the contact.
#include <cmath>
#include <limits>
#include <set>

#include "integration/field/contact_parts.hpp"
#include "integration/field/judge.hpp"

using namespace csgrt;
using namespace csgrt::test;
using namespace csgrt::stress;

namespace {

/// A ray through a point where two or more parts meet, which lies in the middle of it.
struct Touch {
    Vec3 point, direction;
    std::set<std::uint32_t> parts;  ///< regions, as numbers of objects
    bool crosses;                   ///< from one into another; else along the contact, or touching at the point alone
    double along = 0;               ///< to either side of the middle one part has all of the ray
};

struct Contacts {
    StressScene made;
    std::vector<Touch> touches;
    double reach = std::numeric_limits<double>::infinity();  ///< to either side of the middle nothing may overlap
};

constexpr double back = 100;

/// All kinds of flat faces in contact, each with another: seed % flat_parts tells with which. The one above is turned
/// upside down, or the mirror image of what would lie below.
Contacts flat_contacts(std::uint64_t seed, int rays) {
    Builder to("contact", seed, 1);
    Random& random = to.random();
    Contacts all;
    for (std::size_t kind = 0; kind < flat_parts; ++kind) {
        const Matrix place = place_of(random, kind, seed % 2 == 1);
        const double way = kind % 2 == seed % 2 ? 1 : -1;  // -1: turned about the x axis
        const Matrix upside_down = place * mirror * Matrix{1, 0, 0, 0, 0, way, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
        const Tree below = flat_part(to, kind, place), above = flat_part(to, (kind + seed) % flat_parts, upside_down);
        const bool first = random.coin();
        to.region(first ? below : above);
        to.region(first ? above : below);
        for (int i = 0; i < rays; ++i) {
            const Vec3 point = moved_point(place, {random.between(-1, 1), random.between(-1, 1), 0});
            const bool crosses = i % 4 == 0;
            const double turn = i % 4 == 1 ? 0.5 * random.whole(0, 3) * pi : 7 * random.unit();
            const Vec3 local = crosses ? random.slanted() : Vec3{std::cos(turn), std::sin(turn), 0};
            const auto part = static_cast<std::uint32_t>(2 * kind);
            all.touches.push_back({point, moved_direction(place, local), {part, part + 1}, crosses, crosses ? 0 : 0.5});
        }
    }
    all.made = to.take();
    return all;
}

/// Plates that meet their mirror images, other plates, or stand on a block.
Contacts plate_contacts(std::uint64_t seed, int rays) {
    Builder to("plates", seed, 1);
    Random& random = to.random();
    Contacts all;
    all.reach = 20;  // blocks of plates overlap above and below the line where they meet; rays go on to other pairs
    for (std::size_t number = 0; number < 9; ++number) {
        const Matrix place = place_of(random, number, seed % 2 == 1);
        const Matrix upside_down = place * mirror;
        const std::size_t kind = number % 3;
        const Bot below = plates(kind, random), other = plates(kind, random);
        const Tree under = leaf(to.solid(below), place);
        const Tree over = number < 3   ? leaf(to.solid(below), upside_down)
                          : number < 6 ? leaf(to.solid(other), upside_down)
                                       : leaf(to.solid(box({-5, -5, 0}, {5, 5, 4})), place);
        const bool first = random.coin();
        to.region(first ? under : over);
        to.region(first ? over : under);
        for (int i = 0; i < rays; ++i) {
            const Vec3 at{random.between(-2.5, 2.5), kind == 2 ? -3.0 : 0.0, 0};
            const double turn = random.between(0.25, 0.75) * pi;
            const auto part = static_cast<std::uint32_t>(2 * number);
            all.touches.push_back({moved_point(place, at),
                                   moved_direction(place, {std::cos(turn), std::sin(turn), 0}),
                                   {part, part + 1},
                                   false,
                                   0.5});
        }
    }
    all.made = to.take();
    return all;
}

/// Three cells around an edge, each with a place of its own as a program computes it: hexagons, rhombs and wedges.
Contacts edge_contacts(std::uint64_t seed, int rays) {
    Builder to("cells", seed, 1);
    Random& random = to.random();
    Contacts all;
    const double third = 2 * pi / 3;
    for (std::size_t number = 0; number < 15; ++number) {
        const Matrix place = place_of(random, number, seed % 2 == 1);
        const double turn = random.unit(), size = random.between(0.5, 3);
        const Vec3 edge = random.in_cube();
        std::set<std::uint32_t> parts;
        for (int k = 0; k < 3; ++k) {
            const double middle = turn + k * third;
            const Vec3 center = edge + Vec3{size * std::cos(middle), size * std::sin(middle), 0};
            const double apothem = 0.5 * std::sqrt(3.0) * size;
            std::string cell;
            if (number % 5 == 0) {  // hexagons by their planes
                Arbn arbn;
                for (int i = 0; i < 6; ++i) {
                    const double a = middle + (i + 0.5) * third / 2;
                    arbn.planes.push_back({{std::cos(a), std::sin(a), 0}, apothem});
                }
                arbn.planes.push_back({{0, 0, 1}, 2});
                arbn.planes.push_back({{0, 0, -1}, 2});
                cell = to.solid(arbn);
            } else if (number % 5 == 1 || number % 5 == 2) {  // by their outlines, and by triangles
                std::vector<Sketch::Point> points;
                for (int i = 0; i < 6; ++i)
                    points.push_back(
                        {size * std::cos(middle + i * third / 2), size * std::sin(middle + i * third / 2)});
                cell = number % 5 == 1 ? to.solid(Extrude{{0, 0, -2}, {0, 0, 4}, {1, 0, 0}, {0, 1, 0}, polygon(points)})
                                       : to.solid(prism(points));
            } else if (number % 5 == 3) {  // wedges, turned about the edge
                const Vec3 begin{std::cos(middle + pi - third / 2), std::sin(middle + pi - third / 2), 0};
                const Vec3 start = edge - center;
                cell = to.solid(Revolve{
                    {start.x, start.y, -2}, {0, 0, 1}, begin, third, polygon({{0, 0}, {size, 0}, {size, 4}, {0, 4}})});
            } else {  // rhombs by their corners
                const Vec3 u{size * std::cos(middle - third / 2), size * std::sin(middle - third / 2), 0};
                const Vec3 v{size * std::cos(middle + third / 2), size * std::sin(middle + third / 2), 0};
                const Vec3 start = edge - center;
                Arb arb;
                const Vec3 corners[4] = {start, start + u, start + u + v, start + v};
                for (std::size_t i = 0; i < 4; ++i) {
                    arb.vertices[i] = corners[i] - Vec3{0, 0, 2};
                    arb.vertices[i + 4] = corners[i] + Vec3{0, 0, 2};
                }
                cell = to.solid(arb);
            }
            parts.insert(static_cast<std::uint32_t>(3 * number + static_cast<std::size_t>(k)));
            to.region(leaf(cell, place * translation(center)));
        }
        for (int i = 0; i < rays; ++i) {
            const Vec3 point = moved_point(place, edge + Vec3{0, 0, random.between(-1, 1)});
            all.touches.push_back({point, moved_direction(place, {0, 0, 1}), parts, false, 0.5});
        }
    }
    all.made = to.take();
    return all;
}

/// Curved faces: what fills a hole, along its wall and across it; and what only touches, at a point or along a line.
Contacts curved_contacts(std::uint64_t seed, int rays) {
    Builder to("curved contact", seed, 1);
    Random& random = to.random();
    Contacts all;
    for (std::size_t kind = 0; kind < 10; ++kind) {
        const Matrix place = place_of(random, kind, seed % 2 == 1);
        const double r = random.between(0.5, 2), size = random.between(3, 4), taper = 0.25;
        const auto solid = [&](Shape shape) { return leaf(to.solid(std::move(shape)), place); };
        const auto fills = [&](const Shape& shape) {
            to.region(
                operate(Operator::difference, {solid(box({-size, -size, -size}, {size, size, size})), solid(shape)}));
            to.region(solid(shape));
        };
        const auto touch = [&](const Vec3& at, const Vec3& d, bool crosses, double along) {
            const auto part = static_cast<std::uint32_t>(2 * kind);
            all.touches.push_back(
                {moved_point(place, at), moved_direction(place, d), {part, part + 1}, crosses, along});
        };
        const auto around = [&] {
            const double a = 7 * random.unit();
            return Vec3{std::cos(a), std::sin(a), 0};
        };
        const Vec3 up{0, 0, 1};
        switch (kind) {
            case 0:
                fills(cylinder({0, 0, -size}, 2 * size * up, r));
                break;
            case 1:
                fills(cone({0, 0, -size}, 2 * size * up, 0.5 * r + 1 + taper * size, 0.5 * r + 1 - taper * size));
                break;
            case 2:
                fills(ball({}, r));
                break;
            case 3:
                fills(Tor{{}, up, 2, 0.3 * r});
                break;
            case 4:  // a ball on a plate
                to.region(solid(box({-size, -size, -2}, {size, size, 0})));
                to.region(solid(ball({0, 0, r}, r)));
                break;
            case 5:  // a rod on a plate
                to.region(solid(box({-size, -size, -2}, {size, size, 0})));
                to.region(solid(cylinder({-2, 0, r}, {4, 0, 0}, r)));
                break;
            case 6:  // two rods
                to.region(solid(cylinder({-2, 0, r}, {4, 0, 0}, r)));
                to.region(solid(cylinder({-2, 0, -0.5}, {4, 0, 0}, 0.5)));
                break;
            case 7:  // a ring on a plate
                to.region(solid(box({-size, -size, -2}, {size, size, 0})));
                to.region(solid(Tor{{0, 0, 0.5 * r}, up, 1.5, 0.5 * r}));
                break;
            case 8:  // two balls
                to.region(solid(ball({0, 0, r}, r)));
                to.region(solid(ball({0, 0, -0.5}, 0.5)));
                break;
            default:  // a cone that lies on a plate
                to.region(solid(box({-size, -size, -2}, {size, size, 0})));
                to.region(solid(
                    Tgc{{1, 0, 0.5}, {-1.5, 0, -0.25}, {0.25, 0, 0.5}, {0, 0.5, 0}, {0.125, 0, 0.25}, {0, 0.25, 0}}));
                break;
        }
        for (int i = 0; i < rays; ++i) {
            const Vec3 n = around(), across{-n.y, n.x, 0};
            const bool crosses = i % 3 == 0;
            const Vec3 wall = (i % 3 == 1 ? up : across + random.between(-2, 2) * up);
            const double height = random.between(-1, 1);
            if (kind == 0) touch(r * n + height * up, crosses ? random.slanted() : wall, crosses, i % 3 == 1 ? 0.5 : 0);
            if (kind == 2) {
                const Vec3 out = random.direction();
                touch(r * out, crosses ? out + 0.5 * random.in_cube() : unit(cross(out, random.slanted())), crosses, 0);
            }
            if (kind == 3) touch(2 * n + 0.3 * r * up, crosses ? up + 0.5 * n : i % 3 == 1 ? n : across, crosses, 0);
            if (kind == 1 && crosses)
                touch((0.5 * r + 1 - taper * height) * n + height * up, n + 0.3 * across, true, 0);
            if (kind == 1 && i % 3 == 1)
                touch((0.5 * r + 1 - taper * height) * n + height * up, up - taper * n, false, 0.5);
            if (kind == 4 || kind == 8) touch({}, n, false, 0);
            if (kind == 5 || kind == 6)
                touch({height, 0, 0}, i % 2 == 0 ? Vec3{1, 0, 0} : n, false, i % 2 == 0 ? 0.5 : 0);
            if (kind == 7) touch(1.5 * n, i % 2 == 0 ? n : around(), false, 0);
        }
    }
    all.made = to.take();
    return all;
}

/// Lone blocks of several types, touched along their faces and edges: the ray is in them, as BRL-CAD says.
Contacts lone(std::uint64_t seed, int rays) {
    Builder to("lone", seed, 1);
    Random& random = to.random();
    Contacts all;
    for (std::uint32_t number = 0; number < 12; ++number) {
        const Matrix place = place_of(random, number, seed % 2 == 1);
        const Vec3 size{random.between(1, 4), random.between(1, 4), random.between(1, 4)};
        Bot triangles = block_of_triangles({});
        for (Vec3& v : triangles.vertices) v = {size.x * v.x / 3, size.y * v.y / 3, size.z * (v.z / 2 + 1)};
        Ebm cell;
        cell.width = cell.depth = 1;
        cell.height = 2 * size.z;
        cell.cells = {1};
        cell.matrix = translation(-1 * size) * Matrix{2 * size.x, 0, 0, 0, 0, 2 * size.y, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
        const std::vector<Sketch::Point> points = {
            {-size.x, -size.y}, {size.x, -size.y}, {size.x, size.y}, {0, 0.5 * size.y}, {-size.x, size.y}};
        const Shape shapes[] = {box(-1 * size, size), triangles, cell,
                                Extrude{{0, 0, -size.z}, {0, 0, 2 * size.z}, {1, 0, 0}, {0, 1, 0}, polygon(points)}};
        to.region(leaf(to.solid(shapes[number % 4]), place));
        for (int i = 0; i < rays; ++i) {
            const double x = random.sign() * size.x, y = random.sign() * size.y;
            const Vec3 in_face{x, random.between(-0.4, 0.4), random.between(-0.4, 0.4)},
                on_edge{x, y, random.between(-0.4, 0.4)};
            const double a = 7 * random.unit();
            all.touches.push_back({moved_point(place, i % 2 ? in_face : on_edge),
                                   moved_direction(place, i % 2 ? Vec3{0, std::cos(a), std::sin(a)} : Vec3{0, 0, 1}),
                                   {number},
                                   false,
                                   0.5});
        }
    }
    all.made = to.take();
    return all;
}

/// The partition of a ray that holds all from t - along to t + along; -1: there is none, -2: more than one.
int owner_at(const RayPartitions& answer, double t, double along) {
    int owner = -1;
    for (const Partition& p : answer.partitions)
        if (p.in <= t - along && p.out >= t + along && p.out > t && p.in < t)
            owner = owner == -1 ? static_cast<int>(p.region) : -2;
    return owner;
}

struct ContactTally {
    std::size_t rays = 0, overlaps = 0, none = 0, strange = 0, ends_differ = 0;
    std::string first;
};

void check_contacts(Contacts contacts, ContactTally& tally) {
    StressScene& made = contacts.made;
    for (const Touch& touch : contacts.touches)
        for (const double way : {1.0, -1.0})
            made.rays.push_back({touch.point - back * way * touch.direction, way * touch.direction});
    Renderer reference(made.scene, made.objects, on_reference());
    Renderer device(made.scene, made.objects, on_device());
    std::vector<RayPartitions> found = reference.shoot(made.rays);
    {
        INFO("seed " << made.seed);
        require_same(device.shoot(made.rays), found);
    }
    const Renumbering renumbering(reference, made.objects);
    for (std::size_t i = 0; i < contacts.touches.size(); ++i) {
        const Touch& touch = contacts.touches[i];
        int owners[2] = {-1, -1};
        bool good = true;
        const auto count = [&](std::size_t& kind) {
            ++kind;
            good = false;
        };
        for (std::size_t way = 0; way < 2; ++way) {
            RayPartitions& answer = found[2 * i + way];
            renumbering.apply(answer);
            ++tally.rays;
            for (const Overlap& overlap : answer.overlaps)
                if (overlap.in < back + contacts.reach && overlap.out > back - contacts.reach) count(tally.overlaps);
            if (touch.crosses) {
                // One part ends where the other begins, to the last bit.
                bool meets = false;
                for (std::size_t k = 1; k < answer.partitions.size(); ++k) {
                    const Partition &p = answer.partitions[k - 1], &q = answer.partitions[k];
                    if (std::abs(p.out - back) < 1e-6 && p.out == q.in && touch.parts.count(p.region) &&
                        touch.parts.count(q.region) && p.region != q.region)
                        meets = true;
                }
                if (!meets) count(tally.none);
            } else if (touch.along > 0) {
                owners[way] = owner_at(answer, back, touch.along);
                if (owners[way] == -1) count(tally.none);
                if (owners[way] == -2 ||
                    (owners[way] >= 0 && !touch.parts.count(static_cast<std::uint32_t>(owners[way]))))
                    count(tally.strange);
            }
        }
        if (owners[0] != owners[1]) count(tally.ends_differ);
        if (!good && tally.first.empty()) {
            keep_finding("contact", made, made.scene, made.rays[2 * i]);
            tally.first = made.family + " " + std::to_string(made.seed) + ", ray " + std::to_string(i) + ": " +
                          oracle::describe(made.rays[2 * i]);
        }
    }
}

/// Blocks less a turned ring, and less two rings that are one all round. Rays run in the plane of an end face, across
/// the axis: at places along them, is the block there?
void require_turns(std::uint64_t seeds, int rays) {
    struct Place {
        std::size_t ray;
        double t;
        bool block;
    };
    std::size_t wrong = 0, overlaps = 0;
    for (std::uint64_t seed = 0; seed < seeds; ++seed) {
        Builder to("turns", seed, 1);
        Random& random = to.random();
        std::vector<Place> places;
        std::size_t ray_count = 0;
        for (std::size_t number = 0; number < 8; ++number) {
            const Matrix place = place_of(random, number, seed % 2 == 1);
            const double angle = number == 0 ? pi : random.between(0.2, 2 * pi - 0.2), begin = 7 * random.unit();
            const bool whole = number % 2 == 1, beyond_half = angle > pi;
            const auto ring = [&](double from, double turn) {
                return leaf(to.solid(Revolve{{0, 0, -2},
                                             {0, 0, 1},
                                             {std::cos(from), std::sin(from), 0},
                                             turn,
                                             polygon({{1, 0}, {3, 0}, {3, 4}, {1, 4}})}),
                            place);
            };
            std::vector<Tree> parts = {leaf(to.solid(box({-4, -4, -3}, {4, 4, 3})), place), ring(begin, angle)};
            if (whole) parts.push_back(ring(begin + angle, 2 * pi - angle));
            to.region(operate(Operator::difference, parts));
            for (int i = 0; i < rays; ++i) {
                const double face = i % 2 ? begin + angle : begin, rise = i % 4 < 2 ? 0 : random.between(-0.3, 0.3);
                const Vec3 d{std::cos(face), std::sin(face), rise}, middle{0, 0, random.between(-0.5, 0.5)};
                for (const double way : {1.0, -1.0}) {
                    for (const double s : {-3.5, -2.0, -0.5, 0.5, 2.0, 3.5}) {
                        const bool in_ring = std::abs(s) > 1 && std::abs(s) < 3;
                        const bool covered = in_ring && (whole || (s < 0 && beyond_half));
                        places.push_back({ray_count, back + way * s, !covered});
                    }
                    to.ray(moved_point(place, middle + (-back * way) * d), moved_direction(place, way * d));
                    ++ray_count;
                }
            }
        }
        const StressScene made = to.take();
        Renderer reference(made.scene, made.objects, on_reference()), device(made.scene, made.objects, on_device());
        const std::vector<RayPartitions> found = reference.shoot(made.rays);
        require_same(device.shoot(made.rays), found);
        for (const Place& at : places) wrong += (owner_at(found[at.ray], at.t, 0.25) != -1) != at.block;
        for (const RayPartitions& answer : found) overlaps += !answer.overlaps.empty();
    }
    CHECK(wrong == 0);
    CHECK(overlaps == 0);
}

void require_contact(Contacts (*make)(std::uint64_t, int), std::uint64_t seeds, int rays) {
    ContactTally tally;
    for (std::uint64_t seed = 0; seed < seeds; ++seed) check_contacts(make(seed, rays), tally);
    INFO(tally.rays << " rays, first bad: " << tally.first);
    CHECK(tally.rays >= 24);
    CHECK(tally.overlaps == 0);
    CHECK(tally.none == 0);
    CHECK(tally.strange == 0);
    CHECK(tally.ends_differ == 0);
}

}  // namespace

TEST_CASE("flat faces in contact: a ray in them is in exactly one part", "[field][promise:contact]") {
    require_contact(flat_contacts, flat_parts, 8);
}
TEST_CASE("plates that end where others begin: a ray through the line between them is in exactly one",
          "[field][promise:contact]") {
    require_contact(plate_contacts, 6, 16);
}
TEST_CASE("three cells around an edge: a ray along it is in exactly one", "[field][promise:contact]") {
    require_contact(edge_contacts, 6, 8);
}
TEST_CASE("curved faces in contact: nothing overlaps", "[field][promise:contact]") {
    require_contact(curved_contacts, 4, 12);
}
TEST_CASE("a ray that touches a lone block along a face or an edge is in it", "[field][promise:contact]") {
    require_contact(lone, 4, 8);
}
TEST_CASE("pictures of a part and its mirror image, straight on: no background between them",
          "[field][promise:contact]") {
    for (std::size_t kind = 0; kind < flat_parts; ++kind) {
        Builder to("mirrored", kind, 1);
        to.region(flat_part(to, kind, identity));
        to.region(flat_part(to, kind, mirror));
        const StressScene made = to.take();
        Renderer renderer(made.scene, made.objects, on_device());
        for (const double azimuth : {0.0, 90.0, 180.0, 270.0}) {
            View view{.width = 65, .height = 65};
            view.camera.azimuth = azimuth;
            view.camera.elevation = 0;
            const Image image = renderer.render(view);
            INFO("kind " << kind << ", azimuth " << azimuth);
            const auto regions = image.ids("region");
            const auto overlaps = image.channel("overlap");
            CHECK(std::all_of(overlaps.begin(), overlaps.end(), [](float n) { return n == 0; }));
            for (std::size_t x = 30; x <= 34; ++x) CHECK(regions[32 * 65 + x] != 0);
        }
    }
}

TEST_CASE("end faces of turns: across the axis a ray in their plane is within the solid, or outside",
          "[field][promise:contact]") {
    require_turns(12, 12);
}

TEST_CASE("a thousand rays through each contact", "[.long]") {
    require_turns(60, 1000);
    require_contact(flat_contacts, 2 * flat_parts, 1000);
    require_contact(plate_contacts, 12, 1000);
    require_contact(edge_contacts, 20, 1000);
    require_contact(curved_contacts, 20, 1000);
    require_contact(lone, 20, 500);
}
