// CSG in a depth buffer: Goldfeather's products for first hits, Blister's layers for every partition.
//
// What is modelled: a pixel's depths. The surfaces are the exact ones of the library, sampled at the pixel's ray as a
// rasterizer would, and then each depth is rounded to 16, 24 or 32 bits between the planes that touch the scene's
// sphere in front and behind, seen in an orthographic view, where a buffer's depth is linear. After that only the
// rounded depths are compared: surfaces in one step of the buffer are in one place, and which one lies in front is
// lost.
//
// First hits (Goldfeather et al. 1986, 1989): the tree becomes a sum of products by distributing intersections over
// unions. In each product the front faces of the solids, and the back faces of the complemented ones, are candidates. A
// candidate is seen if each other solid of the product has an odd number of surfaces at its depth or in front of it,
// and each other complemented one an even number. (At its depth as well: else solids that share a face hide each
// other's.) The nearest of all products is the region's first surface, and the nearest region, by the least number at
// equal depth, is the pixel's. A normal form may have exponentially many products; it is made of what a ray may meet
// only, and a ray that needs more literals than `most_literals` is given up.
//
// Every partition (Hable and Rossignac 2005, Blister): the scene is peeled, one layer for each depth that the buffer
// tells apart; behind each layer the parities of all solids are put into the tree.
//
// Cost: Goldfeather O(n^2) a product, Blister a tree a layer. Fails where surfaces lie within one step of the buffer.
#include "depth_buffer.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "each_ray.hpp"
#include "list.hpp"
#include "ray_domain.hpp"

namespace csgrt::bench {

DepthScale::DepthScale(double near, double far, unsigned bits)
    : near_(near), length_(far - near), steps_(std::ldexp(1.0, static_cast<int>(bits)) - 1) {}

std::uint64_t DepthScale::kept(double depth) const {
    return static_cast<std::uint64_t>(std::clamp((depth - near_) / length_, 0.0, 1.0) * steps_ + 0.5);
}

double DepthScale::depth(std::uint64_t kept) const { return near_ + length_ * (static_cast<double>(kept) / steps_); }

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

struct Shared : SharedScene {
    unsigned bits;
};

class Worker : RegionWorker<Shared> {
public:
    explicit Worker(const Shared& shared) : RegionWorker(shared) {}

    void trace(const Ray& ray, Answer& answer) {
        if (!begin(ray)) return;
        const Domain domain = search_domain(shared_.rays.scene(), ray);
        const DepthScale scale(domain.from, domain.to, shared_.bits);
        intersect(ray, depths_, [&](double t) { return scale.kept(t); });
        // A camera within the model would have what lies behind it clipped, and the caps are no surfaces.
        const bool starts_within = shared_.first_hits && std::any_of(depths_.begin(), depths_.end(),
                                                                     [&](auto depth) { return scale.kept(0) > depth; });
        answer.answered = !starts_within;
        starts_within_ += starts_within;
        layers_of_ray_ = 0;
        answer_by(answer, 0, [&](const LiveTrees::Root& root) {
            return shared_.first_hits ? nearest(root, scale) : peel(root, scale);
        });
    }
    Counts counts() const {
        return {{"products a ray", {products_}},
                {"layers a ray", {layers_}},
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

    /// Blister: behind the layer at `depth`.
    bool is_inside(const LiveTrees::Root& root, std::uint64_t depth) {
        return live_.function_of<signed char>(root, 1, values_, [&](std::uint32_t candidate) {
            return static_cast<signed char>(surfaces_up_to(candidate, depth) % 2 ? -1 : 1);
        }) < 0;
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
            const bool next = depth < last && is_inside(root, depth);
            if (next == inside) continue;
            if (next) in = depth == 0 ? -infinity : scale.depth(depth);
            if (!next) claimed_.push_back({root.region, in, depth == last ? infinity : scale.depth(depth)});
            inside = next;
        }
        return true;
    }

    std::vector<std::uint64_t> depths_, peeled_;
    std::vector<signed char> values_;  ///< by node
    std::vector<Product> sum_;
    std::uint64_t products_ = 0, layers_ = 0, layers_of_ray_ = 0, starts_within_ = 0, too_long_ = 0;
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
        "and compares nothing else: products of the normal form for first hits (Goldfeather), layers for every "
        "partition (Blister). For speed: the hierarchy's candidates, each solid intersected once a ray, and a normal "
        "form of what the ray may meet only.";
    m.breaks =
        "slivers and degenerate: what is thinner than a step of the buffer vanishes. depth, overlaps and nested at 16 "
        "bits: several surfaces lie in one step. deep_trees: a normal form that is too long is given up. coplanar and "
        "coincident should gain: what is one within rounding is one in the buffer.";
    m.knob = "bits of a depth";
    m.knob_values = {16, 24, 32};
    m.exact = false;
    m.prepare = [](const Subject& subject, const TraceOptions& options) -> std::unique_ptr<Tracer> {
        if (!(options.knob >= 1 && options.knob <= 32))
            throw Error(Status::usage, "depth buffer: needs from 1 to 32 bits");
        return trace_each_ray<Worker>(Shared{{subject, options}, static_cast<unsigned>(options.knob)}, options);
    };
    return m;
}

}  // namespace csgrt::bench
