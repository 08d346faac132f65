// A hierarchy of bounding spheres. A line skips what its spheres say that it misses for certain, and nothing else.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "bounding_sphere.hpp"

namespace csgrt::oracle {

class SphereTree {
public:
    SphereTree() = default;
    explicit SphereTree(std::vector<BoundingSphere> spheres) : spheres_(std::move(spheres)) {
        order_.resize(spheres_.size());
        for (std::size_t i = 0; i < order_.size(); ++i) order_[i] = static_cast<std::uint32_t>(i);
        if (!order_.empty()) build(0, order_.size());
    }

    /// Calls `call` with the index of each sphere that the line may meet, or come within `near` of.
    template <class Call>
    void each(const Vec3& o, const Vec3& d, double near, const Call& call) const {
        for (std::size_t n = 0; n < nodes_.size();) {
            const Node& node = nodes_[n];
            if (node.sphere.is_missed_by(o, d, near)) {
                n = node.next;
                continue;
            }
            for (std::size_t i = node.first; i < node.first + node.count; ++i)
                if (!spheres_[order_[i]].is_missed_by(o, d, near)) call(order_[i]);
            ++n;
        }
    }
    const std::vector<BoundingSphere>& spheres() const { return spheres_; }

private:
    /// In depth-first order: a node's children follow it, and `next` is the index behind the last of them.
    struct Node {
        BoundingSphere sphere;
        std::size_t first = 0, count = 0, next = 0;  ///< `count` is 0 but in leaves
    };

    static double along(const Vec3& v, int axis) { return axis == 0 ? v.x : axis == 1 ? v.y : v.z; }

    void build(std::size_t first, std::size_t last) {
        const std::size_t here = nodes_.size();
        nodes_.emplace_back();
        Vec3 low = spheres_[order_[first]].center, high = low;
        for (std::size_t i = first; i < last; ++i) {
            const Vec3& c = spheres_[order_[i]].center;
            low = {std::min(low.x, c.x), std::min(low.y, c.y), std::min(low.z, c.z)};
            high = {std::max(high.x, c.x), std::max(high.y, c.y), std::max(high.z, c.z)};
        }
        BoundingSphere sphere{
            {low.x + 0.5 * (high.x - low.x), low.y + 0.5 * (high.y - low.y), low.z + 0.5 * (high.z - low.z)}, 0};
        for (std::size_t i = first; i < last; ++i) {
            const BoundingSphere& one = spheres_[order_[i]];
            const double x = one.center.x - sphere.center.x, y = one.center.y - sphere.center.y,
                         z = one.center.z - sphere.center.z;
            // Larger by a thousandth; is_missed_by allows for the rounding of coordinates.
            sphere.radius = std::max(sphere.radius, 1.001 * (std::sqrt(x * x + y * y + z * z) + one.radius));
            sphere.widening = std::max(sphere.widening, one.widening);
        }
        nodes_[here].sphere = sphere;
        constexpr std::size_t leaf = 4;
        if (last - first <= leaf) {
            nodes_[here].first = first;
            nodes_[here].count = last - first;
        } else {
            const Vec3 size{high.x - low.x, high.y - low.y, high.z - low.z};
            const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
            const std::size_t middle = first + (last - first) / 2;
            const auto at = [&](std::size_t i) { return order_.begin() + static_cast<std::ptrdiff_t>(i); };
            std::nth_element(at(first), at(middle), at(last), [&](std::uint32_t a, std::uint32_t b) {
                return along(spheres_[a].center, axis) < along(spheres_[b].center, axis);
            });
            build(first, middle);
            build(middle, last);
        }
        nodes_[here].next = nodes_.size();
    }

    std::vector<BoundingSphere> spheres_;
    std::vector<std::uint32_t> order_;
    std::vector<Node> nodes_;
};

}  // namespace csgrt::oracle
