// librt's names over csgrt: the partitions are Renderer::shoot()'s, to the last bit, and callbacks decide as librt's
// do.
#include <csgrt/librt.h>

#include <bit>
#include <filesystem>
#include <fstream>
#include <functional>
#include <thread>

#include "catch.hpp"
#include "integration/lists.hpp"
#include "integration/same_answers.hpp"
#include "integration/scenes.hpp"

using namespace csgrt;

namespace {

bool same(double a, double b) { return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b); }

struct Free {
    void operator()(rt_i* rtip) const { rt_free_rti(rtip); }
};
using Opened = std::unique_ptr<rt_i, Free>;

Opened open(const std::string& file, std::vector<const char*> objects = {}) {
    char title[8] = {};
    Opened rtip(rt_dirbuild(file.c_str(), title, sizeof title));
    REQUIRE(rtip);
    CHECK(std::string(title) == rtip->scene.title.substr(0, 7));
    REQUIRE(rt_gettrees(rtip.get(), static_cast<int>(objects.size()), objects.data(), 1) == 0);
    rt_prep_parallel(rtip.get(), 2);
    return rtip;
}

/// Three balls of radius 10 in a row, at 0, 12 and 24 on x: a.r and b.r overlap from 2 to 10, b.r and c.r from 14 to
/// 22; d.r is air, and all.r's three cubes overlap from 102 to 104.
Opened balls() {
    static const std::string file = (std::filesystem::temp_directory_path() / "csgrt_librt_test.json").string();
    std::ofstream(file) << R"({"csgrt": 1, "solids": {
        "a": {"type": "sphere", "center": [0, 0, 0], "radius": 10},
        "b": {"type": "sphere", "center": [12, 0, 0], "radius": 10},
        "c": {"type": "sphere", "center": [24, 0, 0], "radius": 10},
        "d": {"type": "box", "low": [50, -5, -5], "high": [60, 5, 5]},
        "e": {"type": "box", "low": [100, -5, -5], "high": [104, 5, 5]},
        "f": {"type": "box", "low": [101, -5, -5], "high": [105, 5, 5]},
        "g": {"type": "box", "low": [102, -5, -5], "high": [106, 5, 5]}},
        "combinations": {
        "a.r": {"region": true, "id": 1, "tree": "a"}, "b.r": {"region": true, "id": 2, "tree": "b"},
        "c.r": {"region": true, "id": 3, "tree": "c"}, "d.r": {"region": true, "air": 1, "tree": "d"},
        "e.r": {"region": true, "id": 5, "los": 50, "tree": "e"}, "f.r": {"region": true, "id": 6, "tree": "f"},
        "g.r": {"region": true, "id": 7, "tree": "g"}}})";
    Opened rtip(rt_dirbuild(file.c_str(), nullptr, 0));
    REQUIRE(rtip);
    rtip->useair = 1;
    rt_prep(rtip.get());
    return rtip;
}

xray along_x(double from) {
    xray ray;
    VSET(ray.r_pt, from, 0, 0);
    VSET(ray.r_dir, 1, 0, 0);
    return ray;
}

/// "a.r -10 10, ..." of the partitions, walked forwards; they are the same backwards.
std::string text_of(const partition* head) {
    std::string text, back;
    char one[100];
    const auto put = [&](const partition* p) {
        std::snprintf(one, sizeof one, "%s %g %g", p->pt_regionp->reg_name + 1, p->pt_inhit->hit_point[X],
                      p->pt_outhit->hit_point[X]);
        return std::string(one);
    };
    for (const partition* p = head->pt_forw; p != head; p = p->pt_forw) text += (text.empty() ? "" : ", ") + put(p);
    for (const partition* p = head->pt_back; p != head; p = p->pt_back)
        back = put(p) + (back.empty() ? "" : ", ") + back;
    CHECK(text == back);
    return text;
}

struct Told {
    std::string text;
    int misses = 0, calls = 0;
    int code = 1;  ///< of overlaps
};
int take(application* ap, partition* head, seg*) {
    static_cast<Told*>(ap->a_uptr)->text = text_of(head);
    return 7;
}
int miss(application* ap) {
    ++static_cast<Told*>(ap->a_uptr)->misses;
    return -3;
}
int decide(application* ap, partition* p, region* one, region* other, partition*) {
    Told& told = *static_cast<Told*>(ap->a_uptr);
    ++told.calls;
    CHECK(one->reg_bit < other->reg_bit);
    CHECK(p->pt_inhit->hit_dist < p->pt_outhit->hit_dist);
    return told.code;
}

application asking(rt_i& rtip, Told& told) {
    application ap;
    RT_APPLICATION_INIT(&ap);
    ap.a_rt_i = &rtip;
    ap.a_hit = take;
    ap.a_miss = miss;
    ap.a_uptr = &told;
    ap.a_resource = &rt_uniresource;
    ap.a_logoverlap = rt_silent_logoverlap;
    ap.a_ray = along_x(-20);
    return ap;
}

int compare(application* ap, partition* head, seg*) {
    const auto& expected = *static_cast<const std::vector<csgrt::Partition>*>(ap->a_uptr);
    std::size_t i = 0;
    for (const partition* p = head->pt_forw; p != head; p = p->pt_forw, ++i) {
        REQUIRE(i < expected.size());
        const csgrt::Partition& of = expected[i];
        REQUIRE(same(p->pt_inhit->hit_dist, of.in));
        REQUIRE(same(p->pt_outhit->hit_dist, of.out));
        REQUIRE(p->pt_regionp->reg_bit == of.region);
        REQUIRE(p->pt_inseg->seg_stp->st_bit == of.in_solid);
        REQUIRE(p->pt_outseg->seg_stp->st_bit == of.out_solid);
        vect_t in, out;
        RT_HIT_NORMAL(in, p->pt_inhit, p->pt_inseg->seg_stp, &ap->a_ray, p->pt_inflip);
        RT_HIT_NORMAL(out, p->pt_outhit, p->pt_outseg->seg_stp, &ap->a_ray, p->pt_outflip);
        for (int axis = 0; axis < 3; ++axis) {
            REQUIRE(same(in[axis], (&of.in_normal.x)[axis]));
            REQUIRE(same(out[axis], (&of.out_normal.x)[axis]));
        }
    }
    REQUIRE(i == expected.size());
    return 1;
}

}  // namespace

TEST_CASE("rt_shootray and shoot_many give the partitions of Renderer::shoot, to the last bit", "[promise:librt]") {
    for (const std::string& file : test::scene_files()) {
        const Opened rtip = open(file);
        Renderer renderer(rtip->scene, {}, test::on_native_device());
        const std::vector<Ray> rays = test::random_rays(renderer.model().bounds(), 40);
        const std::vector<RayPartitions> answers = renderer.shoot(rays);
        CHECK(rtip->nregions == renderer.model().regions().size());
        std::vector<xray> list;
        std::size_t hits = 0;
        for (std::size_t i = 0; i < rays.size(); ++i) {
            application ap;
            ap.a_rt_i = rtip.get();
            ap.a_hit = compare;
            librt::copy(ap.a_ray.r_pt, rays[i].origin);
            librt::copy(ap.a_ray.r_dir, rays[i].direction);
            ap.a_uptr = const_cast<std::vector<csgrt::Partition>*>(&answers[i].partitions);
            CHECK(rt_shootray(&ap) == !answers[i].partitions.empty());
            hits += !answers[i].partitions.empty();
            list.push_back(ap.a_ray);
            std::size_t told = 0;
            CHECK(librt::shoot(rtip.get(), ap.a_ray, [&](const partition& p) {
                return same(p.pt_inhit->hit_dist, answers[i].partitions.at(told++).in);
            }));
            CHECK(told == answers[i].partitions.size());
        }
        application ap;
        ap.a_rt_i = rtip.get();
        static const std::vector<RayPartitions>* expected;
        expected = &answers;
        ap.a_hit = [](application* of, partition* head, seg* segs) {
            of->a_uptr =
                const_cast<std::vector<csgrt::Partition>*>(&(*expected)[static_cast<std::size_t>(of->a_x)].partitions);
            return compare(of, head, segs);
        };
        CHECK(librt::shoot_many(&ap, list.data(), list.size()) == hits);
    }
}

TEST_CASE("a callback about overlaps gives them to nobody, the first or the second region", "[promise:librt]") {
    const Opened rtip = balls();
    Told told;
    application ap = asking(*rtip, told);
    const std::string rest = ", d.r 50 60, e.r 100 104, f.r 104 105, g.r 105 106";
    CHECK(rt_shootray(&ap) == 7);
    CHECK(ap.a_return == 7);
    CHECK(told.text == "a.r -10 10, b.r 10 22, c.r 22 34" + rest);
    ap.a_overlap = decide;
    rt_shootray(&ap);
    CHECK(told.text == "a.r -10 10, b.r 10 22, c.r 22 34" + rest);
    // a and b, b and c; e and f from 101 to 102, then with g from 102 to 104; f and g from 104 to 105.
    CHECK(told.calls == 6);
    told.code = 0;
    rt_shootray(&ap);
    CHECK(told.text == "a.r -10 2, b.r 10 14, c.r 22 34, d.r 50 60, e.r 100 101, g.r 102 104, g.r 105 106");
    told.code = 2;
    rt_shootray(&ap);
    CHECK(told.text == "a.r -10 2, b.r 2 14, c.r 14 34, d.r 50 60, e.r 100 101, f.r 101 102, g.r 102 106");
    told.text.clear();
    ap.a_ray = along_x(5);  // within a's and b's overlap, which is told of whole
    rt_shootray(&ap);
    CHECK(told.text == "b.r 2 14, c.r 14 34, d.r 50 60, e.r 100 101, f.r 101 102, g.r 102 106");
    ap.a_hit = [](application* of, partition* head, seg*) {
        // The solid where each partition begins and ends, and whether the normals point out of it.
        std::string& text = static_cast<Told*>(of->a_uptr)->text;
        text.clear();
        for (const partition* p = head->pt_forw; p != head; p = p->pt_forw) {
            text += std::string(p->pt_inseg->seg_stp->st_name) + p->pt_outseg->seg_stp->st_dp->d_namep + ' ';
            CHECK(p->pt_inhit->hit_normal[X] == -1);
            CHECK(p->pt_outhit->hit_normal[X] == 1);
        }
        return 1;
    };
    ap.a_ray = along_x(-20);
    rt_shootray(&ap);
    CHECK(told.text == "ab bc cc dd ef fg gg ");  // as in the partitions of code 2
    told.code = 0;
    const std::vector<xray> rays(2, ap.a_ray);
    CHECK(librt::shoot_many(&ap, rays.data(), rays.size()) == 2);
    CHECK(told.text == "ab ac bc dd ef ge fg ");
}

TEST_CASE("however overlaps are decided, each end has its solid and a normal that points outward") {
    static int code;
    static std::size_t asked, ends;
    for (const std::string& file : test::scene_files()) {
        INFO(file);
        const Opened rtip = open(file);
        application ap;
        ap.a_rt_i = rtip.get();
        ap.a_overlap = [](application*, partition*, region*, region*, partition*) {
            ++asked;
            return code;
        };
        ap.a_hit = [](application* of, partition* head, seg*) {
            for (const partition* p = head->pt_forw; p != head; p = p->pt_forw) {
                ends += 2;
                const bool in = std::isinf(p->pt_inhit->hit_dist), out = std::isinf(p->pt_outhit->hit_dist);
                REQUIRE((in || p->pt_inseg->seg_stp->st_bit >= 0));
                REQUIRE((out || p->pt_outseg->seg_stp->st_bit >= 0));
                REQUIRE((in || VDOT(p->pt_inhit->hit_normal, of->a_ray.r_dir) < 1e-6));
                REQUIRE((out || VDOT(p->pt_outhit->hit_normal, of->a_ray.r_dir) > -1e-6));
            }
            return 1;
        };
        std::vector<xray> rays;
        for (const Ray& ray : test::random_rays(Renderer(rtip->scene).model().bounds(), 200)) {
            librt::copy(rays.emplace_back().r_pt, ray.origin);
            librt::copy(rays.back().r_dir, ray.direction);
        }
        for (code = 0; code <= 2; ++code) librt::shoot_many(&ap, rays.data(), rays.size());
    }
    CHECK(asked > 100);
    CHECK(ends > 1000);
}

TEST_CASE("a_onehit counts ends, and a ray that meets nothing is a miss", "[promise:librt]") {
    const Opened rtip = balls();
    Told told;
    application ap = asking(*rtip, told);
    ap.a_onehit = 1;
    rt_shootray(&ap);
    CHECK(told.text == "a.r -10 10");
    ap.a_onehit = 3;
    rt_shootray(&ap);
    CHECK(told.text == "a.r -10 10, b.r 10 22");
    ap.a_ray = along_x(40);
    ap.a_onehit = 1;
    rt_shootray(&ap);
    CHECK(told.text == "d.r 50 60");
    ap.a_onehit = -1;
    rt_shootray(&ap);
    CHECK(told.text == "d.r 50 60, e.r 100 104");
    CHECK(told.misses == 0);
    ap.a_ray = along_x(200);
    CHECK(rt_shootray(&ap) == -3);
    CHECK(told.misses == 1);
    CHECK_FALSE(librt::shoot(rtip.get(), along_x(-20), [](const partition&) { return false; }));
}

TEST_CASE("callbacks shoot, from several threads at once", "[promise:librt]") {
    const Opened rtip = balls();
    std::vector<std::thread> threads;
    std::vector<std::string> texts(4);
    for (std::string& text : texts)
        threads.emplace_back([&rtip, &text] {
            for (int i = 0; i < 20; ++i) {
                Told told;
                application ap = asking(*rtip, told);
                ap.a_hit = [](application* outer, partition* head, seg*) {
                    const std::string before = text_of(head);
                    application inner = *outer;
                    inner.a_hit = take;
                    inner.a_ray = along_x(40);
                    const int answer = rt_shootray(&inner);
                    Told& of = *static_cast<Told*>(outer->a_uptr);
                    of.text = before == text_of(head) ? of.text : "the outer ring changed";
                    const std::vector<xray> rays(3, along_x(70));
                    return static_cast<int>(librt::shoot_many(&inner, rays.data(), rays.size())) + answer;
                };
                text = rt_shootray(&ap) == 3 + 7 ? told.text : "another answer";
            }
        });
    for (std::thread& thread : threads) thread.join();
    for (const std::string& text : texts) CHECK(text == "e.r 100 104, f.r 104 105, g.r 105 106");
}

TEST_CASE("what cannot be is refused", "[promise:librt]") {
    CHECK(rt_dirbuild("no/such/file.g", nullptr, 0) == RTI_NULL);
    const Opened rtip = balls();
    CHECK(rtip->Regions[3]->reg_los == 50);
    CHECK(rtip->Regions[6]->reg_aircode == 1);  // air comes last
    CHECK(rtip->mdl_max[X] == 106);
    Told told;
    application ap = asking(*rtip, told);
    VSET(ap.a_ray.r_dir, 0, 0, 0);
    CHECK_THROWS_AS(rt_shootray(&ap), Error);
    const char* names[] = {"a.r", "z.r"};
    CHECK(rt_gettrees(rtip.get(), 2, names, 1) < 0);
    CHECK(rtip->objects.empty());
    ap.a_rt_i = RTI_NULL;
    CHECK_THROWS_WITH(rt_shootray(&ap), "there is no model: rt_dirbuild() returned RTI_NULL");
}

TEST_CASE("of a name that is not there nothing is hit, without any name the top objects") {
    const Opened rtip = balls();
    Told told;
    application ap = asking(*rtip, told);
    const auto hits = [&] {
        const int misses = told.misses, returned = rt_shootray(&ap);
        CHECK(returned == (rtip->nregions == 0 ? -3 : 7));
        CHECK(told.misses == misses + (rtip->nregions == 0));
        std::size_t rows = 0;
        CHECK(librt::shoot(rtip.get(), ap.a_ray, [&](const partition&) { return ++rows > 0; }));
        CHECK((rows == 0) == (rtip->nregions == 0));
        CHECK(librt::shoot_many(&ap, &ap.a_ray, 1) == (rows > 0));
        return rtip->nregions;
    };
    CHECK(hits() == 7);
    CHECK(rt_gettree(rtip.get(), "A.r") < 0);
    rt_prep_parallel(rtip.get(), 1);
    CHECK(hits() == 0);
    CHECK(rtip->HeadRegion.forw == &rtip->HeadRegion);
    CHECK(rt_gettree(rtip.get(), "b.r") == 0);
    CHECK(rtip->nsolids == 1);
    CHECK(hits() == 1);  // the first ray prepares
    CHECK(told.text == "b.r 2 22");
    rt_clean(rtip.get());
    CHECK(rtip->nsolids == 0);
    CHECK(hits() == 0);
    CHECK(rt_gettree(rtip.get(), "d.r") == 0);
    CHECK(hits() == 1);
    region* one = nullptr;
    std::string names;
    for (BU_LIST_FOR(one, region, &rtip->HeadRegion)) names += one->reg_name;
    CHECK(names == "/d.r");
}

TEST_CASE("a handler of several regions takes those out of the table that do not get the part") {
    const Opened rtip = balls();
    struct : Told {
        std::string tables, log;
        std::size_t kept = 0;
    } told;
    application ap = asking(*rtip, told);
    ap.a_uptr = &told;
    static decltype(told)* const all = &told;
    ap.a_overlap = decide;
    ap.a_multioverlap = [](application*, partition* p, bu_ptbl* table, partition*) {
        char text[50];
        std::snprintf(text, sizeof text, "%g %g", p->pt_inhit->hit_dist, p->pt_outhit->hit_dist);
        all->tables += text;
        region** each;
        for (BU_PTBL_FOR(each, (region**), table)) all->tables += (*each)->reg_name;
        all->tables += ", ";
        if (all->kept == 0) return bu_ptbl_reset(table);
        for (std::size_t i = 0; i < BU_PTBL_LEN(table); ++i)
            if (i + 1 != all->kept) BU_PTBL_SET(table, i, REGION_NULL);
    };
    ap.a_logoverlap = [](application*, const partition*, const bu_ptbl* table, const partition*) {
        all->log += std::to_string(BU_PTBL_LEN(table)) + " ";
    };
    const std::string asked = "22 30/a.r/b.r, 34 42/b.r/c.r, 121 122/e.r/f.r, 122 124/e.r/f.r/g.r, 124 125/f.r/g.r, ";
    rt_shootray(&ap);
    CHECK(told.tables == asked);
    CHECK(told.log == "2 2 2 3 2 ");
    CHECK(told.text == "a.r -10 2, b.r 10 14, c.r 22 34, d.r 50 60, e.r 100 101, g.r 105 106");
    told.kept = 2;
    rt_shootray(&ap);
    CHECK(told.text == "a.r -10 2, b.r 2 14, c.r 14 34, d.r 50 60, e.r 100 101, f.r 101 104, g.r 104 106");
    CHECK(told.calls == 0);  // a_overlap is not asked, too
    ap.a_multioverlap = nullptr;
    ap.a_overlap = nullptr;
    rt_shootray(&ap);  // logged alone
    CHECK(told.log == "2 2 2 3 2 2 2 2 3 2 2 2 2 3 2 ");
    CHECK(told.text == "a.r -10 10, b.r 10 22, c.r 22 34, d.r 50 60, e.r 100 104, f.r 104 105, g.r 105 106");
}

// BRL-CAD's MOOSE shoots so: it prepares nothing itself, and computes normals in place.
TEST_CASE("a loop over hits and overlaps, with a model that nobody prepared") {
    struct Loop {
        std::function<bool(const region*, const partition*)> each;
        static int hits(application* ap, partition* head, seg* UNUSED(segs)) {
            const auto* const loop = static_cast<const Loop*>(ap->a_uptr);
            for (partition* p = head->pt_forw; ap->a_return == 0 && p != head; p = p->pt_forw)
                if (!loop->each(p->pt_regionp, p)) ap->a_return = 1;
            return ap->a_return;
        }
        static void overlaps(application* ap, partition* p, bu_ptbl* regions, partition* UNUSED(head)) {
            for (std::size_t i = 0; ap->a_return == 0 && i < BU_PTBL_LEN(regions); ++i) {
                region* const reg = reinterpret_cast<region*>(BU_PTBL_GET(regions, i));
                if (reg == REGION_NULL) continue;
                RT_CK_REGION(reg);
                if (!static_cast<const Loop*>(ap->a_uptr)->each(reg, p)) ap->a_return = 1;
            }
            bu_ptbl_reset(regions);
        }
    };
    const Opened rtip = balls();
    rt_clean(rtip.get());
    CHECK(rtip->nsolids < 1);
    CHECK(rt_gettree(rtip.get(), "a.r") == 0);
    CHECK(rt_gettree(rtip.get(), "b.r") == 0);
    CHECK(rtip->nsolids == 2);
    std::string text;
    Loop loop{[&](const region* reg, const partition* p) {
        hit* const in = p->pt_inhit;
        RT_HIT_NORMAL(in->hit_normal, in, p->pt_inseg->seg_stp, 0, p->pt_inflip);
        char one[50];
        std::snprintf(one, sizeof one, "%s %g %g, ", reg->reg_name, in->hit_point[X], p->pt_outhit->hit_dist);
        text += one;
        return true;
    }};
    application ap;
    RT_APPLICATION_INIT(&ap);
    ap.a_hit = Loop::hits;
    ap.a_miss = 0;
    ap.a_overlap = 0;
    ap.a_multioverlap = Loop::overlaps;
    ap.a_rt_i = rtip.get();
    ap.a_level = ap.a_onehit = ap.a_return = 0;
    ap.a_uptr = &loop;
    VSET(ap.a_ray.r_pt, -20, 0, 0);
    VSET(ap.a_ray.r_dir, 4, 0, 0);
    VUNITIZE(ap.a_ray.r_dir);
    rt_shootray(&ap);
    CHECK(text == "/a.r 2 30, /b.r 2 30, /a.r -10 22, /b.r 10 42, ");
}
