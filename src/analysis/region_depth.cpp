#include "analysis/region_depth.hpp"

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

namespace csgrt::analysis {

namespace {

constexpr double unknown = -std::numeric_limits<double>::infinity();

}  // namespace

/// Solids without a bound tell how far outside of their box the point is.
Depth RegionDepth::of_solid(std::uint32_t solid, const Vec3& point) const {
    if (bounds_.has(solid)) {
        const double outside = bounds_.at(solid, point);
        return {-outside, outside};
    }
    const Box& box = scene_.solid_boxes[solid];
    double outside = unknown;
    for (double Vec3::*const axis : axes)
        outside = std::max({outside, box.low.*axis - point.*axis, point.*axis - box.high.*axis});
    return {unknown, outside > 0 ? outside : unknown};
}

/// Calls take(operand) for the operands of a node; the first operand comes last.
template <class Take>
void RegionDepth::for_operands(std::size_t node, const Take& take) const {
    std::size_t at = node;
    for (std::uint32_t i = 0; i < nodes_[node].arity; ++i) {
        take(at - 1);
        at = begins_[at - 1];
    }
}

RegionDepth::RegionDepth(const CompiledScene& scene, const DistanceBounds& bounds,
                         const std::vector<FlatTree::Node>& tree, const Box& box)
    : scene_(scene), bounds_(bounds) {
    reduce(tree, box);
    begins_.resize(nodes_.size());
    depths_.resize(nodes_.size());
    for (std::size_t i = 0; i < nodes_.size(); ++i) {
        begins_[i] = i;
        for_operands(i, [&](std::size_t operand) { begins_[i] = begins_[operand]; });
    }
}

/// Copies a tree; a solid whose box has nothing in common with the box is the empty set there, and so are operators
/// that it makes so.
void RegionDepth::reduce(const std::vector<FlatTree::Node>& tree, const Box& box) {
    std::vector<std::size_t> first;  // by operand: where it begins in nodes_; an empty one has no nodes there
    for (const FlatTree::Node& node : tree) {
        const std::size_t at = nodes_.size();
        if (node.op == Operator::leaf) {
            first.push_back(at);
            const Box both = common(box, scene_.solid_boxes[node.solid]);
            if (both.low.x <= both.high.x && both.low.y <= both.high.y && both.low.z <= both.high.z)
                nodes_.push_back(node);
            continue;
        }
        const std::span<const std::size_t> operands(first.end() - node.arity, first.end());
        const std::size_t begin = operands.empty() ? at : operands[0];
        const auto is_there = [&](std::size_t k) {
            return (k + 1 < operands.size() ? operands[k + 1] : at) > operands[k];
        };
        std::uint32_t arity = 0;
        for (std::size_t k = 0; k < operands.size(); ++k) arity += is_there(k);
        const bool has_first = !operands.empty() && is_there(0);
        first.resize(first.size() - node.arity);
        first.push_back(begin);
        FlatTree::Node kept = node;
        kept.arity = arity;
        switch (node.op) {
            case Operator::intersection:
                if (arity < node.arity)
                    nodes_.resize(begin);
                else
                    nodes_.push_back(kept);
                break;
            case Operator::difference:
                if (!has_first)
                    nodes_.resize(begin);
                else if (arity > 1)
                    nodes_.push_back(kept);
                break;
            case Operator::not_:
                nodes_.push_back(kept);
                break;
            default:
                if (arity > 1) nodes_.push_back(kept);
        }
    }
}

Depth RegionDepth::at(const Vec3& point) {
    for (std::size_t i = 0; i < nodes_.size(); ++i) {
        const FlatTree::Node& node = nodes_[i];
        if (node.op == Operator::leaf) {
            depths_[i] = of_solid(node.solid, point);
            continue;
        }
        // The point is inside or outside of each operand of an xor; within the least depth in any, nothing changes.
        Depth all{HUGE_VAL, HUGE_VAL}, any{unknown, unknown}, last{unknown, HUGE_VAL};
        double least = HUGE_VAL;
        bool is_odd = false;
        for_operands(i, [&](std::size_t operand) {
            const Depth& k = last = depths_[operand];
            all = {std::min(all.in, k.in), std::min(all.out, k.out)};
            any = {std::max(any.in, k.in), std::max(any.out, k.out)};
            least = std::min(least, std::max(k.in, k.out));
            is_odd ^= k.in > k.out;
        });
        switch (node.op) {
            case Operator::intersection:
                depths_[i] = {all.in, any.out};
                break;
            case Operator::difference: {
                Depth others{HUGE_VAL, unknown};
                for_operands(i, [&](std::size_t operand) {
                    if (begins_[operand] == begins_[i]) return;
                    others = {std::min(others.in, depths_[operand].out), std::max(others.out, depths_[operand].in)};
                });
                depths_[i] = {std::min(last.in, others.in), std::max(last.out, others.out)};
                break;
            }
            case Operator::xor_:
                depths_[i] = is_odd ? Depth{least, unknown} : Depth{unknown, least};
                break;
            case Operator::not_:
                depths_[i] = {last.out, last.in};
                break;
            default:
                depths_[i] = {any.in, all.out};
        }
    }
    return depths_.empty() ? Depth{unknown, HUGE_VAL} : depths_.back();
}

void RegionDepth::append_planes(const Vec3& point, double reach, std::vector<TangentPlane>& planes) {
    at(point);
    const auto add = [&](const DistanceBounds::Piece& piece, double sign, bool is_near, bool is_sure) {
        const double steep = length(piece.slope);
        if (!(steep > 0)) return;
        const Vec3 normal = sign / steep * piece.slope;
        planes.push_back({point - sign / steep * piece.distance * normal, normal, is_near, is_near && is_sure});
    };
    const auto add_solid = [&](std::uint32_t solid, bool inside, bool is_near) {
        if (!bounds_.has(solid)) return;
        pieces_.clear();
        bounds_.append_pieces(solid, point, reach, pieces_);
        if (pieces_.empty()) return;
        if (inside) {
            for (const DistanceBounds::Piece& piece : pieces_) add(piece, 1, is_near, piece.is_convex);
            return;
        }
        const auto farthest = std::ranges::max_element(pieces_, {}, &DistanceBounds::Piece::distance);
        add(*farthest, -1, is_near && pieces_.size() == 1, farthest->is_plane);
    };
    const auto collect = [&](const auto& self, std::size_t i, bool inside, bool is_near) -> void {
        const FlatTree::Node& node = nodes_[i];
        if (node.op == Operator::leaf) return add_solid(node.solid, inside, is_near);
        const bool is_xor = node.op == Operator::xor_;
        const bool is_all = is_xor || node.op == Operator::not_ ||
                            inside == (node.op == Operator::intersection || node.op == Operator::difference);
        // Operands of which one is enough: the deepest counts, alone if the others are out of reach.
        struct Operand {
            std::size_t node;
            bool inside;
            double in, out;
        };
        const auto operand = [&](std::size_t k) {
            const bool is_removed = node.op == Operator::difference && begins_[k] != begins_[i];
            const bool in =
                is_xor ? depths_[k].in > depths_[k].out : inside != (is_removed || node.op == Operator::not_);
            return in ? Operand{k, in, depths_[k].in, depths_[k].out} : Operand{k, in, depths_[k].out, depths_[k].in};
        };
        Operand best{i, true, unknown, 0};
        std::size_t near = 0;
        for_operands(i, [&](std::size_t k) {
            const Operand o = operand(k);
            if (is_all) return self(self, k, o.inside, is_near && (!is_xor || o.in >= reach));
            near += o.out < reach;
            if (best.node == i || o.in > best.in) best = o;
        });
        if (best.node != i) self(self, best.node, best.inside, is_near && near <= 1);
    };
    if (!depths_.empty()) collect(collect, depths_.size() - 1, true, true);
}

void RegionDepth::append_supports(const Vec3& point, std::vector<TangentPlane>& planes) {
    const auto add_solid = [&](std::uint32_t solid) {
        if (!bounds_.has(solid)) return;
        pieces_.clear();
        bounds_.append_pieces(solid, point, HUGE_VAL, pieces_);
        for (std::size_t k = 0, count = pieces_.size(); k < count; ++k) {
            if (!pieces_[k].is_convex) continue;
            // A convex function is nowhere less than its tangent plane's; the nearer to the surface, the less it lies.
            Vec3 at = point;
            DistanceBounds::Piece piece = pieces_[k];
            constexpr int steps = 4;
            for (int step = 0; step < steps && dot(piece.slope, piece.slope) > 0; ++step) {
                at = at - piece.distance / dot(piece.slope, piece.slope) * piece.slope;
                pieces_.resize(count);
                bounds_.append_pieces(solid, at, HUGE_VAL, pieces_);
                piece = pieces_[count + k];
            }
            const double steep = length(piece.slope);
            const Box& box = scene_.solid_boxes[solid];
            if (!(steep > 1e-3) || std::abs(piece.distance) > 1e-3 * length(box.high - box.low)) continue;
            const Vec3 normal = 1 / steep * piece.slope;
            planes.push_back({at - piece.distance / steep * normal, normal});
        }
    };
    const auto collect = [&](const auto& self, std::size_t i) -> void {
        const FlatTree::Node& node = nodes_[i];
        if (node.op == Operator::leaf) return add_solid(node.solid);
        const bool is_difference = node.op == Operator::difference;
        if (node.op == Operator::not_ || (node.op != Operator::intersection && !is_difference && node.arity != 1))
            return;
        for_operands(i, [&](std::size_t k) {
            if (!is_difference || begins_[k] == begins_[i]) self(self, k);
        });
    };
    if (!depths_.empty()) collect(collect, depths_.size() - 1);
}

/// With weights w of 0 or more whose sum is 1 and sum(w n) = 0, the ball's radius is at most sum(w distance), since it
/// is at most each distance from its centre, and sum(w distance) is the same from every point. Four planes are enough
/// for the best weights; all sets of four are tried.
double diameter_behind(const std::vector<TangentPlane>& planes, const Vec3& near, double reach) {
    double least = std::numeric_limits<double>::infinity();
    const std::size_t count = planes.size();
    for (std::size_t a = 0; a < count; ++a)
        for (std::size_t b = a + 1; b < count; ++b) {
            const Vec3 ab = cross(planes[a].normal, planes[b].normal);
            for (std::size_t c = b + 1; c < count; ++c) {
                const Vec3 &na = planes[a].normal, &nb = planes[b].normal, &nc = planes[c].normal;
                const Vec3 bc = cross(nb, nc), ac = cross(na, nc);
                const double abc = dot(ab, nc);
                for (std::size_t d = c + 1; d < count; ++d) {
                    const Vec3& nd = planes[d].normal;
                    double w[] = {dot(bc, nd), -dot(ac, nd), dot(ab, nd), -abc};
                    const double sum = w[0] + w[1] + w[2] + w[3];
                    if (!(std::abs(sum) > 1e-9)) continue;
                    for (double& x : w) x /= sum;
                    if (std::min({w[0], w[1], w[2], w[3]}) < -1e-12) continue;
                    for (double& x : w) x = std::max(x, 0.0);
                    const Vec3 rest = w[0] * na + w[1] * nb + w[2] * nc + w[3] * nd;
                    const double radius = w[0] * planes[a].distance(near) + w[1] * planes[b].distance(near) +
                                          w[2] * planes[c].distance(near) + w[3] * planes[d].distance(near);
                    const double total = w[0] + w[1] + w[2] + w[3];
                    least = std::min(least, 2 * (radius + length(rest) * reach) / total);
                }
            }
        }
    // Rounding: of distances to planes, and of the point's numbers.
    return least + 1e-12 * reach + 1e-15 * length(near);
}

}  // namespace csgrt::analysis
