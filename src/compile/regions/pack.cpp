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
#include "base/parallel.hpp"

namespace csgrt {

namespace {

constexpr std::size_t chunk_size = 512;

/// What a chunk of regions comes to; positions of words count from its first.
struct RegionChunk {
    std::vector<std::uint32_t> words;
    std::uint32_t first_word = 0;
    std::uint64_t leaves = 0;
    Box bounds = empty_box;
};

kernel::MaterialRecord material_of(const RegionInfo& info, double brightness, const CompiledScene& compiled) {
    const Finish& f = info.finish;
    const Vec3 color = compiled.shaded(info.color);
    const double ambient = compiled.ambient;
    const auto to_float = [](double x) { return static_cast<float>(x); };
    kernel::MaterialRecord m{to_float(color.x),
                             to_float(color.y),
                             to_float(color.z),
                             to_float(f.specular),
                             to_float(f.diffuse),
                             to_float(f.ambient),
                             static_cast<std::uint32_t>(std::max(f.shine, 0)),
                             0};
    if (!f.light) return m;
    // A body that shines has half of its colour everywhere, and the other half where it faces the eye, by which it
    // looks round.
    m.specular = m.diffuse = 0;
    m.ambient = ambient > 0 ? to_float(0.5 * brightness / ambient) : 0;
    m.glow = to_float((ambient > 0 ? 0.5 : 1) * brightness);
    return m;
}

}  // namespace

void pack_regions(FlatScene& flat, const std::vector<std::uint32_t>& order, const std::vector<Box>& brlcad_boxes,
                  CompiledScene& compiled) {
    const std::size_t count = flat.regions.size();
    std::vector<std::uint32_t> number(order.size());
    constexpr std::size_t many = 65'536;
    for_chunks(order.size(), many, 0, [&](std::size_t first, std::size_t last, std::size_t) {
        for (std::size_t i = first; i < last; ++i) number[order[i]] = static_cast<std::uint32_t>(i);
    });

    resize_cleared(compiled.regions, count);
    resize_cleared(compiled.region_info, count);
    resize_cleared(compiled.flat_trees, count);
    resize_cleared(compiled.materials, count);
    std::vector<RegionChunk> chunks((count + chunk_size - 1) / chunk_size);
    for_chunks(count, chunk_size, 0, [&](std::size_t first, std::size_t last, std::size_t c) {
        RegionChunk& chunk = chunks[c];
        for (std::size_t i = first; i < last; ++i) {
            FlatRegion& region = flat.regions[i];
            region.info.bounds = tree_box(region.tree, brlcad_boxes);
            if (is_finite(region.info.bounds) && !is_empty(region.info.bounds))
                chunk.bounds = united(chunk.bounds, region.info.bounds);
            for (FlatTree::Node& node : region.tree.nodes) {
                if (node.op != Operator::leaf) continue;
                node.solid = number[node.solid];
                ++chunk.leaves;
            }
            const LinearTree tree = linearize(region.tree, chunk.words);
            compiled.regions[i] = {tree.first_word, tree.word_count};
            compiled.materials[i] = material_of(region.info, region.brightness, compiled);
            compiled.region_info[i] = std::move(region.info);
            compiled.flat_trees[i] = std::move(region.tree);
        }
    });

    for (const RegionInfo& region : compiled.region_info) ++compiled.rank_ends[rank_of(region)];
    std::partial_sum(std::begin(compiled.rank_ends), std::end(compiled.rank_ends), std::begin(compiled.rank_ends));

    compiled.bounds = empty_box;
    std::uint64_t words = 0, leaves = 0;
    for (RegionChunk& chunk : chunks) {
        chunk.first_word = static_cast<std::uint32_t>(words);
        words += chunk.words.size();
        leaves += chunk.leaves;
        compiled.bounds = united(compiled.bounds, chunk.bounds);
        check_tree_words(words);
    }
    compiled.instances = static_cast<std::uint32_t>(leaves);
    compiled.trees.resize(words);
    for_chunks(count, chunk_size, 0, [&](std::size_t first, std::size_t last, std::size_t c) {
        const RegionChunk& chunk = chunks[c];
        for (std::size_t i = first; i < last; ++i) compiled.regions[i].first_word += chunk.first_word;
        std::transform(
            chunk.words.begin(), chunk.words.end(), compiled.trees.begin() + chunk.first_word,
            [&](std::uint32_t word) { return word >> TREE_SHIFT == OP_LEAF ? word : word + chunk.first_word; });
    });
}

}  // namespace csgrt
