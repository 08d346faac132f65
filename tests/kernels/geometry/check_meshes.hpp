// The kernels' answers for solids that triangles make, before the oracle.
#pragma once

#include "catch.hpp"

#include "kernels/geometry/kernel_answer.hpp"
#include "oracle/campaign.hpp"
#include "oracle/mesh_judge.hpp"
#include "oracle/mesh_rays.hpp"
#include "oracle/mesh_shapes.hpp"
#include "oracle/print.hpp"

namespace csgrt {

struct MeshCampaign {
    std::array<oracle::Tally, oracle::ray_families> tally;
    std::vector<std::string> failures;
    double worst = 0;

    /// 42 rays at one solid.
    void shoot(const std::string& name, const Shape& shape, const Matrix& matrix, const oracle::MeshSurface& surface,
               oracle::Random& random) {
        constexpr std::size_t rays_a_solid = 42, failures_kept = 5;
        const auto solve = kernel_answer(shape, matrix);
        oracle::MeshRayMaker maker(surface, random);
        for (std::size_t i = 0; i < rays_a_solid; ++i) {
            const std::size_t family = i % oracle::ray_families;
            const Ray ray = maker.make(static_cast<oracle::RayFamily>(family));
            const std::vector<oracle::Segment> segments = solve(ray);
            oracle::MeshJudge judge(surface, ray);
            const oracle::MeshVerdict verdict = judge.judge(segments);
            oracle::Tally& t = tally[family];
            ++t.rays;
            t.hits += verdict.hit ? 1 : 0;
            t.ties += verdict.tie ? 1 : 0;
            if (verdict.wrong.empty()) {
                worst = std::max(worst, verdict.worst);
                continue;
            }
            ++t.wrong;
            if (failures.size() == failures_kept) continue;
            std::ostringstream out;
            out.precision(17);
            out << verdict.wrong << "\n  " << name << ", " << oracle::ray_family_names[family] << "\n  "
                << oracle::describe(ray) << "\n  solver:";
            for (const oracle::Segment& s : segments) out << " [" << s.in << ", " << s.out << ']';
            out << "\n  oracle:";
            for (const oracle::MeshCrossing& c : judge.crossings().all) out << ' ' << oracle::to_double(c.t);
            out << "\n  vertices:";
            for (const oracle::QVec& v : surface.vertices()) oracle::print(out << ' ', oracle::to_vec3(v));
            failures.push_back(out.str());
        }
    }

    void check() const {
        std::ostringstream summary;
        std::size_t wrong = 0;
        for (std::size_t i = 0; i < oracle::ray_families; ++i) {
            const oracle::Tally& t = tally[i];
            wrong += t.wrong;
            summary << oracle::ray_family_names[i] << ": " << t.rays << " rays, " << t.hits << " hit, " << t.ties
                    << " ties, " << t.wrong << " wrong\n";
        }
        summary << "largest error: " << worst << " tolerances";
        INFO(summary.str());
        for (const std::string& failure : failures) FAIL_CHECK(failure);
        CHECK(wrong == 0);
        // Were the rays what they are meant to be?
        for (const oracle::Tally& t : tally) CHECK(t.hits * 4 > t.rays);
        CHECK(tally[0].ties * 100 <= tally[0].rays);
        CHECK(tally[static_cast<std::size_t>(oracle::RayFamily::edge)].ties > 0);
    }
};

}  // namespace csgrt
