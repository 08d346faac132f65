// From what a ray does to each solid to what it meets in regions: the ends of all are sorted, and wherever some solid
// begins or ends, the trees of the regions that it stands in are evaluated anew.
#pragma once

#include <vector>

#include "scene_regions.hpp"
#include "spans.hpp"

namespace csgrt::oracle {

/// A stretch of a ray over which nothing changes, and the regions that hold it or may hold it, ascending.
struct Piece {
    struct Claim {
        std::uint32_t region = 0;
        bool certain = false;
    };
    double in = 0, out = 0;
    std::vector<Claim> claims;
};

/// An end of a solid's interval.
struct Event {
    double t = 0, tolerance = 0;
    Vec3 normal;          ///< outward from the solid; 0: more than one would do
    double rounding = 0;  ///< of the tolerance: what rounding the ray's and the solid's numbers can cause
    std::size_t solid = 0;
};

struct SceneAnswer {
    std::vector<Spans> regions;  ///< for every region its spans, exactly
    std::vector<Piece> pieces;   ///< the whole line, in order
    std::vector<Event> events;   ///< of all solids, in no order
    bool tie = false;            ///< rounding, or the slack, decides how many spans some region has, or where one ends
    bool solid_tie = false;      ///< rounding decides how many intervals some solid has
};

/// A solid along the ray: where it is for certain, where by its numbers, and where it may be.
struct Sure {
    std::size_t index = 0;
    Spans inner, exact, outer;
};

/// Every span longer by `by` at both ends (shorter if negative).
Spans resized(Spans spans, quad by);
/// `most`: by what the ends of any set were moved, as far as it is no leap.
/// `regions_of`: by solid, which regions it stands in.
void weave(const std::vector<Sure>& sets, const std::vector<OracleRegion>& regions,
           const std::vector<std::vector<std::uint32_t>>& regions_of, quad most, SceneAnswer& answer);

}  // namespace csgrt::oracle
