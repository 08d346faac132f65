// BRL-CAD's own models: as many solids and regions as its library counts, the same paths, the same box.
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <set>
#include <sstream>

#include <csgrt/scene_io.hpp>

#include "catch.hpp"
#include "compile/bounds/bounds.hpp"
#include "compile/flatten/flatten.hpp"
#include "compile/linear.hpp"
#include "compile/regions/linearize.hpp"
#include "integration/region_paths.hpp"
#include "integration/scenes.hpp"

using namespace csgrt;

namespace {

/// What a set of truth says of its model.
struct Truth {
    std::size_t solids = 0, regions = 0;
    double box[6] = {};
    std::set<std::string> paths;  ///< of the regions that a ray hit
};

Truth read_truth(const std::string& file) {
    Truth truth;
    std::FILE* pipe = popen(("gzip -dc '" + file + "'").c_str(), "r");
    REQUIRE(pipe != nullptr);
    char* line = nullptr;
    std::size_t capacity = 0;
    while (getline(&line, &capacity, pipe) > 0) {
        std::istringstream words(line);
        std::string word;
        if (line[0] == '/') {
            words >> word;
            truth.paths.insert(word);
        } else if (line[0] == '#') {
            words >> word >> word;
            if (word == "box")
                for (double& side : truth.box) words >> side;
            if (word == "rays") words >> word >> word >> truth.solids >> word >> truth.regions;
        }
    }
    std::free(line);
    REQUIRE(pclose(pipe) == 0);
    return truth;
}

/// BRL-CAD looks for an identical solid only while a solid has fewer than 100 instances. As many as it then counts:
std::size_t solids_as_brlcad_counts(const FlatScene& flat) {
    std::map<std::uint32_t, int> uses;
    std::set<std::uint32_t> seen;
    std::size_t count = 0;
    for (const FlatRegion& region : flat.regions) {
        for (const FlatTree::Node& node : region.tree.nodes) {
            // A pipe or a cline is one solid there.
            if (node.op != Operator::leaf || flat.instances[node.solid].piece > 0) continue;
            int& used = uses[flat.instances[node.solid].object];
            if (used < 100 && seen.count(node.solid) != 0) continue;
            seen.insert(node.solid);
            ++used;
            ++count;
        }
    }
    return count;
}

/// The solids for which BRL-CAD's box is known here.
bool has_brlcad_box(const Shape& shape) {
    return std::holds_alternative<Ell>(shape) || std::holds_alternative<Tgc>(shape) ||
           std::holds_alternative<Arb>(shape) || std::holds_alternative<Arbn>(shape) ||
           std::holds_alternative<Half>(shape) || std::holds_alternative<Tor>(shape) ||
           std::holds_alternative<Ehy>(shape);
}

}  // namespace

TEST_CASE("BRL-CAD's models flatten to the solids, regions and boxes that it finds itself", "[promise:brlcad]") {
    const std::string truths = test::folder("CSGRT_TRUTH"), models = test::folder("CSGRT_BRLCAD");
    if (truths.empty() || models.empty()) return;
    std::ifstream list(truths + "/objects.txt");
    int sets = 0;
    for (std::string line; std::getline(list, line);) {
        if (line.empty() || line[0] == '#') continue;
        std::istringstream words(line);
        std::string set, base;
        words >> set;
        base = set.substr(0, set.find('.'));
        std::vector<std::string> objects;
        for (std::string object; words >> object;) objects.push_back(object);
        INFO(set);
        std::string model = models + "/" + base + ".asc";
        if (!std::filesystem::exists(model)) model = truths + "/solids/" + base + ".asc";
        std::string truth_file = truths + "/" + set + ".txt.gz";
        if (!std::filesystem::exists(truth_file)) truth_file = truths + "/" + set + ".v1.txt.gz";
        REQUIRE(std::filesystem::exists(model));
        REQUIRE(std::filesystem::exists(truth_file));
        const Truth truth = read_truth(truth_file);
        const Scene scene = load_scene(model, {.strict = true});  // flattened as it is: a grip is an empty combination
        const FlatScene flat = flatten(scene, objects, false);
        ++sets;

        CHECK(flat.regions.size() == truth.regions);
        std::set<std::string> paths;
        for (const FlatRegion& region : flat.regions) paths.insert(test::without_numbers(region.info.path));
        for (const std::string& path : truth.paths) CHECK(paths.count(path) == 1);
        if (set == "goliath") {
            // Walked by several threads at once: which solids come within the first 100 is chance.
            const auto whole = std::count_if(flat.instances.begin(), flat.instances.end(),
                                             [](const Instance& instance) { return instance.piece == 0; });
            CHECK(whole == 3336);
            CHECK(whole < static_cast<std::ptrdiff_t>(truth.solids));
        } else {
            // There a grip is a solid that no ray meets; here it is the empty set.
            const std::size_t grips = set == "solids" ? 1 : 0;
            CHECK(solids_as_brlcad_counts(flat) + grips == truth.solids);
        }

        std::vector<Box> boxes;
        bool all_known = true;
        for (const Instance& instance : flat.instances) {
            const Shape& shape = shape_of(scene, flat, instance);
            if (!has_brlcad_box(std::get<Solid>(scene.objects[instance.object]).shape)) {
                all_known = false;
                break;
            }
            boxes.push_back(brlcad_box(shape, *instance.matrix, cuts_of(flat, instance)));
        }
        if (!all_known) continue;
        Box box = empty_box;
        std::vector<std::uint32_t> trees;
        for (const FlatRegion& region : flat.regions) {
            const Box own = tree_box(region.tree, boxes);
            if (is_finite(own) && !is_empty(own)) box = united(box, own);
            const LinearTree tree = linearize(region.tree, trees);
            const std::uint32_t leaves = (tree.word_count + 1) / 2;
            CHECK((tree.stack == 0 || leaves >> (tree.stack - 1) != 0));
        }
        // Rounded outward to whole units there, from numbers with roundings of their own.
        const double sides[] = {box.low.x, box.low.y, box.low.z, box.high.x, box.high.y, box.high.z};
        const double slack = 1e-9 * diagonal(box);
        for (int i = 0; i < 6; ++i) {
            INFO("side " << i << ": " << sides[i] << ", there " << truth.box[i]);
            const double outward = i < 3 ? sides[i] - truth.box[i] : truth.box[i] - sides[i];
            CHECK(outward >= -slack);
            CHECK(outward <= 1 + slack);
        }
    }
    CHECK(sets >= 20);
}
