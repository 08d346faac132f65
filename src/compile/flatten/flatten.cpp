#include "compile/flatten/flatten.hpp"

#include <algorithm>
#include <atomic>
#include <memory>
#include <span>
#include <unordered_map>
#include <unordered_set>

#include "compile/flatten/flattener.hpp"
#include "compile/flatten/instance_table.hpp"
#include "compile/flatten/appearance_table.hpp"
#include "compile/flatten/region_forest.hpp"
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

/// Numbers equal paths of different regions, so that all paths differ.
void tell_apart(std::vector<FlatRegion>& regions) {
    std::unordered_set<std::string> taken;
    std::unordered_map<std::string, std::uint32_t> times;
    for (FlatRegion& region : regions) {
        const std::string path = region.info.path;
        while (!taken.insert(region.info.path).second) {
            std::uint32_t& number = times.try_emplace(path, 1).first->second;
            region.info.path = numbered(path, ++number);
        }
    }
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
    const auto composite = flat.composites.find(instance.object);
    if (composite != flat.composites.end()) return composite->second.parts[instance.piece].shape;
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
    const std::string& name;
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
        for (const ObjectPath::Step& step : path.steps) way += std::to_string(step.object) + "/";
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
    if (source.names.has_ambiguous_names() || found.has_equal_paths) tell_apart(result.regions);
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

FlatScene flatten(const Scene& scene, const Names& names, const std::vector<std::uint64_t>& instances,
                  const std::vector<std::string>& objects, bool air, std::uint64_t max_instances) {
    FlatScene result;
    const Source source{scene, names, instances, ReferenceLimit(scene, max_instances)};
    const Found found = find_regions(source, objects, air, max_instances);
    const std::vector<NoRegion> no_regions = add_trees(source, found, result);
    add_warnings(source, found, no_regions, result);
    return result;
}

FlatScene flatten(const Scene& scene, const std::vector<std::string>& objects, bool air) {
    Names names(scene);
    std::vector<Warning> warnings;
    const Validated validated = validate(scene, names, objects, true, warnings);
    return flatten(scene, names, validated.instances, objects, air);
}

}  // namespace csgrt
