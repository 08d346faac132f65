#include "compile/regions/pack.hpp"

#include <algorithm>
#include <iterator>
#include <numeric>
#include <string>
#include <utility>

#include "compile/flatten/attributes.hpp"
#include "compile/bounds/bounds.hpp"
#include "compile/linear.hpp"
#include "compile/regions/linearize.hpp"
#include "compile/regions/path_table.hpp"
#include "compile/regions/terms.hpp"
#include "base/parallel.hpp"

namespace csgrt {

namespace {

constexpr std::size_t chunk_size = 512;
static_assert(chunk_size % SharedList<RegionInfo>::chunk_size == 0);  // threads make different chunks of the list

/// The packed form of a chunk of regions; positions count from its first word.
struct RegionChunk {
    std::vector<std::uint32_t> words;
    std::uint32_t first_word = 0;
};

void extend(Box& bounds, const RegionInfo& region) {
    if (is_finite(region.bounds) && !is_empty(region.bounds)) bounds = united(bounds, region.bounds);
}

}  // namespace

SharedList<RegionInfo> take_infos(FlatScene& flat, const std::vector<Box>& brlcad_boxes, Box& bounds) {
    SharedList<RegionInfo> infos(flat.regions.size());
    std::vector<Box> around((infos.size() + chunk_size - 1) / chunk_size, empty_box);
    for_chunks(infos.size(), chunk_size, 0, [&](std::size_t first, std::size_t last, std::size_t chunk) {
        for (std::size_t i = first; i < last; ++i) {
            RegionInfo& info = infos.own(i) = std::move(flat.regions[i].info);
            info.bounds = tree_box(flat.regions[i].tree, brlcad_boxes);
            extend(around[chunk], info);
        }
    });
    bounds = empty_box;
    for (const Box& box : around) bounds = united(bounds, box);
    return infos;
}

Box bounds_of(const SharedList<RegionInfo>& regions) {
    Box all = empty_box;
    for (const RegionInfo& region : regions) extend(all, region);
    return all;
}

PackedRegions pack_regions(const FlatScene& flat, const std::vector<FlatTree>& trees,
                           const std::vector<std::uint32_t>& order, const std::vector<Box>& brlcad_boxes,
                           SharedList<RegionInfo> infos) {
    Logic logic;
    logic.paths = std::make_shared<LatePathTable>();
    logic.region_info = std::move(infos);
    const std::size_t count = flat.regions.size();
    std::vector<std::uint32_t> number(flat.instances.size());
    constexpr std::size_t many = 65'536;
    for_chunks(order.size(), many, 0, [&](std::size_t first, std::size_t last, std::size_t) {
        for (std::size_t i = first; i < last; ++i) number[order[i]] = static_cast<std::uint32_t>(i);
    });

    std::vector<RegionWords>& regions = logic.regions.own();
    std::vector<FlatTree>& flat_trees = logic.flat_trees.own();
    resize_cleared(regions, count);
    resize_cleared(flat_trees, count);
    std::vector<RegionChunk> chunks((count + chunk_size - 1) / chunk_size);
    for_chunks(count, chunk_size, 0, [&](std::size_t first, std::size_t last, std::size_t c) {
        RegionChunk& chunk = chunks[c];
        for (std::size_t i = first; i < last; ++i) {
            const FlatRegion& region = flat.regions[i];
            const auto numbered = [&](FlatTree tree) {
                for (FlatTree::Node& node : tree.nodes)
                    if (node.op == Operator::leaf) node.solid = number[node.solid];
                return tree;
            };
            flat_trees[i] = numbered(region.tree);
            const LinearTree tree = linearize(trees.empty() ? flat_trees[i] : numbered(trees[i]), chunk.words);
            regions[i] = {tree.first_word, tree.word_count};
        }
    });

    for (std::uint32_t i = 0; i < count; ++i) {
        const RegionInfo& info = logic.region_info[i];
        ++logic.rank_ends[rank_of(info)];
        if (info.state != State::shown) logic.set_state(i, info.state);
        if (info.finish.light)
            logic.region_lights.push_back({i, *flat.instances[flat.regions[i].tree.nodes.front().solid].matrix});
    }
    std::partial_sum(std::begin(logic.rank_ends), std::end(logic.rank_ends), std::begin(logic.rank_ends));

    std::uint64_t words = 0;
    for (RegionChunk& chunk : chunks) {
        chunk.first_word = static_cast<std::uint32_t>(words);
        words += chunk.words.size();
        check_tree_words(words);
    }
    std::vector<std::uint32_t>& all_words = logic.trees.own();
    all_words.resize(words);
    for_chunks(count, chunk_size, 0, [&](std::size_t first, std::size_t last, std::size_t c) {
        const RegionChunk& chunk = chunks[c];
        for (std::size_t i = first; i < last; ++i) regions[i].first_word += chunk.first_word;
        std::transform(
            chunk.words.begin(), chunk.words.end(), all_words.begin() + chunk.first_word,
            [&](std::uint32_t word) { return word >> TREE_SHIFT == OP_LEAF ? word : word + chunk.first_word; });
    });
    std::vector<bool> halves(order.size());
    for (std::size_t i = 0; i < order.size(); ++i) halves[i] = !is_finite(brlcad_boxes[order[i]]);
    std::vector<kernel::SolidRecord> solids = list_terms(logic, halves);
    return {std::move(logic), std::move(solids)};
}

}  // namespace csgrt
