// The floating-point filter against 113-bit arithmetic: its answers are the same, and it has one for most rays.
#include "catch.hpp"

#include <array>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <sstream>

#include "oracle/print.hpp"
#include "oracle/filtered_solid.hpp"
#include "oracle/rays.hpp"
#include "oracle/shapes.hpp"

using namespace csgrt;
using namespace csgrt::oracle;

namespace {

constexpr std::array kinds{Kind::ell, Kind::tgc, Kind::arb, Kind::arbn, Kind::half, Kind::tor, Kind::ehy,
                           Kind::epa, Kind::rpc, Kind::rhc, Kind::eto,  Kind::hyp,  Kind::part};

double apart(const Vec3& a, const Vec3& b) { return to_double(length(QVec(a) - QVec(b))); }

/// How the filtered answer contradicts the 113-bit one; empty: it does not.
std::string contradiction(const Ray& ray, const Answer& filtered, const Answer& full) {
    std::ostringstream wrong;
    wrong.precision(17);
    if (full.tie) wrong << "a tie; ";
    if (filtered.intervals.size() != full.intervals.size() || filtered.inner.size() != full.inner.size() ||
        filtered.outer.size() != full.outer.size()) {
        wrong << filtered.intervals.size() << " intervals, not " << full.intervals.size() << "; ";
        return wrong.str();
    }
    if (std::abs(filtered.delta - full.delta) > 1e-9 * full.delta) wrong << "delta " << filtered.delta << "; ";
    // 100 bits of what is rounded: the solid's place, its size, the way to it; more where a surface turns away from the
    // ray.
    const double speed = to_double(length(QVec(ray.direction)));
    const double scale = full.delta / (ulps * double_epsilon);
    const auto same = [&](const char* what, quad a, quad b, double cosine, double rest) {
        if (absolute(a) >= infinity() || absolute(b) >= infinity()) {
            if (a != b) wrong << what << " is infinite; ";
        } else if (absolute(a - b) > quad(1e-26) * scale / (speed * cosine) + quad(rest)) {
            wrong << what << " is off by " << to_double(a - b) << "; ";
        }
    };
    for (std::size_t i = 0; i < full.intervals.size(); ++i)
        for (const bool in : {true, false}) {
            const End &a = in ? filtered.intervals[i].in : filtered.intervals[i].out,
                      &b = in ? full.intervals[i].in : full.intervals[i].out;
            if (a.t != b.t && !(std::abs(a.t - b.t) <= 4 * double_epsilon * std::abs(b.t) + 1e-26 * scale / speed))
                wrong << "an end is off by " << a.t - b.t << "; ";
            if (!std::isfinite(b.t)) continue;
            if (apart(a.normal, b.normal) > normal_error)
                wrong << "a normal is off by " << apart(a.normal, b.normal) << "; ";
            if (std::abs(a.cosine - b.cosine) > 1e-7 * b.cosine) wrong << "cosine " << a.cosine << "; ";
            if (std::abs(a.tolerance - b.tolerance) > 1e-4 * b.tolerance)
                wrong << "tolerance " << a.tolerance << ", not " << b.tolerance << "; ";
            // By how much an end may be shifted is known to some digits.
            const auto end = [&](const Spans& spans) { return in ? spans[i].in.at : spans[i].out.at; };
            const double width = to_double(absolute(end(full.inner) - end(full.outer)));
            same("inner", end(filtered.inner), end(full.inner), b.cosine, 1e-4 * width);
            same("outer", end(filtered.outer), end(full.outer), b.cosine, 1e-4 * width);
            same("the middle of the doubt", end(filtered.inner) + end(filtered.outer),
                 end(full.inner) + end(full.outer), b.cosine, 1e-4 * width);
        }
    return wrong.str();
}

}  // namespace

TEST_CASE("the filter's answers are those of 113 bits, and it has one for most rays", "[oracle]") {
    std::size_t rays_a_kind = 2000;
    if (const char* more = std::getenv("CSGRT_RAYS")) rays_a_kind = std::strtoull(more, nullptr, 10);
    for (const Kind kind : kinds) {
        Random random(23);
        std::array<std::size_t, ray_families> all{}, ties{}, certain{};
        std::size_t failures = 0;
        std::string name;
        for (std::size_t done = 0, index = 0; done < rays_a_kind; ++index) {
            const Case one = make_case(kind, index, random);
            name = type_name(one.shape);
            const auto solid = std::make_shared<ImplicitSolid>(implicit(one.shape, one.matrix));
            const FilteredSolid filtered(solid);
            RayMaker maker(one.shape, *solid, random);
            for (std::size_t i = 0; i < 42 && done < rays_a_kind; ++i, ++done) {
                const std::size_t family = i % ray_families;
                const Ray ray = maker.make(static_cast<RayFamily>(family));
                const Answer full = intersect(*solid, ray);
                const std::optional<Answer> answer = filtered(ray);
                ++all[family];
                ties[family] += full.tie;
                certain[family] += answer.has_value();
                if (!answer) continue;
                const std::string wrong = contradiction(ray, *answer, full);
                if (!wrong.empty() && ++failures < 6)
                    FAIL_CHECK(one.name << ", " << ray_family_names[family] << "\n  " << describe(one.shape, one.matrix)
                                        << "\n  " << describe(ray) << "\n  " << wrong << "\n  " << describe(full));
            }
        }
        std::printf("%-6s", name.c_str());
        for (std::size_t f = 0; f < ray_families; ++f)
            std::printf(" %s %zu+%zu/%zu", ray_family_names[f], certain[f], ties[f], all[f]);
        std::printf("\n");
        CHECK(failures == 0);
        for (const RayFamily easy : {RayFamily::ordinary, RayFamily::far, RayFamily::inside}) {
            const auto family = static_cast<std::size_t>(easy);
            CHECK(certain[family] > all[family] * 3 / 4);
        }
    }
}
