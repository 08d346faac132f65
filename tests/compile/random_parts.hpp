// Random parts: groups of regions of solids of all types, placed so that planes coincide and solids touch.
#pragma once

#include <random>

#include "compile/model.hpp"
#include "integration/samples.hpp"

namespace csgrt::test {

class RandomParts {
public:
    explicit RandomParts(unsigned seed) : random_(seed) {}

    unsigned below(std::size_t count) { return static_cast<unsigned>(random_() % static_cast<unsigned>(count)); }

    Matrix some_matrix() {
        Matrix m = moved(step(), step(), step());
        if (below(3) == 0) m = {0, -1, 0, step(), 1, 0, 0, step(), 0, 0, 1, step(), 0, 0, 0, 1};
        if (below(6) == 0) m = {0.6, -0.8, 0, step(), 0.8, 0.6, 0, step(), 0, 0, 1.25, step(), 0, 0, 0, 1};
        if (below(12) == 0) m[3] += 1e-11;
        if (below(12) == 0) m[11] = -0.0;
        if (below(40) == 0) m[7] += 60;  // out of the model's sphere
        return m;
    }

    /// A sample of any type. A half-space is never compiled by itself, and a metaball's box takes long, so they are
    /// rare.
    Solid some_solid() {
        static const Scene all = scene_of_samples();
        for (;;) {
            const auto& sample = std::get<Solid>(all.objects[below(all.objects.size())]);
            const unsigned rare = std::holds_alternative<Half>(sample.shape)       ? 8
                                  : std::holds_alternative<Metaball>(sample.shape) ? 300
                                                                                   : 1;
            if (below(rare) == 0) return sample;
        }
    }

    Scene scene() {
        Scene made;
        std::vector<Object>& objects = made.objects;
        objects = {ball("far", {-40, -40, -40}), ball("farther", {40, 40, 40})};
        std::vector<std::string> solids;
        for (int i = 0; i < 8; ++i) {
            const Solid sample = some_solid();
            if (std::ranges::find(solids, sample.name) != solids.end()) continue;
            solids.push_back(sample.name);
            objects.push_back(sample);
        }
        std::vector<TreeNode> groups{leg("corners")};
        objects.push_back(region("corners", {leg("far"), leg("farther"), either}));
        for (int g = 0; g < 3; ++g) {
            std::vector<TreeNode> regions;
            for (unsigned r = 0; r <= below(4); ++r) {
                std::vector<TreeNode> nodes;
                for (unsigned s = 0; s <= below(3); ++s) {
                    nodes.push_back(leg(solids[below(solids.size())], some_matrix()));
                    if (s > 0) nodes.push_back(below(2) ? less : either);
                }
                std::string name = "r" + std::to_string(g) + std::to_string(r);
                objects.push_back(region(name, std::move(nodes)));
                regions.push_back(leg(name, some_matrix()));
            }
            regions.push_back(op(Operator::union_, static_cast<std::uint32_t>(regions.size())));
            const std::string name = "g" + std::to_string(g);
            objects.push_back(group(name, std::move(regions)));
            for (unsigned i = 0; i <= below(2); ++i) groups.push_back(leg(name, some_matrix()));
        }
        groups.push_back(op(Operator::union_, static_cast<std::uint32_t>(groups.size())));
        objects.push_back(group("all", std::move(groups)));
        objects.push_back(group("spare", {leg("g" + std::to_string(below(3)), some_matrix())}));
        return made;
    }

private:
    double step() { return 0.5 * static_cast<double>(below(13)) - 3; }

    std::mt19937 random_;
};

}  // namespace csgrt::test
