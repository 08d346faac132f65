#include "compile/flatten/flatten.hpp"

#include <algorithm>
#include <atomic>
#include <memory>
#include <span>
#include <unordered_map>
#include <unordered_set>
#include <utility>

#include "compile/flatten/flattener.hpp"
#include "compile/flatten/instance_table.hpp"
#include "compile/flatten/appearance_table.hpp"
#include "compile/flatten/region_forest.hpp"
#include "base/erase_at.hpp"
#include "base/identical.hpp"
#include "base/prefetch.hpp"
#include "base/parallel.hpp"
#include "scene/faults/finding_list.hpp"
#include "scene/faults/validate.hpp"
#include "scene/instances.hpp"

namespace csgrt {

namespace {

/// Names for a note: all names if they are few, else the first few.
std::string some(const std::vector<std::string>& names) {
    constexpr std::size_t shown = 5;
    std::string text;
    for (std::size_t i = 0; i < names.size() && i < shown; ++i) text += (i > 0 ? ", " : "") + names[i];
    if (names.size() > shown) text += ", ...";
    return text;
}

std::string counted(std::size_t count, const char* one, const char* many) {
    return std::to_string(count) + " " + (count == 1 ? one : many);
}

std::vector<std::string> fastgen_regions(const FlatScene& flat) {
    std::vector<std::string> names;
    for (const FlatRegion& region : flat.regions)
        if (region.info.fastgen != Fastgen::none)
            names.push_back(region.info.path + (region.info.fastgen == Fastgen::plate ? " (plate)" : " (volume)"));
    return names;
}

/// Numbers equal paths of different regions, so that all paths differ. Returns whether there were equal paths.
bool tell_apart(std::vector<FlatRegion>& regions) {
    std::unordered_set<std::string> taken;
    std::unordered_map<std::string, std::uint32_t> times;
    for (FlatRegion& region : regions) {
        const std::string path = region.info.path;
        while (!taken.insert(region.info.path).second) {
            std::uint32_t& number = times.try_emplace(path, 1).first->second;
            region.info.path = numbered(path, ++number);
        }
    }
    return !times.empty();
}

/// Removes instances that only removed trees used.
void drop_unused(FlatScene& flat) {
    constexpr std::uint32_t unused = 0xffffffff;
    std::vector<std::uint32_t> number(flat.instances.size(), unused);
    std::uint32_t used = 0;
    bool in_order = true;
    for (const FlatRegion& region : flat.regions)
        for (const FlatTree::Node& node : region.tree.nodes)
            if (node.op == Operator::leaf && number[node.solid] == unused) {
                in_order = in_order && node.solid == used;
                number[node.solid] = used++;
            }
    if (in_order && used == flat.instances.size()) return;
    std::fill(number.begin(), number.end(), unused);
    std::vector<Instance> kept;
    for (FlatRegion& region : flat.regions) {
        for (FlatTree::Node& node : region.tree.nodes) {
            if (node.op != Operator::leaf) continue;
            std::uint32_t& to = number[node.solid];
            if (to == unused) {
                to = static_cast<std::uint32_t>(kept.size());
                kept.push_back(flat.instances[node.solid]);
            }
            node.solid = to;
        }
    }
    flat.instances = std::move(kept);
}

}  // namespace

const Shape& shape_of(const Scene& scene, const FlatScene& flat, const Instance& instance) {
    if (!flat.composites.empty())
        if (const auto composite = flat.composites.find(instance.object); composite != flat.composites.end())
            return composite->second.parts[instance.piece].shape;
    return std::get<Solid>(scene.objects[instance.object]).shape;
}

const std::vector<Plane>& cuts_of(const FlatScene& flat, const Instance& instance) {
    static const std::vector<Plane> none;
    const auto composite = flat.composites.find(instance.object);
    return composite != flat.composites.end() ? composite->second.parts[instance.piece].cuts : none;
}

namespace {

/// A term of the expression above some regions. The term is a region, unless it is found to be empty.
struct Term {
    const RegionForest* forest;
    std::uint32_t node;
};

/// The terms that one thread flattens.
struct TermsPart {
    struct Written {
        FlatRegion region;
        Constants constants;
    };
    std::vector<Written> regions;
    FlatPart flat;
};

/// Prefetches the memory that flattening the terms after number `i` will usually read first.
void prefetch_ahead(const Source& source, std::span<const Term> terms, std::size_t i) {
    const Scene& scene = source.scene;
    const auto object_at = [&](std::size_t term) {
        return terms[term].forest->leftmost_start(terms[term].node).object;
    };
    if (i + 2 < terms.size()) prefetch_whole(scene.objects[object_at(i + 2)]);
    if (i + 1 == terms.size() || source.names.is_solid(object_at(i + 1))) return;
    const std::vector<TreeNode>& nodes = std::get<Combination>(scene.objects[object_at(i + 1)]).tree.nodes;
    constexpr std::size_t most = 8;
    for (std::size_t k = 0; k < std::min(nodes.size(), most); ++k) prefetch_whole(nodes[k]);
}

TermsPart flatten_part(const Source& source, std::span<const Term> terms, std::atomic<std::uint64_t>& path_bytes) {
    const Scene& scene = source.scene;
    TermsPart part;
    part.regions.reserve(terms.size());
    Flattener flattener(source, part.flat);
    for (std::size_t i = 0; i < terms.size(); ++i) {
        prefetch_ahead(source, terms, i);
        const auto& [forest, term] = terms[i];
        const RegionStart& start = forest->leftmost_start(term);
        const Object& origin = scene.objects[forest->origin_of(start)];
        TermsPart::Written& written = part.regions.emplace_back();
        FlatRegion& region = written.region;
        written.constants = flattener.write(*forest, term, region.tree);
        region.info =
            describe_region(std::get_if<Combination>(&origin), forest->attributes_of(start), scene.region_colors);
        region.info.path = forest->path(start.path);
        check_path_bytes(path_bytes += region.info.path.size());
    }
    return part;
}

/// A term that is not a region, and the reason.
struct NoRegion {
    std::size_t term;
    bool contains_space;  ///< true: the term holds the space where no solid is; false: it is empty
    std::string path;
    Place place;
};

/// The joiner appends the parts that threads have flattened to the result, in order.
class Joiner {
public:
    Joiner(const Source& source, const std::vector<Term>& terms, FlatScene& result)
        : source_(source), terms_(terms), result_(result), instances_(source.scene.objects.size()) {}

    void add(TermsPart& part) {
        numbers_.clear();
        const std::vector<Matrix>& matrices = result_.matrices.emplace_back(std::move(part.flat.matrices));
        for (const auto& [object, piece, matrix] : part.flat.leaves)
            numbers_.push_back(instances_.number({object, piece, &matrices[matrix]}, result_.instances));
        for (auto& [region, constants] : part.regions) {
            const std::size_t term = next_++;
            const bool contains_space = constants.outside == Value::everything;
            if (constants.value == Value::nothing || contains_space) {
                const RegionStart& start = terms_[term].forest->leftmost_start(terms_[term].node);
                no_regions_.push_back(
                    {term, contains_space, std::move(region.info.path), place_of(source_.scene.objects[start.object])});
                continue;
            }
            for (FlatTree::Node& node : region.tree.nodes)
                if (node.op == Operator::leaf) node.solid = numbers_[node.solid];
            region.term = static_cast<std::uint32_t>(term);
            result_.regions.push_back(std::move(region));
        }
        has_unused_ = has_unused_ || part.flat.has_unused;
        result_.composites.merge(part.flat.composites);
        source_.references.check(references_ += part.flat.references);
    }

    std::vector<NoRegion> take_no_regions() { return std::move(no_regions_); }
    bool has_unused() const { return has_unused_; }

private:
    const Source& source_;
    const std::vector<Term>& terms_;
    FlatScene& result_;
    InstanceTable instances_;
    std::vector<std::uint32_t> numbers_;  ///< of a part's leaves
    std::vector<NoRegion> no_regions_;
    std::size_t next_ = 0;
    std::uint64_t references_ = 0;
    bool has_unused_ = false;
};

/// An object that the caller named.
struct NamedObject {
    std::string name;
    std::uint32_t object;
    std::unique_ptr<RegionForest> forest;  ///< null: an equal object was named before
    std::size_t end;                       ///< number after the object's last term
};

/// The regions that a walk finds.
struct Found {
    std::vector<NamedObject> objects;  ///< in the caller's order
    std::vector<Term> terms;
    double solids = 0;             ///< of all terms
    bool has_equal_paths = false;  ///< some paths may be equal

    /// The number of the object that has a region.
    std::size_t object_of(const FlatRegion& region) const {
        const auto found = std::ranges::upper_bound(objects, std::size_t{region.term}, {}, &NamedObject::end);
        return static_cast<std::size_t>(found - objects.begin());
    }
};

Found find_regions(const Source& source, const std::vector<std::string>& objects, bool air,
                   std::uint64_t max_instances) {
    Found found;
    InstanceLimit limit(source.scene, max_instances);
    const auto check = [&](const std::string& object, double count) {
        if (!limit.allows(count))
            throw Error(Status::scene, std::vector{limit.fault({}, "with object " + object + ", the scene", count)});
    };
    std::unordered_set<std::string> seen;
    for (const std::string& object : objects) {
        const ObjectPath path = find_path(source.scene, source.names, object);
        if (path.steps.empty()) throw Error(Status::scene, path.fault);
        std::string way;
        for (const ObjectPath::Step& step : path.steps)
            way += std::to_string(step.node) + ":" + std::to_string(step.object) + "/";
        NamedObject& named =
            found.objects.emplace_back(NamedObject{object, path.object(), nullptr, found.terms.size()});
        if (!seen.insert(std::move(way)).second) continue;
        check(object, found.solids + static_cast<double>(source.instances[path.object()]));
        named.forest = std::make_unique<RegionForest>(source, path, air);
        found.solids += named.forest->solids_in_terms();
        check(object, found.solids);
        named.forest->for_each_term([&](std::uint32_t term) { found.terms.push_back({named.forest.get(), term}); });
        named.end = found.terms.size();
        // An object may lie inside another named object.
        const bool is_inside = path.steps.size() > 1 && objects.size() > 1;
        found.has_equal_paths = found.has_equal_paths || named.forest->has_equal_paths() || is_inside;
    }
    return found;
}

/// Adds the terms' trees. Returns the terms that are not regions.
std::vector<NoRegion> add_trees(const Source& source, const Found& found, FlatScene& result) {
    const std::vector<Term>& terms = found.terms;
    reserve_cleared(result.instances, std::min(source.scene.objects.size(),
                                               static_cast<std::size_t>(found.solids)));  // at most, nearly always
    result.regions.reserve(terms.size());
    Joiner joiner(source, terms, result);
    constexpr std::size_t part_size = 512;
    std::atomic<std::uint64_t> path_bytes = 0;
    for_chunks_in_order(
        terms.size(), part_size, 0,
        [&](std::size_t first, std::size_t last) {
            return flatten_part(source, std::span(terms).subspan(first, last - first), path_bytes);
        },
        [&](TermsPart& part) { joiner.add(part); });
    if (joiner.has_unused()) drop_unused(result);
    if (source.names.has_ambiguous_names() || found.has_equal_paths)
        result.has_numbered_paths = tell_apart(result.regions);
    if (const std::vector<Look>& looks = source.scene.looks; !looks.empty()) {
        const AppearanceTable table(looks);
        for_chunks(result.regions.size(), part_size, 0, [&](std::size_t first, std::size_t last, std::size_t) {
            for (std::size_t i = first; i < last; ++i) table.apply(result.regions[i].info);
        });
    }
    const auto before = [](const FlatRegion& a, const FlatRegion& b) { return rank_of(a.info) < rank_of(b.info); };
    if (!std::is_sorted(result.regions.begin(), result.regions.end(), before))
        std::stable_sort(result.regions.begin(), result.regions.end(), before);
    return joiner.take_no_regions();
}

/// Adds the warnings. Throws Error (scene): see flatten.
void add_warnings(const Source& source, const Found& found, const std::vector<NoRegion>& no_regions,
                  FlatScene& result) {
    const Scene& scene = source.scene;
    std::vector<std::string> empty_regions, air_regions;
    FindingList findings;
    const auto warn = [&](std::string object, const Place& place, std::string reason) {
        result.warnings.push_back({std::move(object), place, std::move(reason), 1});
    };
    const auto contains_space = [&](const char* what, const std::string& name, const Place& place) {
        if (scene.lenient)
            return warn(name, place,
                        std::string("left out: the ") + what + " contains the empty space where no solid is");
        findings.add({place,
                      std::string(what) + " " + name + " contains the empty space where no solid is",
                      "intersect the complement with something that bounds it",
                      {}});
    };
    std::size_t term = 0;
    auto next = no_regions.begin();
    for (const auto& [name, object, forest, end] : found.objects) {
        if (forest == nullptr) {
            warn(name, {}, "named twice; it is rendered once");
            continue;
        }
        const std::vector<std::string>& air = forest->air_regions();
        air_regions.insert(air_regions.end(), air.begin(), air.end());
        if (forest->is_everything()) contains_space("object", name, place_of(scene.objects[object]));
        for (; next != no_regions.end() && next->term < end; ++next) {
            if (next->contains_space) {
                contains_space("region", next->path, next->place);
            } else {
                empty_regions.push_back(next->path);
            }
        }
        if (term == end && air.empty() && findings.empty() && !forest->is_everything() &&
            source.names.kind(object) != Names::Kind::left_out)
            warn(name, {}, "the object holds no solid");
        term = end;
    }
    if (!findings.empty()) throw Error(Status::scene, findings.take());
    if (const std::vector<std::string> fastgen = fastgen_regions(result); !fastgen.empty())
        warn({}, {},
             counted(fastgen.size(), "FASTGEN region", "FASTGEN regions") + ", " + some(fastgen) +
                 ": plain regions are before plates, plates before volumes, then the first in the model; "
                 "FASTGEN's rules of thickness along the ray are not followed");
    if (!air_regions.empty())
        warn({}, {}, counted(air_regions.size(), "air region", "air regions") + " left out: " + some(air_regions));
    if (!empty_regions.empty())
        warn({}, {},
             counted(empty_regions.size(), "region without solids", "regions without solids") +
                 " left out: " + some(empty_regions));
}

}  // namespace

struct FlatWalk {
    Source source;
    Found found = {};
    std::vector<std::uint32_t> uses = {};  ///< leaves of each instance, once they are counted
};

FlatScene flatten(const Scene& scene, const Names& names, const std::vector<std::uint64_t>& instances,
                  const std::vector<std::string>& objects, bool air, std::uint64_t max_instances) {
    FlatScene result;
    result.walk =
        std::make_shared<FlatWalk>(FlatWalk{.source = {scene, names, instances, ReferenceLimit(scene, max_instances)}});
    const Source& source = result.walk->source;
    const Found& found = result.walk->found = find_regions(source, objects, air, max_instances);
    const std::vector<NoRegion> no_regions = add_trees(source, found, result);
    add_warnings(source, found, no_regions, result);
    return result;
}

namespace {

/// The regions to which changed members lead, or which have them.
std::vector<std::uint32_t> regions_with(const FlatScene& flat, const ChangedMembers& changed) {
    const auto& [source, found, uses] = *flat.walk;
    std::vector<bool> has(source.scene.objects.size());
    for (const Member& member : changed.all)
        if (member.second != Names::none) has[member.first] = true;
    for (bool grows = true; grows;) {
        grows = false;
        for (std::uint32_t object = 0; object < has.size(); ++object) {
            if (has[object]) continue;
            for (const std::uint32_t child : source.names.children(object))
                if (child < Names::left_out && has[child]) has[object] = grows = true;
        }
    }
    for (const NamedObject& named : found.objects)
        if (named.forest) named.forest->place_again(changed);
    std::vector<std::uint32_t> regions;
    for (std::uint32_t i = 0; i < flat.regions.size(); ++i) {
        const auto& [forest, node] = found.terms[flat.regions[i].term];
        const auto concerns = [&, &walked = *forest](const RegionStart& start) {
            return has[start.object] || walked.has_moved(start);
        };
        if (forest->any_start(node, concerns)) regions.push_back(i);
    }
    return regions;
}

void count_uses(const FlatScene& flat) {
    std::vector<std::uint32_t>& uses = flat.walk->uses;
    if (!uses.empty()) return;
    uses.resize(flat.instances.size());
    for (const FlatRegion& region : flat.regions)
        for (const FlatTree::Node& node : region.tree.nodes) uses[node.solid] += node.op == Operator::leaf;
}

/// Whether one of these instances is equal to another.
bool has_equal(const FlatScene& flat, const std::vector<std::uint32_t>& moved) {
    const auto place_of = [](const Instance& instance) {
        const Matrix& m = *instance.matrix;
        return std::hash<double>{}(m[3]) ^ 3 * std::hash<double>{}(m[7]) ^ 5 * std::hash<double>{}(m[11]);
    };
    std::unordered_multimap<std::size_t, std::uint32_t> places;
    for (const std::uint32_t i : moved) places.emplace(place_of(flat.instances[i]), i);
    for (std::uint32_t i = 0; i < flat.instances.size(); ++i) {
        const Instance& a = flat.instances[i];
        for (auto [place, end] = places.equal_range(place_of(a)); place != end; ++place) {
            const Instance& b = flat.instances[place->second];
            if (place->second != i && a.object == b.object && a.piece == b.piece && *a.matrix == *b.matrix) return true;
        }
    }
    return false;
}

}  // namespace

std::optional<Moved> place_again(FlatScene& flat, const ChangedMembers& changed) {
    auto& [source, found, uses] = *flat.walk;
    Moved moved;
    moved.regions = regions_with(flat, changed);
    if (constexpr std::size_t few = 64; moved.regions.size() > std::max(few, flat.regions.size() / 4)) return {};
    FlatPart part;
    Flattener flattener(source, part);
    std::unordered_map<std::uint32_t, std::pair<std::uint32_t, std::uint32_t>> places;  // by instance: matrix, leaves
    for (const std::uint32_t region : moved.regions) {
        const auto& [forest, term] = found.terms[flat.regions[region].term];
        const std::vector<FlatTree::Node>& nodes = flat.regions[region].tree.nodes;
        FlatTree tree;
        flattener.write(*forest, term, tree);
        if (tree.nodes.size() != nodes.size()) return {};
        for (std::size_t i = 0; i < nodes.size(); ++i) {
            if (nodes[i].op != Operator::leaf) continue;
            const std::uint32_t matrix = part.leaves[tree.nodes[i].solid].matrix;
            auto& [known, leaves] = places.try_emplace(nodes[i].solid, matrix, 0).first->second;
            if (!same_bits(part.matrices[known], part.matrices[matrix])) return {};
            ++leaves;
        }
    }
    count_uses(flat);
    for (const auto& [instance, place] : places) {
        const auto& [matrix, leaves] = place;
        if (same_bits(*flat.instances[instance].matrix, part.matrices[matrix])) continue;
        if (leaves != uses[instance]) return {};
        moved.instances.push_back(instance);
    }
    std::sort(moved.instances.begin(), moved.instances.end());
    std::vector<const Matrix*> earlier;
    for (const std::uint32_t i : moved.instances)
        earlier.push_back(std::exchange(flat.instances[i].matrix, &part.matrices[places.at(i).first]));
    const bool are_equal = has_equal(flat, moved.instances);
    for (std::size_t k = 0; k < earlier.size(); ++k) {
        const std::uint32_t i = moved.instances[k];
        const Matrix*& matrix = flat.instances[i].matrix;
        if (are_equal) {
            matrix = earlier[k];
        } else {
            auto own = std::make_unique<Matrix>(*matrix);
            matrix = own.get();
            flat.placed_again[i] = std::move(own);
        }
    }
    return are_equal ? std::nullopt : std::optional(std::move(moved));
}

std::optional<Moved> take_out(FlatScene& flat, const std::vector<Member>& removed) {
    auto& [source, found, uses] = *flat.walk;
    Moved gone;
    gone.regions = regions_with(flat, {removed, {}});
    std::vector<bool> has_some(found.objects.size());  // an object that is rendered and has none gets a warning
    for (std::uint32_t i = 0; i < flat.regions.size(); ++i)
        if (!std::ranges::binary_search(gone.regions, i)) has_some[found.object_of(flat.regions[i])] = true;
    for (const std::uint32_t i : gone.regions)
        if (!has_some[found.object_of(flat.regions[i])]) return {};
    count_uses(flat);
    for (const std::uint32_t region : gone.regions) {
        const auto& [forest, term] = found.terms[flat.regions[region].term];
        const auto stays = [&walked = *forest](const RegionStart& start) { return !walked.has_moved(start); };
        if (forest->any_start(term, stays)) return {};
        for (const FlatTree::Node& node : flat.regions[region].tree.nodes)
            if (node.op == Operator::leaf && --uses[node.solid] == 0) gone.instances.push_back(node.solid);
    }
    for (const std::uint32_t region : gone.regions)  // an instance that is left might have another place in the order
        for (const FlatTree::Node& node : flat.regions[region].tree.nodes)
            if (node.op == Operator::leaf && uses[node.solid] > 0) return {};
    std::sort(gone.instances.begin(), gone.instances.end());
    erase_at(flat.regions, gone.regions);
    return gone;
}

FlatScene flatten(const Scene& scene, const std::vector<std::string>& objects, bool air) {
    Names names(scene);
    std::vector<Warning> warnings;
    const Validated validated = validate(scene, names, objects, true, warnings);
    return flatten(scene, names, validated.instances, objects, air);
}

}  // namespace csgrt
