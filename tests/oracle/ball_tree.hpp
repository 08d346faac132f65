// Balls about balls about things, so that what a line passes by need not be asked one by one. Nothing is skipped but
// what Reach says it passes by for certain.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "reach.hpp"

namespace csgrt::oracle {

class BallTree {
public:
    BallTree() = default;
    explicit BallTree(std::vector<Reach> balls) : balls_(std::move(balls)) {
        order_.resize(balls_.size());
        for (std::size_t i = 0; i < order_.size(); ++i) order_[i] = static_cast<std::uint32_t>(i);
        if (!order_.empty()) build(0, order_.size());
    }

    /// Calls for each ball that the line may come as near as `near` to.
    template <class Call>
    void each(const Vec3& o, const Vec3& d, double near, const Call& call) const {
        for (std::size_t n = 0; n < nodes_.size();) {
            const Node& node = nodes_[n];
            if (node.ball.is_passed_by(o, d, near)) {
                n = node.next;
                continue;
            }
            for (std::size_t i = node.first; i < node.first + node.count; ++i)
                if (!balls_[order_[i]].is_passed_by(o, d, near)) call(order_[i]);
            ++n;
        }
    }
    const std::vector<Reach>& balls() const { return balls_; }

private:
    /// In the order of a walk: a node's children follow it, and `next` is where those end.
    struct Node {
        Reach ball;
        std::size_t first = 0, count = 0, next = 0;  ///< only leaves count anything
    };

    static double along(const Vec3& v, int axis) { return axis == 0 ? v.x : axis == 1 ? v.y : v.z; }

    void build(std::size_t first, std::size_t last) {
        const std::size_t here = nodes_.size();
        nodes_.emplace_back();
        Vec3 low = balls_[order_[first]].center, high = low;
        for (std::size_t i = first; i < last; ++i) {
            const Vec3& c = balls_[order_[i]].center;
            low = {std::min(low.x, c.x), std::min(low.y, c.y), std::min(low.z, c.z)};
            high = {std::max(high.x, c.x), std::max(high.y, c.y), std::max(high.z, c.z)};
        }
        Reach ball{{low.x + 0.5 * (high.x - low.x), low.y + 0.5 * (high.y - low.y), low.z + 0.5 * (high.z - low.z)}, 0};
        for (std::size_t i = first; i < last; ++i) {
            const Reach& one = balls_[order_[i]];
            const double x = one.center.x - ball.center.x, y = one.center.y - ball.center.y,
                         z = one.center.z - ball.center.z;
            // A thousandth more than it takes; what coordinates are rounded by is_passed_by allows for.
            ball.radius = std::max(ball.radius, 1.001 * (std::sqrt(x * x + y * y + z * z) + one.radius));
            ball.widening = std::max(ball.widening, one.widening);
        }
        nodes_[here].ball = ball;
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
                return along(balls_[a].center, axis) < along(balls_[b].center, axis);
            });
            build(first, middle);
            build(middle, last);
        }
        nodes_[here].next = nodes_.size();
    }

    std::vector<Reach> balls_;
    std::vector<std::uint32_t> order_;
    std::vector<Node> nodes_;
};

}  // namespace csgrt::oracle
