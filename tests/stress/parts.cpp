#include "parts.hpp"

#include <cmath>
#include <initializer_list>
#include <string>
#include <vector>

#include "build.hpp"

namespace csgrt::stress {
namespace {

constexpr double pitch = 20;  // millimetres from part to part
constexpr std::uint32_t group_size = 16;
constexpr std::uint32_t mean_solids = 4;  // of a part

class Writer {
public:
    Writer(std::uint32_t solids, std::uint64_t seed) : left_(solids), random_(seed) {
        const double parts = std::ceil(static_cast<double>(solids) / mean_solids);
        side_ = static_cast<std::uint32_t>(std::ceil(std::sqrt(parts)));
        scene_.title = "parts: " + std::to_string(solids) + " solids";
        scene_.top = {"all"};
    }

    Scene write() {
        std::vector<Tree> groups, members;
        plate();
        groups.push_back(leaf("plate"));
        for (std::uint32_t number = 0; left_ > 0; ++number) {
            const std::string name = "p" + std::to_string(number);
            part(name);
            members.push_back(leaf(name, place(number)));
            if (members.size() < group_size && left_ > 0) continue;
            groups.push_back(leaf(combination("g" + std::to_string(number / group_size), members)));
            members.clear();
        }
        combination("all", groups);
        return std::move(scene_);
    }

private:
    double between(double low, double high) { return random_.between(low, high); }

    Tree solid(Shape shape) {
        --left_;
        const std::string name = "s" + std::to_string(scene_.objects.size());
        scene_.objects.push_back(Solid{name, std::move(shape), {}});
        return leaf(name);
    }

    std::string combination(const std::string& name, const std::vector<Tree>& members) {
        Combination all;
        all.name = name;
        all.tree = operate(Operator::union_, members);
        scene_.objects.push_back(std::move(all));
        return name;
    }

    void region(const std::string& name, Tree tree) {
        Combination region;
        region.name = name;
        region.tree = std::move(tree);
        region.region = true;
        region.region_id = 1000 + static_cast<int>(scene_.objects.size());
        const double red = between(0.3, 1), green = between(0.3, 1), blue = between(0.3, 1);
        region.color = Vec3{red, green, blue};
        scene_.objects.push_back(std::move(region));
    }

    void plate() {
        const double end = pitch * side_;
        region("plate", solid(box({0, 0, -2}, {end, end, 0})));
    }

    /// By number, in rows; turned by an angle whose sine and cosine are fractions.
    Matrix place(std::uint32_t number) {
        Matrix m = identity;
        if (random_.below(4) == 0) {
            const int w = random_.whole(1, 9), z = random_.whole(1, 9);
            m = stress::rotation(w, 0, 0, z);
        }
        m[3] = pitch * (number % side_ + 0.5);
        m[7] = pitch * (number / side_ + 0.5);
        return m;
    }

    void part(const std::string& name) {
        if (left_ < 3) return region(name, solid(ball({0, 0, 5}, between(4, 8))));
        switch (left_ < 5 ? 0 : random_.below(4)) {
            case 0:
                return bushing(name);
            case 1:
                return tile(name);
            case 2:
                return rounded(name);
            default:
                return flange(name);
        }
    }

    /// A cylinder with a bead, bored through.
    void bushing(const std::string& name) {
        const double r = between(4, 7), h = between(6, 16), tube = between(0.8, 2);
        const Tree body = solid(cylinder({0, 0, 0}, {0, 0, h}, r));
        const Tree bead = solid(Tor{{0, 0, between(tube, h - tube)}, {0, 0, 1}, r, tube});
        const Tree bore = solid(cylinder({0, 0, -1}, {0, 0, h + 2}, between(0.4, 0.8) * r));
        region(name, operate(Operator::difference, {operate(Operator::union_, {body, bead}), bore}));
    }

    /// A box with two drilled holes, one of them countersunk by a ball.
    void tile(const std::string& name) {
        const double x = between(5, 9), y = between(5, 9), z = between(4, 14), at = between(1, x - 3);
        const Tree body = solid(box({-x, -y, 0}, {x, y, z}));
        const Tree upright = solid(cylinder({at, 0, -1}, {0, 0, z + 2}, between(0.8, 1.8)));
        const Tree sink = solid(ball({at, 0, z}, between(2, 3)));
        const Tree across = solid(cylinder({-x / 2, -y - 1, z / 2}, {0, 2 * y + 2, 0}, between(0.5, 0.3 * z)));
        region(name, operate(Operator::difference, {body, upright, sink, across}));
    }

    /// A box rounded by a ball, with a slot and a hole.
    void rounded(const std::string& name) {
        const double x = between(5, 8), z = between(8, 14);
        const Tree body = solid(box({-x, -x, 0}, {x, x, z}));
        const Tree round = solid(ball({0, 0, z / 3}, between(1.15, 1.35) * x));
        const Tree slot = solid(box({-1, -9, between(0.4, 0.6) * z}, {1, 9, z + 1}));
        const Tree hole = solid(cylinder({-9, 0, z / 4}, {18, 0, 0}, between(0.5, 1.5)));
        region(name, operate(Operator::difference, {operate(Operator::intersection, {body, round}), slot, hole}));
    }

    /// A disc with a neck, a fillet of a torus where they meet, bored through and with a key's slot.
    void flange(const std::string& name) {
        const double r = between(6, 9), t = between(1.5, 3), neck = between(0.4, 0.6) * r, h = between(8, 18);
        const Tree disc = solid(cylinder({0, 0, 0}, {0, 0, t}, r));
        const Tree shaft = solid(cylinder({0, 0, 0}, {0, 0, h}, neck));
        const Tree fillet = solid(Tor{{0, 0, t}, {0, 0, 1}, neck, between(0.5, 1)});
        const Tree bore = solid(cylinder({0, 0, -1}, {0, 0, h + 2}, between(0.5, 0.8) * neck));
        const Tree key = solid(box({-0.5, 0, -1}, {0.5, neck, h + 1}));
        region(name, operate(Operator::difference, {operate(Operator::union_, {disc, shaft, fillet}), bore, key}));
    }

    Scene scene_;
    std::uint32_t left_, side_ = 0;
    Random random_;
};

}  // namespace

Scene scene_of_parts(std::uint32_t solids, std::uint64_t seed) { return Writer(solids, seed).write(); }

}  // namespace csgrt::stress
