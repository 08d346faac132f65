// Surfaces that are one surface: faces in one plane, cylinders on one axis with one radius, and so on. Exactly, as
// numbers of a model on a grid are, or up to the rounding of the matrices that brought them there.
#include "build.hpp"

namespace csgrt::stress {
namespace {

/// How the solids get to their places.
enum class Frame {
    none,
    leaves,  ///< one matrix, on every leaf
    points,  ///< turned with their own numbers, each rounded by itself
    mixed    ///< some one way, some the other
};

class Placed {
public:
    explicit Placed(Builder& to, Frame frame) : to_(to), frame_(frame) {
        if (frame != Frame::none) matrix_ = translation({0.1, 0.2, 0.3}) * rotation(to.random());
    }

    Tree add(const Shape& shape) {
        const bool points = frame_ == Frame::points || (frame_ == Frame::mixed && to_.random().coin());
        if (frame_ == Frame::none) return leaf(to_.solid(shape));
        if (points) return leaf(to_.solid(moved(shape)));
        return leaf(to_.solid(shape), matrix_);
    }
    void ray_through(const Vec3& point, const Vec3& direction) {
        to_.ray_through(moved_point(matrix_, point), moved_direction(matrix_, direction), 30);
    }

private:
    Vec3 p(const Vec3& v) const { return moved_point(matrix_, v); }
    Vec3 d(const Vec3& v) const { return moved_direction(matrix_, v); }
    Shape moved(const Shape& shape) const {
        if (const auto* s = std::get_if<Ell>(&shape)) return Ell{p(s->v), d(s->a), d(s->b), d(s->c)};
        if (const auto* s = std::get_if<Tgc>(&shape)) return Tgc{p(s->v), d(s->h), d(s->a), d(s->b), d(s->c), d(s->d)};
        if (const auto* s = std::get_if<Tor>(&shape)) return Tor{p(s->v), d(s->h), s->r_a, s->r_h};
        if (const auto* s = std::get_if<Part>(&shape)) return Part{p(s->v), d(s->h), s->r_v, s->r_h};
        if (const auto* s = std::get_if<Epa>(&shape)) return Epa{p(s->v), d(s->h), d(s->a), s->r_1, s->r_2};
        if (const auto* s = std::get_if<Half>(&shape)) {
            const Vec3 n = unit(d(s->plane.normal));
            return Half{{n, dot(n, p(s->plane.distance * s->plane.normal))}};
        }
        Arb arb = std::get<Arb>(shape);
        for (Vec3& v : arb.vertices) v = p(v);
        return arb;
    }

    Builder& to_;
    Frame frame_;
    Matrix matrix_ = identity;
};

/// A tree over leaves, left to right.
Tree chain(std::vector<Tree> leaves, Random& random) {
    static constexpr Operator operators[] = {Operator::union_, Operator::difference, Operator::intersection,
                                             Operator::xor_,   Operator::difference, Operator::union_};
    Tree tree = leaves.front();
    for (std::size_t i = 1; i < leaves.size(); ++i) tree = operate(operators[random.below(6)], {tree, leaves[i]});
    return tree;
}

/// Regions of a few solids each, or the three that two solids make: only in the one, only in the other, in both.
void add_regions(Builder& to, const std::vector<Tree>& leaves) {
    Random& random = to.random();
    if (random.below(3) == 0) {
        const std::size_t half = leaves.size() / 2;
        const Tree a = chain({leaves.begin(), leaves.begin() + static_cast<std::ptrdiff_t>(half)}, random);
        const Tree b = chain({leaves.begin() + static_cast<std::ptrdiff_t>(half), leaves.end()}, random);
        to.region(operate(Operator::difference, {a, b}));
        to.region(operate(Operator::difference, {b, a}));
        to.region(operate(Operator::intersection, {a, b}));
        return;
    }
    for (std::size_t i = 0; i < leaves.size(); i += 3)
        to.region(chain({leaves.begin() + static_cast<std::ptrdiff_t>(i),
                         leaves.begin() + static_cast<std::ptrdiff_t>(std::min(i + 3, leaves.size()))},
                        random));
}

}  // namespace

/// Boxes, wedges, cylinders' ends and half-spaces on a grid of planes.
StressScene coplanar(std::uint64_t seed, std::size_t times) {
    Builder to("coplanar", seed, times);
    Random& random = to.random();
    const double step = seed % 3 == 0 ? 1 : seed % 3 == 1 ? 0.1 : 12.7;
    Placed placed(to, static_cast<Frame>(seed % 4));
    const auto pair = [&](double& low, double& high) {
        const int a = random.whole(-2, 1), b = random.whole(a + 1, 2);
        low = a * step;
        high = b * step;
    };
    std::vector<Tree> leaves;
    const int count = random.whole(3, 8);
    for (int i = 0; i < count; ++i) {
        Vec3 low, high;
        pair(low.x, high.x);
        pair(low.y, high.y);
        pair(low.z, high.z);
        switch (i == 0 ? 0 : random.below(8)) {
            case 5:
                leaves.push_back(placed.add(cylinder({0.5 * step, 0, low.z}, {0, 0, high.z - low.z}, 1.75 * step)));
                break;
            case 6: {  // a wedge: two of its edges are one
                Arb wedge = box(low, high);
                wedge.vertices[6] = wedge.vertices[5];
                wedge.vertices[7] = wedge.vertices[4];
                leaves.push_back(placed.add(wedge));
                break;
            }
            case 7: {  // what lies on one side of a plane of the grid, within a box
                const Vec3 n = random.axis();
                const Tree half = placed.add(Half{{n, random.whole(-1, 1) * step}});
                leaves.push_back(operate(Operator::intersection, {placed.add(box(low, high)), half}));
                break;
            }
            default:
                leaves.push_back(placed.add(box(low, high)));
                break;
        }
    }
    add_regions(to, leaves);
    for (int i = 0; i < to.rays(60); ++i) {
        // Through a face of the grid, away from its edges.
        const auto between_lines = [&] {
            const int cell = random.whole(-2, 1);
            return (cell + random.between(0.1, 0.9)) * step;
        };
        Vec3 point{between_lines(), between_lines(), between_lines()};
        const int across = random.whole(0, 2);
        (across == 0 ? point.x : across == 1 ? point.y : point.z) = random.whole(-2, 2) * step;
        placed.ray_through(point, step * (i % 3 == 0 ? random.axis() : random.slanted()));
    }
    return to.take();
}

/// Solids of revolution about one axis, with few radii, each given in several ways.
StressScene coincident(std::uint64_t seed, std::size_t times) {
    Builder to("coincident", seed, times);
    Random& random = to.random();
    Placed placed(to, static_cast<Frame>(seed % 4));
    std::vector<Tree> leaves;
    const int count = random.whole(2, 6);
    // Few kinds in one scene, so that they meet.
    const std::uint32_t kinds[2] = {random.below(6), random.below(6)};
    for (int i = 0; i < count; ++i) {
        const double bottom = random.whole(-3, 0), top = random.whole(1, 3);
        // The axes across z, and the way along it, are free.
        const int w = random.whole(0, 5), k = w == 0 ? 0 : random.whole(1, 5);
        const Matrix turn = w == 0 ? identity : rotation(w, 0, 0, k);
        const Vec3 x = moved_direction(turn, {1, 0, 0}), y = moved_direction(turn, {0, 1, 0});
        const bool upward = random.coin();
        switch (kinds[random.below(2)]) {
            case 0: {
                const double r = random.whole(2, 3);
                leaves.push_back(placed.add(Ell{{0, 0, 0}, r * x, r * y, {0, 0, upward ? r : -r}}));
                break;
            }
            case 1: {
                const double r = random.whole(1, 2);
                const Vec3 v{0, 0, upward ? bottom : top}, h{0, 0, upward ? top - bottom : bottom - top};
                leaves.push_back(placed.add(Tgc{v, h, r * x, r * y, r * x, r * y}));
                break;
            }
            case 2: {  // pieces of one cone, of radius 2 - z / 4
                const double at_bottom = 2 - bottom / 4, at_top = 2 - top / 4;
                leaves.push_back(placed.add(
                    Tgc{{0, 0, bottom}, {0, 0, top - bottom}, at_bottom * x, at_bottom * y, at_top * x, at_top * y}));
                break;
            }
            case 3:
                leaves.push_back(placed.add(Tor{{0, 0, 0}, {0, 0, upward ? 1.0 : -1.0}, 3, 1}));
                if (random.coin())
                    leaves.back() = operate(Operator::intersection,
                                            {leaves.back(), placed.add(box({-5, -5, bottom}, {5, 5, top}))});
                break;
            case 4:
                leaves.push_back(placed.add(Part{{0, 0, bottom}, {0, 0, top - bottom}, 2, 2}));
                if (random.coin())
                    leaves.push_back(placed.add(Tgc{{0, 0, bottom}, {0, 0, top - bottom}, 2 * x, 2 * y, 2 * x, 2 * y}));
                break;
            default: {  // pieces of one paraboloid, of radius 3 at 9 below its apex
                const double down = random.whole(1, 3);
                leaves.push_back(placed.add(Epa{{0, 0, 4 - down * down}, {0, 0, down * down}, x, down, down}));
                break;
            }
        }
    }
    add_regions(to, leaves);
    for (int i = 0; i < to.rays(60); ++i) {
        const Vec3 point{random.between(-2.5, 2.5), random.between(-2.5, 2.5), random.between(-3, 3)};
        placed.ray_through(point, i % 4 == 0 ? random.axis() : random.slanted());
    }
    return to.take();
}

}  // namespace csgrt::stress
