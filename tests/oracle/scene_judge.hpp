// Puts the partitions of a ray before the scene oracle.
//
// Everywhere in front of the ray's start: where no region can be, nothing is reported; where one is for certain, one
// that may be there is, and none that must yield to it: one of a later rank (air to a solid, FASTGEN's to others), or
// of the same rank and later in the model; where several of that rank are, the overlap is listed with all of them. On
// rays without a tie partitions begin and end where some solid does; without overlaps, too, each region's are the
// oracle's spans, end for end. Normals are unit vectors, and at an end that belongs to one solid's surface alone they
// are that surface's, turned against the ray on the way in and along it on the way out.
#pragma once

#include <cstdint>
#include <ostream>
#include <string>
#include <vector>

#include <csgrt/renderer.hpp>

#include "scene_oracle.hpp"

namespace csgrt::oracle {

class SceneJudge {
public:
    /// `regions`: the renderer's, by index. `slack` in millimetres: ends this close together may be one.
    SceneJudge(const SceneOracle& oracle, const std::vector<RegionInfo>& regions, double slack);

    /// Regions that the renderer has and the oracle has not; empty: none.
    const std::string& unknown_regions() const { return unknown_; }

    /// What is wrong; empty: nothing. Adds 1 to `ties` if rounding, or the slack, decides something on this ray.
    std::string judge(const Ray& ray, const RayPartitions& found, std::size_t& ties) const;

    /// The same of a point, of which csgrt says that this region holds it; -1: none. `overlaps`: it says -2 where
    /// several of a rank do, else it names their first. Adds 1 to `decided` unless rounding, or the slack, decides
    /// whether some region does.
    std::string judge_point(const Vec3& point, std::int32_t found, bool overlaps, std::size_t& decided) const;

private:
    const std::string& name(std::uint32_t region) const { return oracle_.regions()[region].path; }
    /// How many regions of that rank hold a piece for certain.
    std::size_t certain(const Piece& piece, int rank) const;
    /// Do several regions hold it for certain, of whatever rank?
    static bool contested(const Piece& piece);
    /// Do regions overlap by more than that behind the ray's start? Nobody lists it, but it cuts what reaches across
    /// the start.
    static bool overlap_behind(const SceneAnswer& answer, double slack);
    static bool claimed(const Piece& piece, std::uint32_t region);

    static void check_order(const RayPartitions& found, std::ostream& wrong);

    void check_piece(const Piece& piece, const RayPartitions& found, std::ostream& wrong) const;

    void check_spans(const Ray& ray, const SceneAnswer& answer, const RayPartitions& found, std::ostream& wrong) const;

    /// Also where regions overlap: nothing begins or ends but where a solid does.
    void check_ends(const Ray& ray, const SceneAnswer& answer, const RayPartitions& found, std::ostream& wrong) const;

    void check_normals(const Ray& ray, const SceneAnswer& answer, const RayPartitions& found,
                       std::ostream& wrong) const;

    const SceneOracle& oracle_;
    double slack_;
    std::vector<std::uint32_t> to_oracle_;
    std::string unknown_;
};

}  // namespace csgrt::oracle
