#include "build.hpp"

namespace csgrt::stress {

Vec3 unit(const Vec3& a) { return 1 / std::sqrt(dot(a, a)) * a; }

Vec3 any_across(const Vec3& a) {
    const double x = std::abs(a.x), y = std::abs(a.y), z = std::abs(a.z);
    if (x <= y && x <= z) return unit(cross(a, {1, 0, 0}));
    return unit(cross(a, y <= z ? Vec3{0, 1, 0} : Vec3{0, 0, 1}));
}

Matrix translation(const Vec3& by) { return {1, 0, 0, by.x, 0, 1, 0, by.y, 0, 0, 1, by.z, 0, 0, 0, 1}; }

Matrix scaling(double by) { return {by, 0, 0, 0, 0, by, 0, 0, 0, 0, by, 0, 0, 0, 0, 1}; }

Matrix rotation(int w, int x, int y, int z) {
    const double n = w * w + x * x + y * y + z * z;
    return {(w * w + x * x - y * y - z * z) / n,
            2 * (x * y - w * z) / n,
            2 * (x * z + w * y) / n,
            0,
            2 * (x * y + w * z) / n,
            (w * w - x * x + y * y - z * z) / n,
            2 * (y * z - w * x) / n,
            0,
            2 * (x * z - w * y) / n,
            2 * (y * z + w * x) / n,
            (w * w - x * x - y * y + z * z) / n,
            0,
            0,
            0,
            0,
            1};
}

Matrix rotation(Random& random) {
    const int w = random.whole(1, 9), x = random.whole(1, 9), y = random.whole(1, 9), z = random.whole(-9, -1);
    return rotation(w, x, y, z);
}

Matrix operator*(const Matrix& a, const Matrix& b) {
    Matrix m{};
    for (std::size_t row = 0; row < 4; ++row)
        for (std::size_t column = 0; column < 4; ++column)
            for (std::size_t k = 0; k < 4; ++k) m[4 * row + column] += a[4 * row + k] * b[4 * k + column];
    return m;
}

Vec3 moved_direction(const Matrix& m, const Vec3& d) {
    return {m[0] * d.x + m[1] * d.y + m[2] * d.z, m[4] * d.x + m[5] * d.y + m[6] * d.z,
            m[8] * d.x + m[9] * d.y + m[10] * d.z};
}
Vec3 moved_point(const Matrix& m, const Vec3& p) { return moved_direction(m, p) + Vec3{m[3], m[7], m[11]}; }

Tree leaf(const std::string& object, const Matrix& matrix) { return {{{Operator::leaf, 0, object, matrix, {}}}}; }

Tree operate(Operator op, const std::vector<Tree>& operands) {
    Tree tree;
    for (const Tree& operand : operands)
        tree.nodes.insert(tree.nodes.end(), operand.nodes.begin(), operand.nodes.end());
    tree.nodes.push_back({op, static_cast<std::uint32_t>(operands.size()), {}, identity, {}});
    return tree;
}

Ell ball(const Vec3& center, double radius) { return {center, {radius, 0, 0}, {0, radius, 0}, {0, 0, radius}}; }

Tgc cone(const Vec3& base, const Vec3& height, double base_radius, double top_radius) {
    const Vec3 a = any_across(height), b = unit(cross(height, a));
    return {base, height, base_radius * a, base_radius * b, top_radius * a, top_radius * b};
}

Tgc cylinder(const Vec3& base, const Vec3& height, double radius) { return cone(base, height, radius, radius); }

Arb box(const Vec3& low, const Vec3& high) {
    return {{{{low.x, low.y, low.z},
              {high.x, low.y, low.z},
              {high.x, high.y, low.z},
              {low.x, high.y, low.z},
              {low.x, low.y, high.z},
              {high.x, low.y, high.z},
              {high.x, high.y, high.z},
              {low.x, high.y, high.z}}}};
}

// FNV-1a of the family's name, so that equal seeds of two families have nothing in common.
static std::uint64_t mixed(const std::string& family, std::uint64_t seed) {
    std::uint64_t hash = 14695981039346656037u;
    for (const char c : family) hash = (hash ^ static_cast<unsigned char>(c)) * 1099511628211u;
    return Random(hash ^ seed).next();
}

Builder::Builder(const std::string& family, std::uint64_t seed, std::size_t times)
    : random_(mixed(family, seed)), times_(times) {
    made_.family = family;
    made_.seed = seed;
    made_.scene.title = "stress: " + family + " " + std::to_string(seed);
}

std::string Builder::solid(Shape shape) {
    const std::string name = "s" + std::to_string(made_.scene.objects.size());
    made_.scene.objects.push_back(Solid{name, std::move(shape), {}});
    return name;
}

std::string Builder::combination(Tree tree) {
    Combination c;
    c.name = "c" + std::to_string(made_.scene.objects.size());
    c.tree = std::move(tree);
    made_.scene.objects.push_back(c);
    return c.name;
}

void Builder::region(Tree tree, int air, Fastgen fastgen) {
    Combination c;
    c.fastgen = fastgen;
    c.air = air;
    made_.air = made_.air || air != 0;
    c.name = "r" + std::to_string(made_.scene.objects.size());
    c.tree = std::move(tree);
    c.region = true;
    c.region_id = static_cast<int>(made_.objects.size()) + 1;
    made_.objects.push_back(c.name);
    made_.scene.top.push_back(c.name);
    made_.scene.objects.push_back(std::move(c));
}

void Builder::ray_through(const Vec3& point, const Vec3& direction, double back) {
    ray(point - back * direction, direction);
}

std::string some_solid(Builder& to) {
    Random& random = to.random();
    const Vec3 z = random.direction(), x = any_across(z), y = cross(z, x), at = 5 * random.in_cube();
    const double p = random.between(2, 6), q = random.between(2, 6), r = random.between(2, 6);
    switch (random.below(8)) {
        case 0:
            return to.solid(ball(at, p));
        case 1:
            return to.solid(Ell{at, p * x, q * y, r * z});
        case 2:
            return to.solid(cylinder(at, 2 * p * z, q));
        case 3:
            return to.solid(Tgc{at, 2 * p * z, q * x, r * y, 0.5 * q * x, 0.25 * r * y});
        case 4:
            return to.solid(Tor{at, z, 6, random.between(1, 3)});
        case 5:
            return to.solid(Ehy{at, 2 * p * z, x, q, r, 2});
        case 6:
            return to.solid(box({-p, -q, -r}, {r, p, q}));
        default: {
            // A slanted frustum: its top is its base, half as large.
            const Vec3 base[4] = {-p * x - q * y, r * x - q * y, q * x + r * y, -p * x + p * y};
            Arb arb;
            for (std::size_t i = 0; i < 4; ++i) {
                arb.vertices[i] = at + base[i];
                arb.vertices[i + 4] = at + 4 * z + x + 0.5 * base[i];
            }
            return to.solid(arb);
        }
    }
}

Tree some_tree(const std::vector<std::string>& solids, Random& random) {
    std::vector<Tree> trees;
    for (const std::string& solid : solids) trees.push_back(leaf(solid));
    while (trees.size() > 1) {
        const std::size_t at = random.below(static_cast<std::uint32_t>(trees.size()) - 1);
        const Tree &a = trees[at], &b = trees[at + 1];
        Tree joined;
        switch (random.below(6)) {
            case 0:
                joined = operate(Operator::intersection, {a, b});
                break;
            case 1:
                joined = operate(Operator::xor_, {a, b});
                break;
            case 2:
                joined = operate(Operator::intersection, {a, operate(Operator::not_, {b})});
                break;
            case 3:
                joined = operate(Operator::difference, {a, b});
                break;
            default:
                joined = operate(Operator::union_, {a, b});
                break;
        }
        trees[at] = std::move(joined);
        trees.erase(trees.begin() + static_cast<std::ptrdiff_t>(at) + 1);
    }
    return trees.front();
}

void some_rays(Builder& to, double radius, int count) {
    Random& random = to.random();
    for (int i = 0; i < count; ++i) {
        const Vec3 through = 0.7 * radius * random.in_cube();
        const Vec3 d = i % 4 == 1 ? random.axis() : random.direction();
        const double length = i % 4 == 3 ? random.power_of_ten(-3, 3) : 1;
        to.ray(i % 4 == 2 ? through : through - 4 * radius * d, length * d);
    }
}

}  // namespace csgrt::stress
