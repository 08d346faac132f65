// CSG in a depth buffer: Goldfeather's products for first hits, Blister's layers for every partition.
//
// What is modelled: a pixel's depths. The surfaces are the exact ones of the library, sampled at the pixel's ray as a
// rasterizer would, and then each depth is rounded to 16, 24 or 32 bits between the planes that touch the scene's
// sphere in front and behind, seen in an orthographic view, where a buffer's depth is linear. After that only the
// rounded depths are compared: surfaces in one step of the buffer are in one place, and which one lies in front is
// lost. As a knob's last value depths are exact, so that what the methods lose by themselves can be seen.
//
// First hits (Goldfeather et al. 1986, 1989): the tree becomes a sum of products by distributing intersections over
// unions. In each product the front faces of the solids, and the back faces of the complemented ones, are candidates. A
// candidate is seen if each other solid of the product has an odd number of surfaces at its depth or in front of it,
// and each other complemented one an even number. (At its depth as well: else solids that share a face hide each
// other's.) The nearest of all products is the region's first surface, and the nearest region, by the least number at
// equal depth, is the pixel's. A normal form may have exponentially many products; it is made of what a ray may meet
// only, and a ray that needs more literals than `most_literals` is given up.
//
// Rules that make products of whole trees are counted (normal_form.cpp). It has no every partition: its faces are those
// where a product is entered, seen from outside.
//
// Every partition (Hable and Rossignac 2005, Blister; thesis section 2.1.2): the scene is peeled, one layer for each
// depth that the buffer tells apart; behind each layer the parities of all solids are put into the Blists of the
// regions, whose labels have 8 bits. A layer has the colour of the first surface of its depth that was drawn, here that
// of the least solid, whether or not that is one of the region's: where it is not, the owner is wrong. A surface is the
// region's if the exact depths before and behind it are not both in the region or both outside.
//
// Cost: Goldfeather O(n^2) a product, Blister a Blist a layer. Fails where surfaces lie within one step of the buffer.
// Prediction, of Blister's owners: where regions touch, about half of the layers are the back face of the one in front,
// so models of touching parts have a tenth of their owners wrong at any number of bits, exact depths among them; at 16
// bits more. Labels need 3 to 5 bits. Broken by coplanar and coincident.
#include "depth_buffer.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "blists.hpp"
#include "compile/linear.hpp"
#include "each_ray.hpp"
#include "list.hpp"
#include "ray_domain.hpp"
#include "ray_events.hpp"

namespace csgrt::bench {

DepthScale::DepthScale(double near, double far, unsigned bits)
    : is_exact_(bits == exact), near_(near), length_(far - near), steps_(std::ldexp(1.0, static_cast<int>(bits)) - 1) {}

std::uint64_t DepthScale::kept(double depth) const {
    if (is_exact_) {  // negative doubles are ordered the other way round
        const auto bits = std::bit_cast<std::uint64_t>(depth + 0.0);  // no -0
        return bits >> 63 ? ~bits : bits | std::uint64_t{1} << 63;
    }
    return static_cast<std::uint64_t>(std::clamp((depth - near_) / length_, 0.0, 1.0) * steps_ + 0.5);
}

double DepthScale::depth(std::uint64_t kept) const {
    if (is_exact_) return std::bit_cast<double>(kept >> 63 ? kept ^ std::uint64_t{1} << 63 : ~kept);
    return near_ + length_ * (static_cast<double>(kept) / steps_);
}

namespace {

/// a and b; false: they contradict each other, and the product is empty.
bool merge(const Product& a, const Product& b, Product& both) {
    both.clear();
    std::set_union(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(both));
    for (std::size_t i = 1; i < both.size(); ++i)
        if (both[i] >> 1 == both[i - 1] >> 1) return false;
    return true;
}

class Normalizer {
public:
    Normalizer(const std::vector<LiveTrees::Node>& nodes, std::size_t most) : nodes_(nodes), most_(most) {}

    bool sum_of(Operand operand, std::vector<Product>& sum, int level = 0) {
        sum.clear();
        if (operand == EMPTY_SET) return true;
        if (operand == FULL_SET) {
            sum.emplace_back();
            return true;
        }
        if (level > most_levels) return false;
        const LiveTrees::Node& node = nodes_[operand >> 1];
        const std::uint32_t complemented = operand & 1;
        if (node.gate == Gate::leaf) {
            sum.push_back({node.solid << 1 | complemented});
            ++written_;
            return true;
        }
        if (node.gate == Gate::xor_) {  // (a and not b) or (not a and b); complemented: (a and b) or (not a and not b)
            std::vector<Product> a, b, other;
            if (!sum_of(node.left, a, level + 1) || !sum_of(node.right ^ 1 ^ complemented, b, level + 1)) return false;
            if (!product_of(a, b, sum)) return false;
            if (!sum_of(node.left ^ 1, a, level + 1) || !sum_of(node.right ^ complemented, b, level + 1)) return false;
            if (!product_of(a, b, other)) return false;
            sum.insert(sum.end(), other.begin(), other.end());
            return true;
        }
        std::vector<Product> a, b;
        if (!sum_of(node.left ^ complemented, a, level + 1) || !sum_of(node.right ^ complemented, b, level + 1))
            return false;
        if ((node.gate == Gate::union_) != (complemented != 0)) {  // by De Morgan
            sum = std::move(a);
            sum.insert(sum.end(), b.begin(), b.end());
            return true;
        }
        return product_of(a, b, sum);
    }

private:
    static constexpr int most_levels = 2'000;

    bool product_of(const std::vector<Product>& a, const std::vector<Product>& b, std::vector<Product>& sum) {
        sum.clear();
        Product both;
        for (const Product& x : a)
            for (const Product& y : b) {
                written_ += x.size() + y.size();
                if (written_ > most_) return false;
                if (merge(x, y, both)) sum.push_back(both);
            }
        return true;
    }

    const std::vector<LiveTrees::Node>& nodes_;
    std::size_t most_, written_ = 0;
};

constexpr std::size_t most_literals = 200'000;
constexpr std::uint64_t most_layers = 20'000;
constexpr std::size_t most_labels = 256;  // Blister has 8 bits for them

struct Shared : SharedScene {
    unsigned bits;
    struct {
        std::uint64_t regions, endless, applied, products, pruned;
    } rules = {};                                     ///< first hits: what they make of whole trees
    std::vector<std::vector<BlistLeaf>> blists = {};  ///< every partition: one a region
    std::uint64_t label_bits = 0;
    std::vector<std::vector<std::uint32_t>> regions_of = {};  ///< of each solid
};

class Worker : RegionWorker<Shared> {
public:
    explicit Worker(const Shared& shared)
        : RegionWorker(shared), candidate_of_(shared.rays.scene().solids.size(), NONE) {}

    void trace(const Ray& ray, Answer& answer) {
        if (!begin(ray)) return;
        const Domain domain = search_domain(shared_.rays.scene(), ray);
        const DepthScale scale(domain.from, domain.to, shared_.bits);
        intersect(ray, exact_, [](double t) { return t; });
        depths_.clear();
        for (const double t : exact_) depths_.push_back(scale.kept(t));
        // A camera within the model would have what lies behind it clipped, and the caps are no surfaces.
        const bool starts_within = shared_.first_hits && std::any_of(depths_.begin(), depths_.end(),
                                                                     [&](auto depth) { return scale.kept(0) > depth; });
        answer.answered = !starts_within;
        starts_within_ += starts_within;
        layers_of_ray_ = 0;
        for (std::uint32_t i = 0; i < solids_.size(); ++i) candidate_of_[solids_[i]] = i;
        answer_by(answer, 0, [&](const LiveTrees::Root& root) {
            return shared_.first_hits ? nearest(root, scale) : peel(root, scale);
        });
        if (!shared_.first_hits && answer.answered) count_owners(answer.stretches, scale);
        for (const std::uint32_t solid : solids_) candidate_of_[solid] = NONE;
    }
    Counts counts() const {
        if (!shared_.first_hits)
            return {{"layers a ray", {layers_}},
                    {"bits a label", {shared_.label_bits, 1}},
                    {"wrong owner, share of stretches", {wrong_owners_, std::max<std::uint64_t>(owners_, 1)}}};
        const auto& rules = shared_.rules;
        const std::uint64_t ended = std::max<std::uint64_t>(rules.regions - rules.endless, 1);
        return {{"products a ray", {products_}},
                {"rules a region", {rules.applied, ended}},
                {"products a region", {rules.products, ended}},
                {"products a region after pruning", {rules.pruned, ended}},
                {"regions whose rules do not end, share", {rules.endless, std::max<std::uint64_t>(rules.regions, 1)}},
                {"start within the scene, share of rays", {starts_within_}},
                {"normal form too long, share of rays", {too_long_}}};
    }

private:
    std::size_t surfaces_up_to(std::uint32_t candidate, std::uint64_t depth) const {
        const std::span<const std::uint64_t> own = surfaces_of(candidate, depths_);
        return static_cast<std::size_t>(std::upper_bound(own.begin(), own.end(), depth) - own.begin());
    }

    bool is_seen(const Product& product, std::uint32_t own, std::uint64_t depth) const {
        return std::all_of(product.begin(), product.end(), [&](std::uint32_t other) {
            return other == own || surfaces_up_to(other >> 1, depth) % 2 != (other & 1);
        });
    }

    /// Goldfeather: the nearest face of the region's products. How far the region reaches behind it is not known; it
    /// is given one step. False: too many literals.
    bool nearest(const LiveTrees::Root& root, const DepthScale& scale) {
        if (!normalize(live_.nodes(), root, most_literals, sum_)) {
            ++too_long_;
            return false;
        }
        products_ += sum_.size();
        std::uint64_t depth = 0;
        bool found = root.operand == FULL_SET;
        for (const Product& product : sum_)
            for (const std::uint32_t literal : product) {
                // Front faces stand at even places, back faces at odd ones.
                const std::span<const std::uint64_t> own = surfaces_of(literal >> 1, depths_);
                for (std::size_t i = literal & 1; i < own.size(); i += 2) {
                    if (found && own[i] >= depth) break;
                    if (!is_seen(product, literal, own[i])) continue;
                    depth = own[i];
                    found = true;
                }
            }
        if (found) {
            const double in = depth == 0 ? -infinity : scale.depth(depth);
            claimed_.push_back({root.region, in, std::max(scale.depth(depth + 1), std::nextafter(in, infinity))});
        }
        return true;
    }

    /// The region's Blist where `covers` says of each candidate whether the place is in it.
    template <class Covers>
    bool holds(std::uint32_t region, const Covers& covers) const {
        const std::vector<BlistLeaf>& leaves = shared_.blists[region];
        std::uint32_t at = leaves.empty() ? BlistLeaf::out : 0;
        while (at < BlistLeaf::out) {
            const std::uint32_t candidate = candidate_of_[leaves[at].solid];
            const bool covered = candidate != NONE && covers(candidate);
            at = covered != leaves[at].complement ? leaves[at].on_true : leaves[at].on_false;
        }
        return at == BlistLeaf::in;
    }

    /// Blister: behind the layer at `depth`.
    bool is_inside(std::uint32_t region, std::uint64_t depth) const {
        return holds(region, [&](std::uint32_t candidate) { return surfaces_up_to(candidate, depth) % 2; });
    }

    /// Counts the stretches whose layer has the colour of a surface that is not the region's.
    void count_owners(const Sequence& stretches, const DepthScale& scale) {
        drawn_.clear();
        for (std::uint32_t candidate = 0; candidate < solids_.size(); ++candidate) {
            const std::span<const double> own = surfaces_of(candidate, exact_);
            for (const double t : own) drawn_.push_back({scale.kept(t), candidate, t});
        }
        std::sort(drawn_.begin(), drawn_.end());
        for (const Stretch& stretch : stretches) {
            const std::uint64_t depth = scale.kept(stretch.in);
            // Where another region that overlaps it ends, the region has no surface.
            if (depth == 0 || is_inside(stretch.region, depth - 1) || !is_inside(stretch.region, depth)) continue;
            const Drawn first = *std::lower_bound(drawn_.begin(), drawn_.end(), Drawn{depth, 0, -infinity});
            const auto is_in = [&](bool behind) {
                return holds(stretch.region, [&](std::uint32_t candidate) {
                    const std::span<const double> own = surfaces_of(candidate, exact_);
                    const auto at = behind ? std::upper_bound(own.begin(), own.end(), first.t)
                                           : std::lower_bound(own.begin(), own.end(), first.t);
                    return (at - own.begin()) % 2;
                });
            };
            const std::vector<std::uint32_t>& regions = shared_.regions_of[solids_[first.candidate]];
            ++owners_;
            wrong_owners_ +=
                !std::binary_search(regions.begin(), regions.end(), stretch.region) || is_in(false) == is_in(true);
        }
    }

    /// All layers of the region. False: too many.
    bool peel(const LiveTrees::Root& root, const DepthScale& scale) {
        if (root.operand == FULL_SET) claimed_.push_back({root.region, -infinity, infinity});
        peeled_.clear();
        for (std::uint32_t i = root.first; i < root.last; ++i) {
            const LiveTrees::Node& node = live_.nodes()[i];
            if (node.gate != Gate::leaf) continue;
            const std::span<const std::uint64_t> own = surfaces_of(node.solid, depths_);
            peeled_.insert(peeled_.end(), own.begin(), own.end());
        }
        std::sort(peeled_.begin(), peeled_.end());
        peeled_.erase(std::unique(peeled_.begin(), peeled_.end()), peeled_.end());
        layers_ += peeled_.size();
        layers_of_ray_ += peeled_.size();
        if (layers_of_ray_ > most_layers) return false;
        const std::uint64_t last = scale.kept(infinity);
        double in = 0;
        bool inside = false;
        for (const std::uint64_t depth : peeled_) {
            const bool next = depth < last && is_inside(root.region, depth);
            if (next == inside) continue;
            if (next) in = depth == 0 ? -infinity : scale.depth(depth);
            if (!next) claimed_.push_back({root.region, in, depth == last ? infinity : scale.depth(depth)});
            inside = next;
        }
        return true;
    }

    /// A surface, in the order in which a layer's are drawn.
    struct Drawn {
        std::uint64_t depth;
        std::uint32_t candidate;
        double t;
        auto operator<=>(const Drawn&) const = default;
    };

    std::vector<double> exact_;
    std::vector<std::uint64_t> depths_, peeled_;
    std::vector<std::uint32_t> candidate_of_;  ///< by solid
    std::vector<Drawn> drawn_;
    std::vector<Product> sum_;
    std::uint64_t products_ = 0, layers_ = 0, layers_of_ray_ = 0, starts_within_ = 0, too_long_ = 0;
    std::uint64_t owners_ = 0, wrong_owners_ = 0;
};

}  // namespace

bool normalize(const std::vector<LiveTrees::Node>& nodes, const LiveTrees::Root& root, std::size_t most,
               std::vector<Product>& sum) {
    return Normalizer(nodes, most).sum_of(root.operand, sum);
}

Method depth_buffer() {
    Method m;
    m.name = "depth buffer";
    m.source = "Goldfeather et al. 1986, Hable and Rossignac 2005";
    m.about =
        "Rounds the exact depths of all surfaces to a buffer's bits, linear between the scene's near and far plane, "
        "and compares nothing else: products of the normal form for first hits (Goldfeather), layers and Blists of "
        "labels of 8 bits for every partition (Blister). For speed: the hierarchy's candidates, each solid intersected "
        "once a ray, and a normal form of what the ray may meet only.";
    m.breaks =
        "slivers and degenerate: what is thinner than a step of the buffer vanishes. depth, overlaps and nested at 16 "
        "bits: several surfaces lie in one step. deep_trees: a normal form that is too long is given up. coplanar and "
        "coincident should gain: what is one within rounding is one in the buffer, but not with exact depths.";
    m.knob = "bits of a depth; 64: exact";
    m.knob_values = {16, 24, 32, DepthScale::exact};
    m.exact = false;
    m.prepare = [](const Subject& subject, const TraceOptions& options) -> std::unique_ptr<Tracer> {
        if (!(options.knob >= 1 && options.knob <= 32) && options.knob != DepthScale::exact)
            throw Error(Status::usage, "depth buffer: needs from 1 to 32 bits, or 64 for exact depths");
        Shared shared{{subject, options}, static_cast<unsigned>(options.knob)};
        shared.regions_of = regions_of_solids(subject.compiled);
        const auto count_rules = [&](const FlatTree& tree) {
            const auto applied = rewrite(general_form(tree, options.planted), [&](const Product& product) {
                Box common = whole_space;
                for (const std::uint32_t literal : product)
                    if (!(literal & 1)) common = intersected(common, subject.compiled.solid_boxes[literal >> 1]);
                ++shared.rules.products;
                shared.rules.pruned += !is_empty(common);
            });
            ++shared.rules.regions;
            shared.rules.endless += !applied;
            shared.rules.applied += applied.value_or(0);
        };
        for (const FlatTree& tree : subject.compiled.flat_trees) {
            if (options.first_hits) {
                count_rules(tree);
                continue;
            }
            shared.blists.push_back(blist_of(positive_tree(tree, Grouping::heavy_left, options.planted)));
            const std::size_t names = labels(shared.blists.back());
            if (names > most_labels)
                throw Error(Status::usage, "depth buffer: a region's Blist needs labels of more than 8 bits");
            shared.label_bits = std::max<std::uint64_t>(shared.label_bits, std::bit_width(names - (names > 0)));
        }
        return trace_each_ray<Worker>(std::move(shared), options);
    };
    return m;
}

}  // namespace csgrt::bench
