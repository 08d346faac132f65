// What families are built of: vectors, matrices, trees, and a scene that grows.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "families.hpp"
#include "random.hpp"

namespace csgrt::stress {

inline Vec3 operator+(const Vec3& a, const Vec3& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
inline Vec3 operator-(const Vec3& a, const Vec3& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
inline Vec3 operator*(double s, const Vec3& a) { return {s * a.x, s * a.y, s * a.z}; }
inline double dot(const Vec3& a, const Vec3& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline Vec3 cross(const Vec3& a, const Vec3& b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
Vec3 unit(const Vec3& a);
/// Some unit vector across `a`.
Vec3 any_across(const Vec3& a);

Matrix translation(const Vec3& by);
Matrix scaling(double by);
/// The rotation of the quaternion of four whole numbers, not all 0; exact where their squares' sum is a power of 2.
Matrix rotation(int w, int x, int y, int z);
/// A rotation about some axis by some angle, none of them 0.
Matrix rotation(Random& random);
/// b first.
Matrix operator*(const Matrix& a, const Matrix& b);
Vec3 moved_point(const Matrix& m, const Vec3& p);
Vec3 moved_direction(const Matrix& m, const Vec3& d);

Tree leaf(const std::string& object, const Matrix& matrix = identity);
Tree operate(Operator op, const std::vector<Tree>& operands);

Ell ball(const Vec3& center, double radius);
Tgc cylinder(const Vec3& base, const Vec3& height, double radius);
Tgc cone(const Vec3& base, const Vec3& height, double base_radius, double top_radius);
Arb box(const Vec3& low, const Vec3& high);

/// Adds to a StressScene.
class Builder {
public:
    Builder(const std::string& family, std::uint64_t seed, std::size_t times);

    /// The name of the new solid.
    std::string solid(Shape shape);
    /// A combination that is no region, to be used by others.
    std::string combination(Tree tree);
    /// A region, and an object to be rendered. `air`: its air code; air is kept in a scene that has some.
    void region(Tree tree, int air = 0, Fastgen fastgen = Fastgen::none);
    /// Origin and direction.
    void ray(const Vec3& origin, const Vec3& direction) { made_.rays.push_back({origin, direction}); }
    /// A ray through a point, from `back` lengths of `direction` before it.
    void ray_through(const Vec3& point, const Vec3& direction, double back);
    void known(std::vector<Stretch> stretches) { made_.known.push_back(std::move(stretches)); }

    /// How many rays to make where a scene has `usual` ones. They are made last: the first are the same, however many.
    int rays(int usual) const { return usual * static_cast<int>(times_); }

    Random& random() { return random_; }
    StressScene take() { return std::move(made_); }

private:
    StressScene made_;
    Random random_;
    std::size_t times_;
};

/// A solid of any of the simple types within 12 or so of the origin, at least 2 thick.
std::string some_solid(Builder& to);
/// A tree over the solids, each used once: operators at random, complements only where something bounds them.
Tree some_tree(const std::vector<std::string>& solids, Random& random);

/// Rays through a ball around the origin: from all sides, along the axes, from inside, with directions of other
/// lengths.
void some_rays(Builder& to, double radius, int count);

// The families: each makes one scene.
StressScene coplanar(std::uint64_t seed, std::size_t times);
StressScene coincident(std::uint64_t seed, std::size_t times);
StressScene tangent(std::uint64_t seed, std::size_t times);
StressScene edges(std::uint64_t seed, std::size_t times);
StressScene far_origin(std::uint64_t seed, std::size_t times);
StressScene scale(std::uint64_t seed, std::size_t times);
StressScene slivers(std::uint64_t seed, std::size_t times);
StressScene degenerate(std::uint64_t seed, std::size_t times);
StressScene deep_trees(std::uint64_t seed, std::size_t times);
StressScene depth(std::uint64_t seed, std::size_t times);
StressScene overlaps(std::uint64_t seed, std::size_t times);
StressScene nested(std::uint64_t seed, std::size_t times);
StressScene pinch(std::uint64_t seed, std::size_t times);
/// Its seeds go through so many kinds of solids.
inline constexpr std::uint64_t pinch_kinds = 13;

}  // namespace csgrt::stress
