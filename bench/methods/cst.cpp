// Hable and Rossignac 2007, CST: "CST: Constructive Solid Trimming for rendering BReps and CSG"; thesis section 2.1.2.
// Active zones: Rossignac and Voelcker 1989.
//
// Theory: a surface of a solid is one of the region's where the region changes if the solid does. In the tree in
// positive form this depends on the brothers of the solid and of the nodes above it: those of an intersection (i-nodes)
// must be true there, those of a union (u-nodes) must be false. So each solid has an active zone,
//
//     all space, and its i-nodes, and not its u-nodes
//
// and each of its surfaces is trimmed by the Blist of that zone. What is left is merged by depth: the ray enters and
// leaves the region there in turn. A brother under a xor does not matter, since the xor changes whatever it is.
//
//     (a - b) + c     of a   not b, not c         i-node not b, u-node c
//                     of b   a, not c             i-node a, u-node c
//                     of c   not (a - b)          u-node a - b
//
// First hits of an opaque region, seen from outside: only front faces of solids and back faces of complements count,
// and u-nodes may be left out, since a surface within them lies behind the first one. Solids under a xor keep theirs,
// and both faces. A ray that begins behind a surface takes the way of every partition.
//
// Surfaces in one place: the zone of one asks whether the place is in the solid of the other, which has no answer. Here
// every answer is tried. Unless all lead to one surface or to none, the ray is given up, and counted apart. That is
// more than rays in faces: a solid that stands twice in a tree coincides with itself.
//
// Cost: for each surface a Blist of up to all other leaves; the zones of a region have the square of its leaves, and of
// xor more. A region of more than 4,096 leaves is refused, as are lists of more than 2^24 in all.
// Prediction: right wherever it answers; slower than a Blist a partition, which asks one list where here each surface
// asks one, but first hits gain from the zones without u-nodes. Broken by coincident, coplanar and edges (rays given
// up) and by deep_trees (refused: the square of 50,000 leaves).
#include <set>

#include "blists.hpp"
#include "device_method.hpp"
#include "each_ray.hpp"
#include "list.hpp"
#include "ray_events.hpp"

namespace csgrt::bench {
namespace {

constexpr std::uint64_t most_list_leaves = 1u << 24;

/// A Blist among all of them; of no leaves: all space.
struct Zone {
    std::uint32_t first = 0, count = 0;
};

/// The part of a solid's surfaces in a region.
struct Surface {
    std::uint32_t region;
    bool complement, under_xor;
    Zone zone, opaque_zone;
};

struct Shared : EventScene {
    std::vector<BlistLeaf> leaves = {};
    std::vector<std::vector<Surface>> surfaces = {};  ///< of each solid
};

/// Adds the zones of a region's leaves.
class ZoneWriter {
public:
    ZoneWriter(Shared& shared, std::uint32_t region, const PositiveTree& tree)
        : shared_(shared), region_(region), size_(static_cast<std::uint32_t>(tree.nodes.size())), zone_(tree) {
        // Behind the nodes their complements, by De Morgan: zones are made of both.
        for (PositiveTree::Node node : tree.nodes) {
            if (node.gate == Gate::leaf) {
                node.complement = !node.complement;
            } else {
                node.left += size_;
                if (node.gate != Gate::xor_) {
                    node.right += size_;
                    node.gate = node.gate == Gate::union_ ? Gate::intersection : Gate::union_;
                }
            }
            zone_.nodes.push_back(node);
        }
    }

    void write() {
        if (size_ == 0) return;
        const std::uint64_t leaves = zone_.nodes[size_ - 1].leaves;
        if (leaves * leaves > most_list_leaves) refuse();
        // Down from the root: a node, and the node above it.
        std::vector<std::uint32_t> above(size_, NONE);
        for (std::uint32_t i = 0; i < size_; ++i)
            if (zone_.nodes[i].gate != Gate::leaf) above[zone_.nodes[i].left] = above[zone_.nodes[i].right] = i;
        for (std::uint32_t leaf = 0; leaf < size_; ++leaf) {
            if (zone_.nodes[leaf].gate != Gate::leaf) continue;
            std::vector<std::uint32_t> i_nodes, both;
            bool under_xor = false;
            for (std::uint32_t node = leaf; above[node] != NONE; node = above[node]) {
                const PositiveTree::Node& gate = zone_.nodes[above[node]];
                const std::uint32_t brother = gate.left == node ? gate.right : gate.left;
                under_xor = under_xor || gate.gate == Gate::xor_;
                if (gate.gate == Gate::intersection) i_nodes.push_back(brother);
                if (gate.gate != Gate::xor_) both.push_back(brother + (gate.gate == Gate::union_ ? size_ : 0));
            }
            Surface surface{region_, zone_.nodes[leaf].complement, under_xor, list_of(both), {}};
            if (shared_.first_hits) surface.opaque_zone = under_xor ? surface.zone : list_of(i_nodes);
            shared_.surfaces[zone_.nodes[leaf].left].push_back(surface);
        }
    }

private:
    [[noreturn]] static void refuse() {
        throw Error(Status::usage, "CST: the active zones have lists of over 2^24 leaves");
    }

    /// The Blist of the intersection of the parts, the heavier ones on the left.
    Zone list_of(std::vector<std::uint32_t> parts) {
        if (parts.empty()) return {};
        std::stable_sort(parts.begin(), parts.end(), [&](std::uint32_t a, std::uint32_t b) {
            return zone_.nodes[a].leaves > zone_.nodes[b].leaves;
        });
        zone_.nodes.resize(2 * std::size_t{size_});
        zone_.nodes.push_back(zone_.nodes[parts[0]]);
        for (std::size_t i = 1; i < parts.size(); ++i)
            zone_.nodes.push_back({Gate::intersection, false, zone_.root(), parts[i]});
        const std::vector<BlistLeaf> list = blist_of(zone_);
        if (shared_.leaves.size() + list.size() > most_list_leaves) refuse();
        const Zone zone{static_cast<std::uint32_t>(shared_.leaves.size()), static_cast<std::uint32_t>(list.size())};
        shared_.leaves.insert(shared_.leaves.end(), list.begin(), list.end());
        return zone;
    }

    Shared& shared_;
    std::uint32_t region_, size_;
    PositiveTree zone_;  ///< the region's nodes, their complements, and the zone that is being written
};

class Worker {
public:
    explicit Worker(const Shared& shared)
        : shared_(shared),
          covers_(shared.surfaces.size()),
          crosses_(shared.surfaces.size()),
          entered_(shared.rays.scene().flat_trees.size(), NONE) {}

    void trace(const Ray& ray, Answer& answer) {
        events_.find(shared_.rays, ray);
        one_place_ = false;
        if (shared_.first_hits && !events_.marked && events_.steps() && events_.at[0] > 0) {
            sweep(0, [&](std::uint32_t event) { return !first_hit(event, answer); });
        } else {
            within_ += shared_.first_hits;
            answer.stretches = stretches_of(
                events_, owners_.find(events_, [this](auto missed, auto& claimed) { classify(missed, claimed); }),
                shared_.first_hits);
        }
        given_up_ += one_place_;
        answer.answered = !one_place_;
        if (one_place_) answer.stretches.clear();
    }
    Counts counts() const {
        Counts counts{{"surfaces in one place, share of rays", {given_up_}},
                      {"leaves asked a surface", {asked_, std::max<std::uint64_t>(trimmed_, 1)}}};
        if (shared_.first_hits) counts["not seen from outside, share of rays"] = {within_};
        return counts;
    }

private:
    static constexpr unsigned can_be_out = 1, can_be_in = 2;
    struct Crossing {
        std::uint32_t event, solid;
        int change;
        bool operator<(const Crossing& other) const {
            return std::pair(event, solid) < std::pair(other.event, other.solid);
        }
    };
    struct Trimmed {
        std::uint32_t region;
        unsigned outcomes;
        bool under_xor;
        bool operator<(const Trimmed& other) const { return region < other.region; }
    };

    /// Goes through the events of the segments that have none of `missed`. At each, `crossing_` has the solids of which
    /// the ray enters or leaves all; visit(event) ends it with false.
    template <class Visit>
    void sweep(std::uint32_t missed, const Visit& visit) {
        crossings_.clear();
        for (const RayEvents::Segment& segment : events_.segments) {
            if (segment.missed & missed) continue;
            crossings_.push_back({segment.in, segment.solid, 1});
            crossings_.push_back({segment.out, segment.solid, -1});
        }
        std::sort(crossings_.begin(), crossings_.end());
        for (std::size_t i = 0, next = 0; i < crossings_.size(); i = next) {
            crossing_.clear();
            ++visit_;
            for (next = i; next < crossings_.size() && crossings_[next].event == crossings_[i].event;) {
                const std::uint32_t solid = crossings_[next].solid;
                int change = 0;
                for (; next < crossings_.size() && crossings_[next].event == crossings_[i].event &&
                       crossings_[next].solid == solid;
                     ++next)
                    change += crossings_[next].change;
                if ((covers_[solid] > 0) == (covers_[solid] + change > 0)) continue;
                crossing_.push_back(solid);
                crosses_[solid] = visit_;
            }
            if (!crossing_.empty() && !visit(crossings_[i].event)) break;
            for (std::size_t k = i; k < next; ++k) covers_[crossings_[k].solid] += crossings_[k].change;
        }
        for (const Crossing& crossing : crossings_) covers_[crossing.solid] = 0;
    }

    /// Of each step the least region that claims it.
    void classify(std::uint32_t missed, std::vector<std::uint32_t>& claimed) {
        claimed.assign(events_.steps(), NONE);
        sweep(missed, [&](std::uint32_t event) {
            trimmed_here_.clear();
            for (const std::uint32_t solid : crossing_)
                for (const Surface& surface : shared_.surfaces[solid])
                    if (trim(surface, surface.zone) == (can_be_in | can_be_out)) {
                        one_place_ = true;
                        return false;
                    }
            for_regions([&](std::uint32_t region, std::size_t own, bool, bool) {
                if (own > 1) one_place_ = true;
                std::uint32_t& in = entered_[region];
                if (in == NONE) {
                    open_.push_back(region);
                    in = event;
                    return;
                }
                for (std::uint32_t step = in; step < event; ++step) claimed[step] = std::min(claimed[step], region);
                in = NONE;
            });
            return !one_place_;
        });
        for (const std::uint32_t region : open_) entered_[region] = NONE;  // of a ray that was given up
        open_.clear();
    }

    /// The opaque way. True: the ray is at its end.
    bool first_hit(std::uint32_t event, Answer& answer) {
        trimmed_here_.clear();
        for (const std::uint32_t solid : crossing_)
            for (const Surface& surface : shared_.surfaces[solid])
                if (surface.under_xor || (covers_[solid] > 0) == surface.complement) trim(surface, surface.opaque_zone);
        std::uint32_t owner = NONE, doubtful = NONE;
        for_regions([&](std::uint32_t region, std::size_t possible, bool certain, bool under_xor) {
            const bool is_met = certain && (possible == 1 || !under_xor);
            std::uint32_t& least = is_met ? owner : doubtful;
            least = std::min(least, region);
        });
        one_place_ = doubtful < owner;
        if (owner == NONE) return one_place_;
        answer.stretches = {{owner, events_.at[event], std::numeric_limits<double>::infinity()}};
        return true;
    }

    /// The outcomes of a zone (outcomes_of), noted if the surface can be its region's.
    unsigned trim(const Surface& surface, const Zone& zone) {
        ++trimmed_;
        const unsigned outcomes = outcomes_of(zone);
        if (outcomes & can_be_in) trimmed_here_.push_back({surface.region, outcomes, surface.under_xor});
        return outcomes;
    }

    /// each(region, how many surfaces may be its own, whether one of them is for certain, whether one is under a xor)
    template <class Each>
    void for_regions(const Each& each) {
        std::sort(trimmed_here_.begin(), trimmed_here_.end());
        for (std::size_t i = 0, next = 0; i < trimmed_here_.size(); i = next) {
            bool certain = false, under_xor = false;
            for (; next < trimmed_here_.size() && trimmed_here_[next].region == trimmed_here_[i].region; ++next) {
                certain = certain || trimmed_here_[next].outcomes == can_be_in;
                under_xor = under_xor || trimmed_here_[next].under_xor;
            }
            each(trimmed_here_[i].region, next - i, certain, under_xor);
        }
    }

    /// Whether the event lies in the zone; where the solids that the ray crosses there decide, both.
    unsigned outcomes_of(const Zone& zone) {
        if (zone.count == 0) return can_be_in;
        const BlistLeaf* const leaves = shared_.leaves.data() + zone.first;
        const auto crosses = [&](std::uint32_t at) { return crosses_[leaves[at].solid] == visit_; };
        const auto next = [&](std::uint32_t at) {
            ++asked_;
            return (covers_[leaves[at].solid] > 0) != leaves[at].complement ? leaves[at].on_true : leaves[at].on_false;
        };
        const auto outcome = [](std::uint32_t at) { return at == BlistLeaf::in ? can_be_in : can_be_out; };
        std::uint32_t at = 0;
        while (at < BlistLeaf::out && !crosses(at)) at = next(at);
        if (at >= BlistLeaf::out) return outcome(at);
        unsigned all = 0;
        places_ = {at};
        while (!places_.empty()) {
            at = *places_.begin();
            places_.erase(places_.begin());
            if (at >= BlistLeaf::out)
                all |= outcome(at);
            else if (crosses(at))
                places_.insert({leaves[at].on_true, leaves[at].on_false});
            else
                places_.insert(next(at));
        }
        return all;
    }

    const Shared& shared_;
    RayEvents events_;
    StepOwners owners_;
    std::vector<Crossing> crossings_;
    std::vector<std::uint32_t> crossing_, open_;
    std::vector<int> covers_;             ///< by solid: segments that the ray is in, before the event
    std::vector<std::uint64_t> crosses_;  ///< by solid: the last visit that crosses it
    std::vector<std::uint32_t> entered_;  ///< by region: the event, or NONE
    std::vector<Trimmed> trimmed_here_;
    std::set<std::uint32_t> places_;
    bool one_place_ = false;
    std::uint64_t visit_ = 0, given_up_ = 0, within_ = 0, trimmed_ = 0, asked_ = 0;
};

}  // namespace

Method cst() {
    return {.name = "CST",
            .source = "Hable and Rossignac 2007",
            .about =
                "Each surface is trimmed by the Blist of its solid's active zone, and what is left is merged by depth. "
                "First hits seen from outside need front faces and zones without u-nodes only. Surfaces in one place "
                "whose zones depend on each other are given up.",
            .breaks =
                "coincident, coplanar and edges: rays are given up. deep_trees: zones have the square of a region's "
                "leaves, and are refused.",
            .knob = "",
            .gives_up = true,
            .prepare = [](const Subject& subject, const TraceOptions& options) {
                Shared shared{{subject, options}};
                shared.surfaces.resize(subject.compiled.solids.size());
                std::uint32_t region = 0;
                for (const PositiveTree& tree : positive_trees(subject.compiled, Grouping::heavy_left, options.planted))
                    ZoneWriter(shared, region++, tree).write();
                return trace_each_ray<Worker>(std::move(shared), options);
            }};
}

}  // namespace csgrt::bench
