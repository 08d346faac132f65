// What the documents promise of every ray's answer and of every picture, for a solid of every type: under each operator
// with a second placement of itself, and overlapping it, with the ray's start anywhere. The reference's answers are
// looked at, and the device has their bits: ctest runs these tests with PoCL, too.
#include "catch.hpp"

#include <limits>
#include <map>

#include <csgrt/verify.hpp>

#include "compile/compiled_scene.hpp"
#include "integration/every_solid.hpp"

using namespace csgrt;
using namespace csgrt::every_solid;

TEST_CASE("the samples have every type of solid") {
    CHECK(compile(test::scene_of_samples()).solid_types == (1u << SOLID_TYPES) - 1);
}

TEST_CASE("every solid: regions are what the operators make of the solids' segments",
          "[promise:booleans][promise:overlap]") {
    const EverySolid model(6);
    Both both(model.scene);
    const std::vector<RayPartitions> found = both.shoot(model.rays);
    Renderer firsts(model.scene, model.all(&Spot::first), on_reference());
    Renderer seconds(model.scene, model.all(&Spot::second), on_reference());
    const auto a = firsts.shoot(model.rays), b = seconds.shoot(model.rays);
    std::map<std::string, std::size_t> compared;  // stretches, by place
    Faults faults;
    for (std::size_t i = 0; i < found.size(); ++i) {
        std::vector<double> boundaries = boundaries_of(a[i]);
        const std::vector<double> others = boundaries_of(b[i]);
        boundaries.insert(boundaries.end(), others.begin(), others.end());
        std::sort(boundaries.begin(), boundaries.end());
        if (has_close_boundaries(boundaries, 1e-8)) continue;  // they may be one
        // Of each place: what its region has, or its two regions.
        std::map<std::string, Stretches> of_first, of_second, regions;
        for (const Partition& p : a[i].partitions)
            of_first[firsts.model().regions()[p.region].path.substr(7)].push_back({p.in, p.out});
        for (const Partition& p : b[i].partitions)
            of_second[seconds.model().regions()[p.region].path.substr(8)].push_back({p.in, p.out});
        for (const Partition& p : found[i].partitions) regions[both.region(p.region)].push_back({p.in, p.out});
        for (const Spot& place : model.places) {
            const std::string name = place.first.substr(6);
            const Stretches &x = of_first[name], &y = of_second[name];
            const auto check = [&](const Stretches& seen, const Stretches& expected, const char* what) {
                const bool same = std::equal(seen.begin(), seen.end(), expected.begin(), expected.end(),
                                             [](auto& p, auto& q) { return p.in == q.in && p.out == q.out; });
                compared[name] += expected.size();
                if (!same) faults.add(what, name + ", ray " + std::to_string(i));
            };
            if (place.way->holds) {
                check(regions[place.region], where(x, y, place.way->holds), "the region");
                continue;
            }
            check(regions[place.first], x, "the first of two regions");
            check(regions[place.second], where(x, y, [](bool p, bool q) { return !p && q; }), "the second");
            Stretches overlaps;
            for (const Overlap& o : found[i].overlaps)
                if (both.region(o.regions.front()) == place.first) overlaps.push_back({o.in, o.out});
            check(overlaps, where(x, y, [](bool p, bool q) { return p && q; }), "the overlaps");
        }
    }
    REQUIRE_NONE(faults);
    for (const Spot& place : model.places) {
        CAPTURE(place.first);
        CHECK(compared[place.first.substr(6)] > 0);
    }
}

TEST_CASE(
    "every solid: partitions are in order and disjoint, with normals outward, whole where they hold the start, "
    "left out where they end before it",
    "[promise:partitions][promise:overlap]") {
    const EverySolid model(4);
    Both both(model.scene);
    const std::vector<RayPartitions> base = both.shoot(model.rays);
    Faults faults;
    std::vector<Ray> moved;
    std::vector<RayPartitions> expected;
    std::map<std::string, std::size_t> held, behind;  // by sample
    for (std::size_t i = 0; i < base.size(); ++i) {
        const Ray& ray = model.rays[i];
        faults.add(fault_of(base[i], ray, both), "ray " + std::to_string(i));
        const std::vector<double> boundaries = boundaries_of(base[i]);
        if (has_close_boundaries(boundaries, clear)) continue;
        // Between every two boundaries, and beyond the last.
        for (std::size_t k = 0; k < boundaries.size(); ++k) {
            const double next = k + 1 < boundaries.size() ? boundaries[k + 1] : boundaries[k] + 10;
            const double start = std::isinf(boundaries[k]) ? next - 20
                                 : std::isinf(next)        ? boundaries[k] + 20
                                                           : 0.5 * (boundaries[k] + next);
            if (!(start > 0) || boundaries[k] == next) continue;
            RayPartitions rest;
            for (const Partition& p : base[i].partitions) {
                const std::string sample = sample_of(both.region(p.region));
                behind[sample] += p.out < start;
                if (p.out < start) continue;
                held[sample] += p.in < start;
                rest.partitions.push_back(shifted(p, start));
            }
            for (const Overlap& o : base[i].overlaps)
                if (o.out >= start) rest.overlaps.push_back(shifted(o, start));
            moved.push_back({ray.origin + start * ray.direction, ray.direction});
            expected.push_back(std::move(rest));
        }
    }
    const std::vector<RayPartitions> found = both.shoot(moved);
    for (std::size_t i = 0; i < found.size(); ++i) {
        faults.add(fault_of(found[i], moved[i], both), "moved ray " + std::to_string(i));
        faults.add(difference_of(found[i], expected[i]), "moved ray " + std::to_string(i) + " " + said(moved[i]));
    }
    REQUIRE_NONE(faults);
    for (const test::Sample& sample : tested) {
        CAPTURE(sample.name);
        CHECK(held[sample.name] > 0);
        CHECK(behind[sample.name] > 0);
    }
    CHECK(held["floor"] > 0);
}

TEST_CASE("every solid: verify finds nothing wrong where a ray starts on a surface and leaves") {
    Scene scene = test::scene_of_samples();
    Random random(17);
    std::vector<Ray> rays;
    for (const test::Sample& sample : tested) {
        const std::string bounded = add_bounded(scene, sample.name);
        const Vec3 at = grid(scene.top.size());
        scene.top.push_back(std::to_string(scene.top.size()) + " " + sample.name);
        add_combination(scene, scene.top.back(), leaf(bounded, translation(at)), true);
        for (int i = 0; i < 60; ++i) {
            const Vec3 d = unit({0.015 * i, -0.01 * i, 1});
            rays.push_back({at + 1.5 * random.in_cube() - 4 * d, d});
        }
    }
    const std::vector<RayPartitions> met = Renderer(scene, {}, on_reference()).shoot(rays);
    Verifier verifier(scene, {}, on_reference());  // the device has its bits
    std::vector<Ray> starting;
    std::map<std::string, std::size_t> started;
    for (std::size_t i = 0; i < rays.size(); ++i)
        for (const Partition& p : met[i].partitions) {
            if (++started[sample_of(verifier.renderer().model().regions()[p.region].path)] > 12) continue;
            // All around it rays end before their start, if they end where it does: its own end is rounding's.
            starting.push_back({rays[i].origin + p.out * rays[i].direction, p.out_normal});
        }
    verifier.shoot(starting);
    const Verification& result = verifier.result();
    Faults faults;
    for (const WrongRay& wrong : result.wrong_rays) faults.add("wrong", said(wrong.ray));
    REQUIRE_NONE(faults);
    CHECK(result.decided > result.rays * 9 / 10);
    for (const test::Sample& sample : tested) {
        CAPTURE(sample.name);
        CHECK(started[sample.name] > 0);
    }
}

TEST_CASE("every solid: a ray has the same regions and overlaps from its other end",
          "[promise:partitions][promise:overlap]") {
    const EverySolid model(4);
    Both both(model.scene);
    const std::vector<RayPartitions> base = both.shoot(model.rays);
    std::vector<Ray> turned;
    std::vector<double> lengths;
    for (const Ray& ray : model.rays) {
        lengths.push_back(2 * away / std::sqrt(dot(ray.direction, ray.direction)));
        turned.push_back({ray.origin + lengths.back() * ray.direction, -1.0 * ray.direction});
    }
    const std::vector<RayPartitions> found = both.shoot(turned);
    Faults faults;
    std::size_t overlaps = 0;
    for (std::size_t i = 0; i < found.size(); ++i) {
        if (has_close_boundaries(boundaries_of(base[i]), clear) || has_close_boundaries(boundaries_of(found[i]), clear))
            continue;
        RayPartitions mirrored;
        const auto ahead = [&](const auto& stretch) { return stretch.in <= lengths[i]; };  // of the other start
        for (auto p = found[i].partitions.rbegin(); p != found[i].partitions.rend(); ++p) {
            if (!ahead(*p)) continue;
            Partition q = *p;
            q.in = lengths[i] - p->out, q.out = lengths[i] - p->in;
            std::swap(q.in_normal, q.out_normal);
            mirrored.partitions.push_back(q);
        }
        for (auto o = found[i].overlaps.rbegin(); o != found[i].overlaps.rend(); ++o)
            if (ahead(*o)) mirrored.overlaps.push_back({lengths[i] - o->out, lengths[i] - o->in, o->regions});
        RayPartitions before;  // what the turned ray leaves out
        for (const Partition& p : base[i].partitions)
            if (p.in <= lengths[i]) before.partitions.push_back(p);
        before.overlaps = base[i].overlaps;
        overlaps += before.overlaps.size();
        faults.add(difference_of(mirrored, before), "ray " + std::to_string(i));
    }
    REQUIRE_NONE(faults);
    CHECK(overlaps > 100);
}

TEST_CASE("every solid: distances count lengths of the direction, to the bit where these are powers of two",
          "[promise:partitions]") {
    const EverySolid model(2);
    Both both(model.scene);
    const std::vector<RayPartitions> base = both.shoot(model.rays);
    for (const int exponent : {700, -700, 40, -3}) {
        INFO("2^" << exponent);
        std::vector<Ray> rays = model.rays;
        for (Ray& ray : rays) ray.direction = std::ldexp(1.0, exponent) * ray.direction;
        std::vector<RayPartitions> found = both.shoot(rays);
        for (RayPartitions& answer : found) {
            for (Partition& p : answer.partitions)
                p.in = std::ldexp(p.in, exponent), p.out = std::ldexp(p.out, exponent);
            for (Overlap& o : answer.overlaps) o.in = std::ldexp(o.in, exponent), o.out = std::ldexp(o.out, exponent);
        }
        test::require_same(found, base);
    }
}

TEST_CASE("every solid: a picture shows the first partition of each of its rays, and counts what the rays meet",
          "[promise:pictures]") {
    EverySolid model(0);
    Both both(model.scene);
    View view{.width = 101, .height = 100};
    view.camera.view_size = 110;
    view.camera.center = Vec3{0, 0, 0};
    std::map<std::string, std::size_t> shown;  // pixels, by sample
    std::size_t within = 0;
    for (const int which : {0, 1, 2, 3}) {
        INFO("view " << which);
        view.camera.azimuth = 20 + 50 * which;
        view.camera.elevation = 62;
        if (which == 1) view.camera.perspective = 40;
        if (which == 2) {  // from within the box of "union box"
            view.camera.perspective = 60;
            view.camera.view_size.reset();
            view.camera.eye = std::find_if(model.places.begin(), model.places.end(), [](const Spot& place) {
                                  return place.region == "union box";
                              })->at;
            view.camera.center = Vec3{3, 5, 1};
        }
        if (which == 3) view.camera.eye = Vec3{0, 0, -150};  // in the half-space
        view.every_partition = true;
        const Image image = both.render(view);
        const std::uint64_t counted = both.device().statistics().overlaps;
        const std::vector<Ray> rays = both.reference().model().grid_of(view).rays();
        const std::vector<RayPartitions> answers = both.shoot(rays);
        Faults faults;
        const auto at = [&](const char* name, std::size_t i) { return image.channel(name)[i]; };
        std::uint64_t overlaps = 0;
        for (std::size_t i = 0; i < rays.size(); ++i) {
            const RayPartitions& answer = answers[i];
            const std::string where = std::to_string(i % 101) + ", " + std::to_string(i / 101);
            // A partition that ends at the very start is listed, but not seen.
            const auto first = std::find_if(answer.partitions.begin(), answer.partitions.end(),
                                            [](const Partition& p) { return p.out > 0; });
            overlaps += static_cast<std::uint64_t>(at("overlap", i));
            if ((at("overlap", i) > 0) < !answer.overlaps.empty()) faults.add("overlaps that are not counted", where);
            if (at("partitions", i) < static_cast<float>(answer.partitions.size()))
                faults.add("partitions that are not counted", where);
            if ((at("depth", i) == 0) != (at("partitions", i) == 0)) faults.add("segments and no partitions", where);
            if (first == answer.partitions.end()) {
                if (image.ids("region")[i] != 0 || image.ids("solid")[i] != 0 || at("A", i) != 0 ||
                    at("Z", i) != std::numeric_limits<float>::infinity())
                    faults.add("something where the ray meets nothing", where);
                continue;
            }
            ++shown[sample_of(both.region(first->region))];
            if (image.ids("region")[i] != first->region + 1) faults.add("another region", where);
            if (at("A", i) != 1) faults.add("A", where);
            if (first->in < 0) {
                ++within;
                if (at("Z", i) != 0) faults.add("the eye is inside, and Z is not 0", where);
                continue;
            }
            const double length = std::sqrt(dot(rays[i].direction, rays[i].direction));
            if (image.ids("solid")[i] != first->in_solid + 1) faults.add("another solid", where);
            if (std::abs(at("Z", i) - first->in * length) > 1e-6 * first->in * length)
                faults.add("another distance", where);
            const Vec3 normal{at("N.X", i), at("N.Y", i), at("N.Z", i)};
            if (dot(normal - first->in_normal, normal - first->in_normal) > 1e-12) faults.add("another normal", where);
        }
        REQUIRE_NONE(faults);
        CHECK(overlaps == counted);
        // First hits only are the same without the counts.
        view.every_partition = false;
        const Image first_hits = both.render(view);
        REQUIRE(first_hits.names.size() == image.names.size() - 3);
        for (std::size_t c = 0; c < first_hits.names.size(); ++c) {
            REQUIRE(first_hits.names[c] == image.names[c]);  // the counts come last
            CHECK(std::ranges::equal(first_hits.channels.ids(c), image.channels.ids(c)));
        }
    }
    CHECK(within > 15'000);
    for (const test::Sample& sample : tested) {
        CAPTURE(sample.name);
        CHECK(shown[sample.name] > 0);
    }
}

TEST_CASE("every solid: what is thinner than the tolerance vanishes, what is thicker is there",
          "[promise:coincidence]") {
    constexpr double thickness = 1e-3;
    const Vec3 way = unit({2, 3, -6});
    Scene scene = test::scene_of_samples();
    Random random(9);
    std::vector<std::string> solids, wholes;
    std::vector<Ray> rays;
    for (const test::Sample& sample : tested) {
        const std::string bounded = add_bounded(scene, sample.name), number = std::to_string(solids.size());
        const Vec3 at = grid(solids.size());
        const Matrix placed = translation(at) * rotation(random);
        // A film of this thickness along the rays, wherever they enter.
        const Matrix behind = translation(thickness * way) * placed;
        add_combination(scene, "film " + number,
                        operate(Operator::difference, {leaf(bounded, placed), leaf(bounded, behind)}), true);
        add_combination(scene, "whole " + number, leaf(bounded, placed), true);
        scene.top.push_back("film " + number);
        wholes.push_back("whole " + number);
        solids.push_back(sample.name);
        for (int i = 0; i < 12; ++i) rays.push_back({at + random.in_cube() - away * way, way});
    }
    const std::vector<RayPartitions> whole = Renderer(scene, wholes, on_reference()).shoot(rays);
    for (const double tolerance : {2 * thickness, 0.5 * thickness}) {
        INFO("tolerance " << tolerance);
        Settings settings{.tolerance = tolerance};
        Both both(scene, settings);
        CHECK(both.reference().statistics().tolerance == tolerance);
        const std::vector<RayPartitions> films = both.shoot(rays);
        std::map<std::string, std::size_t> met;
        Faults faults;
        for (std::size_t i = 0; i < rays.size(); ++i) {
            if (has_close_boundaries(boundaries_of(whole[i]), 20 * thickness)) continue;
            const std::vector<Partition>& seen = films[i].partitions;
            if (tolerance > thickness && !seen.empty()) faults.add("a film is there", std::to_string(i));
            if (tolerance > thickness) continue;
            bool same = seen.size() == whole[i].partitions.size();
            for (std::size_t k = 0; same && k < seen.size(); ++k)
                same = std::abs(seen[k].in - whole[i].partitions[k].in) < 1e-9 &&
                       std::abs(seen[k].out - seen[k].in - thickness) < 1e-9;
            if (!same) faults.add("another film", std::to_string(i));
            met[solids[i / 12]] += seen.size();
        }
        REQUIRE_NONE(faults);
        for (const std::string& solid : solids) {
            CAPTURE(solid);
            if (tolerance < thickness) CHECK(met[solid] > 0);
        }
    }
}

TEST_CASE("every solid: less a copy of itself it is nothing, with one it has no seam, and of two the first has all",
          "[promise:coincidence][promise:overlap]") {
    Scene scene = test::scene_of_samples();
    Random random(13);
    std::vector<Ray> rays;
    std::size_t place = 0;
    const Scene again = scene;
    for (Object object : again.objects) {
        std::get<Solid>(object).name.insert(0, "copy of ");
        scene.objects.push_back(std::move(object));
    }
    for (const test::Sample& sample : tested) {
        const std::string a = add_bounded(scene, sample.name), name = sample.name, b = "bounded copy of " + name;
        Tree copy = leaf("copy of " + name);
        if (name == "half") copy = operate(Operator::intersection, {copy, leaf("copy of limits")});
        add_combination(scene, b, copy, false);
        const Matrix turn = rotation(random);
        for (const char* what : {"less", "with", "both"}) {
            const Vec3 at = grid(place++);
            const Matrix placed = translation(at) * turn;
            const std::string region = std::string(what) + " " + name;
            const auto add = [&](const std::string& named, Tree tree) {
                add_combination(scene, named, std::move(tree), true);
                scene.top.push_back(named);
            };
            const Tree first = leaf(a, placed), second = leaf(b, placed);
            if (what == std::string("less")) add(region, operate(Operator::difference, {first, second}));
            if (what == std::string("with")) add(region, operate(Operator::union_, {first, second}));
            if (what == std::string("both")) add(region, first), add("again " + region, second);
            for (int i = 0; i < 6; ++i) {
                const Vec3 d = random.direction();
                rays.push_back({at + 0.5 * random.in_cube() - away * d, d});
            }
        }
    }
    Both both(scene);
    std::map<std::string, std::size_t> met;
    Faults faults;
    const std::vector<RayPartitions> found = both.shoot(rays);
    for (std::size_t i = 0; i < found.size(); ++i) {
        const std::string where = "ray " + std::to_string(i);
        faults.add(fault_of(found[i], rays[i], both), where);
        for (const Partition& p : found[i].partitions) {
            const std::string region = both.region(p.region);
            ++met[region];
            if (region.starts_with("less") || region.starts_with("again")) faults.add(region + " is there", where);
            if (!region.starts_with("both")) continue;
            if (std::none_of(found[i].overlaps.begin(), found[i].overlaps.end(), [&](const Overlap& o) {
                    return o.in == p.in && o.out == p.out && both.region(o.regions.back()) == "again " + region;
                }))
                faults.add(region + " overlaps its copy, and the overlap is not listed", where);
        }
    }
    REQUIRE_NONE(faults);
    for (const test::Sample& sample : tested) {
        CAPTURE(sample.name);
        CHECK(met[std::string("with ") + sample.name] > 0);
        CHECK(met[std::string("both ") + sample.name] > 0);
    }
}

TEST_CASE("every solid: a placement moves it, turns it, stretches it and mirrors it", "[promise:scenes]") {
    Scene scene = test::scene_of_samples();
    Random random(17);
    std::vector<Ray> rays;
    std::vector<std::vector<Ray>> at_origin;
    std::vector<std::string> bounded;
    for (const test::Sample& sample : tested) {
        bounded.push_back(add_bounded(scene, sample.name));
        const bool keeps_lengths = sample.name == std::string("plates");  // which are as thick in any place
        Matrix stretch = identity;
        stretch[0] = random.sign() * (keeps_lengths ? 1 : random.between(0.5, 1.5));
        stretch[5] = random.sign() * (keeps_lengths ? 1 : random.between(0.5, 1.5));
        if (!keeps_lengths) stretch[6] = random.between(-0.3, 0.3);
        const Vec3 at = grid(at_origin.size());
        const Matrix placed = translation(at) * rotation(random) * stretch * rotation(random);
        add_combination(scene, "placed " + bounded.back(), leaf(bounded.back(), placed), true);
        scene.top.push_back("placed " + bounded.back());
        at_origin.emplace_back();
        for (int i = 0; i < 20; ++i) {
            const Vec3 d = random.direction();
            at_origin.back().push_back({1.2 * random.in_cube() - 30 * d, d});
            rays.push_back({moved_point(placed, at_origin.back().back().origin), moved_direction(placed, d)});
        }
    }
    Both both(scene);
    const std::vector<RayPartitions> found = both.shoot(rays);
    Faults faults;
    for (std::size_t s = 0; s < bounded.size(); ++s) {
        const std::vector<RayPartitions> expected = Renderer(scene, {bounded[s]}, on_reference()).shoot(at_origin[s]);
        std::size_t met = 0;
        for (std::size_t i = 0; i < expected.size(); ++i) {
            if (has_close_boundaries(boundaries_of(expected[i]), clear)) continue;
            std::vector<Partition> mine;
            for (const Partition& p : found[20 * s + i].partitions)
                if (both.region(p.region) == "placed " + bounded[s]) mine.push_back(p);
            bool same = mine.size() == expected[i].partitions.size();
            for (std::size_t k = 0; same && k < mine.size(); ++k)
                same = std::abs(mine[k].in - expected[i].partitions[k].in) < 1e-6 &&
                       std::abs(mine[k].out - expected[i].partitions[k].out) < 1e-6;
            if (!same) faults.add("is not where it was placed", bounded[s] + ", ray " + std::to_string(i));
            met += mine.size();
        }
        CAPTURE(bounded[s]);
        CHECK(met > 0);
    }
    REQUIRE_NONE(faults);
}
