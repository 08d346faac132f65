#include "compile/flatten.hpp"

#include <cstring>
#include <unordered_map>
#include <unordered_set>

#include "compile/cells.hpp"
#include "compile/linear.hpp"
#include "compile/linearize.hpp"
#include "compile/regions.hpp"
#include "formats/source.hpp"
#include "scene/vector.hpp"

namespace csgrt {

namespace {

// Deep hierarchies hold more references than solids, though not many times more.
constexpr std::uint64_t reference_limit = 16 * Limits::instances;

/// A name list for a note: all of a few, the first few of many.
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

/// The instances of a scene, each once.
class InstanceTable {
public:
    explicit InstanceTable(std::size_t objects) : first_(objects, none) {}

    /// The number of the instance in `all`, to which it is added if it is new.
    std::uint32_t number(const Instance& instance, std::vector<Instance>& all) {
        const auto next = static_cast<std::uint32_t>(all.size());
        std::uint32_t& first = first_[instance.object];
        if (first == none) {
            first = next;
            others_.push_back(none);
            all.push_back(instance);
            return next;
        }
        // Not the only place of its object: looked up among those that are not the first ones.
        if (equal(all[first], instance)) return first;
        const std::uint64_t hash = hash_of(instance);
        const std::uint32_t last = cells_.find(hash);
        for (std::uint32_t i = last; i != none; i = others_[i])
            if (equal(all[i], instance)) return i;
        others_.push_back(last);
        cells_.exchange(hash, next);
        all.push_back(instance);
        return next;
    }

private:
    static constexpr std::uint32_t none = CellTable::none;

    static bool equal(const Instance& a, const Instance& b) {
        return a.object == b.object && a.piece == b.piece && a.matrix == b.matrix;
    }
    static std::uint64_t hash_of(const Instance& instance) {
        std::uint64_t hash = (14695981039346656037u ^ instance.object) * 1099511628211u ^ instance.piece;
        for (const double value : instance.matrix) {
            std::uint64_t bits;
            std::memcpy(&bits, &value, sizeof bits);
            hash = (hash ^ bits) * 1099511628211u;
            hash ^= hash >> 29;
        }
        return hash;
    }

    std::vector<std::uint32_t> first_;   ///< one an object: its first instance
    CellTable cells_;                    ///< of those that are not: the last one of each hash
    std::vector<std::uint32_t> others_;  ///< one an instance: the one before it of the same hash
};

/// Writes the tree of one term in postfix order, dropping what is empty (or everything) on the way.
class Flattener {
public:
    Flattener(const Scene& scene, const ObjectIndex& index, bool skip_unsupported, FlatScene& result)
        : scene_(scene),
          index_(index),
          skip_unsupported_(skip_unsupported),
          result_(result),
          instances_(scene.objects.size()) {}

    enum class Kind { tree, nothing, everything };
    Kind write(const RegionForest& forest, std::uint32_t term, FlatTree& tree);

private:
    /// The nodes of an operand start at `first` and end where the next one's start. A constant has none.
    struct Operand {
        std::size_t first;
        Kind kind;
    };
    struct Frame {
        const Combination* combination;
        std::uint32_t object;
        Matrix matrix;
        std::size_t next;
        std::uint64_t first_leaf;  ///< number of the first leaf below
    };

    void expand(std::uint32_t object, const Matrix& matrix);
    void enter(std::uint32_t object, const Matrix& matrix);
    void operate(Operator op, std::uint32_t arity);
    void append(Operator op, std::size_t arity);
    std::uint32_t instance_of(std::uint32_t object, std::uint32_t piece, const Matrix& matrix);

    const Scene& scene_;
    const ObjectIndex& index_;
    const bool skip_unsupported_;
    FlatScene& result_;
    FlatTree* tree_ = nullptr;
    std::vector<Operand> operands_;
    std::vector<Frame> frames_;
    InstanceTable instances_;
    std::unordered_map<const Combination*, Kind> hollow_;  ///< without solids below, and the constant that they are
    std::unordered_set<std::uint32_t> skipped_;
    std::uint64_t references_ = 0, leaves_ = 0;
};

Flattener::Kind Flattener::write(const RegionForest& forest, std::uint32_t term, FlatTree& tree) {
    tree_ = &tree;
    operands_.clear();
    struct Task {
        std::uint32_t node;
        bool operands_done;
    };
    std::vector<Task> tasks{{term, false}};
    while (!tasks.empty()) {
        const auto [number, operands_done] = tasks.back();
        tasks.pop_back();
        const RegionForest::Node& node = forest.node(number);
        if (node.op == Operator::leaf) {
            const RegionStart& start = forest.start(node.left);
            expand(start.object, start.matrix);
        } else if (operands_done) {
            operate(node.op, node.op == Operator::not_ ? 1 : 2);
        } else {
            tasks.push_back({number, true});
            if (node.op != Operator::not_) tasks.push_back({node.right, false});
            tasks.push_back({node.left, false});
        }
    }
    return operands_.back().kind;
}

void Flattener::expand(std::uint32_t object, const Matrix& matrix) {
    enter(object, matrix);
    while (!frames_.empty()) {
        Frame& frame = frames_.back();
        const std::vector<TreeNode>& nodes = frame.combination->tree.nodes;
        if (frame.next == nodes.size()) {
            if (nodes.empty()) operands_.push_back({tree_->nodes.size(), Kind::nothing});
            if (leaves_ == frame.first_leaf) hollow_.emplace(frame.combination, operands_.back().kind);
            frames_.pop_back();
            continue;
        }
        const std::size_t number = frame.next++;
        const TreeNode& node = nodes[number];
        if (node.op == Operator::leaf) {
            enter(index_.child(frame.object, number), compose(frame.matrix, node.matrix));
        } else {
            operate(node.op, node.arity);
        }
    }
}

void Flattener::enter(std::uint32_t object, const Matrix& matrix) {
    if (++references_ > reference_limit)
        throw Error(Status::scene,
                    "more than " + std::to_string(reference_limit) + " references to combinations and solids");
    if (const auto* combination = std::get_if<Combination>(&scene_.objects[object])) {
        if (const auto known = hollow_.find(combination); known != hollow_.end()) {
            operands_.push_back({tree_->nodes.size(), known->second});
        } else {
            frames_.push_back({combination, object, matrix, 0, leaves_});
        }
        return;
    }
    const Shape& shape = std::get<Solid>(scene_.objects[object]).shape;
    if (const auto* unsupported = std::get_if<Unsupported>(&shape); unsupported && skip_unsupported_) {
        if (skipped_.insert(object).second) {
            result_.skipped.push_back(name_of(scene_.objects[object]) + " (" + unsupported->type + ")" +
                                      (frames_.empty() ? "" : ", used by " + frames_.back().combination->name));
        }
        operands_.push_back({tree_->nodes.size(), Kind::nothing});
        return;
    }
    ++leaves_;
    operands_.push_back({tree_->nodes.size(), Kind::tree});
    if (!std::holds_alternative<Pipe>(shape) && !std::holds_alternative<Cline>(shape)) {
        tree_->nodes.push_back({Operator::leaf, 0, instance_of(object, 0, matrix)});
        return;
    }
    auto known = result_.composites.find(object);
    if (known == result_.composites.end()) known = result_.composites.emplace(object, pieces_of(shape)).first;
    for (FlatTree::Node node : known->second.tree.nodes) {
        if (node.op == Operator::leaf) node.solid = instance_of(object, node.solid, matrix);
        tree_->nodes.push_back(node);
    }
}

std::uint32_t Flattener::instance_of(std::uint32_t object, std::uint32_t piece, const Matrix& matrix) {
    Instance instance{object, piece, matrix};
    for (double& value : instance.matrix) value += 0.0;  // -0 and 0 are one place
    return instances_.number(instance, result_.instances);
}

void Flattener::append(Operator op, std::size_t arity) {
    tree_->nodes.push_back({op, static_cast<std::uint32_t>(arity), 0});
}

void Flattener::operate(Operator op, std::uint32_t arity) {
    const std::size_t base = operands_.size() - arity;
    const std::size_t first = operands_[base].first;
    const Kind left = operands_[base].kind;
    std::size_t trees = 0, wholes = 0;  // among the operands; the left one of a difference apart
    for (std::size_t i = base + (op == Operator::difference ? 1 : 0); i < operands_.size(); ++i) {
        if (operands_[i].kind == Kind::tree) ++trees;
        if (operands_[i].kind == Kind::everything) ++wholes;
    }
    const std::size_t empties = arity - trees - wholes;
    operands_.resize(base);

    Kind result = Kind::tree;
    bool complement = false;
    switch (op) {
        case Operator::union_:
            result = wholes > 0 ? Kind::everything : trees > 0 ? Kind::tree : Kind::nothing;
            break;
        case Operator::intersection:
            result = empties > 0 ? Kind::nothing : trees > 0 ? Kind::tree : Kind::everything;
            break;
        case Operator::difference:
            if (left == Kind::nothing || wholes > 0) {
                result = Kind::nothing;
            } else if (left == Kind::everything) {
                op = Operator::union_;
                complement = true;
                result = trees > 0 ? Kind::tree : Kind::nothing;
            } else {
                ++trees;
            }
            break;
        case Operator::xor_:
            result = trees > 0 ? Kind::tree : Kind::nothing;
            complement = wholes % 2 == 1;
            break;
        default:  // not
            complement = true;
            result = left;
            break;
    }
    if (result == Kind::tree) {
        if (trees > 1) append(op, trees);
        if (complement) append(Operator::not_, 1);
    } else {
        tree_->nodes.resize(first);
        if (complement) result = result == Kind::nothing ? Kind::everything : Kind::nothing;
    }
    operands_.push_back({first, result});
}

/// Instances that only dropped parts of trees used are dropped, too.
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
    if (composite != flat.composites.end()) return composite->second.pieces[instance.piece].shape;
    return std::get<Solid>(scene.objects[instance.object]).shape;
}

const std::vector<Plane>& cuts_of(const FlatScene& flat, const Instance& instance) {
    static const std::vector<Plane> none;
    const auto composite = flat.composites.find(instance.object);
    return composite != flat.composites.end() ? composite->second.pieces[instance.piece].cuts : none;
}

FlatScene flatten(const Scene& scene, const Names& names, const std::vector<std::string>& objects, bool air,
                  bool skip_unsupported) {
    FlatScene result;
    ObjectIndex index(scene, names);
    result.instances.reserve(scene.objects.size());
    Flattener flattener(scene, index, skip_unsupported, result);
    std::vector<std::string> air_regions, empty_regions;
    std::vector<Diagnostic> findings;
    const auto contains_space = [&](const std::string& what, const Place& place) {
        if (findings.size() == Findings::limit) return;
        findings.push_back({place,
                            what + " contains the empty space where no solid is",
                            "intersect the complement with something that bounds it",
                            {}});
    };

    double solids = 0;
    const auto check = [](const std::string& object, double count) {
        if (count > static_cast<double>(Limits::instances)) {
            throw Error(Status::scene, "with object " + object + ", the trees of all regions hold more than " +
                                           std::to_string(Limits::instances) + " solids together");
        }
    };

    std::unordered_set<std::string_view> seen;
    for (const std::string& object : objects) {
        if (!seen.insert(object).second) {
            result.notes.push_back("object " + object + " is named twice; it is rendered once");
            continue;
        }
        const std::size_t air_before = air_regions.size();
        const std::size_t regions_before = result.regions.size(), empty_before = empty_regions.size();
        check(object, solids + index.solids_below(index.find(object)));
        RegionForest forest(scene, index, object, air, air_regions);
        solids += forest.solids_in_terms();
        check(object, solids);
        if (forest.is_everything()) contains_space("object " + object, place_of(scene.objects[index.find(object)]));
        forest.for_each_term([&](std::uint32_t term) {
            const RegionStart& start = forest.leftmost_start(term);
            const Object& origin = scene.objects[start.object];
            FlatRegion region;
            const Flattener::Kind kind = flattener.write(forest, term, region.tree);
            region.info = describe_region(std::get_if<Combination>(&origin), start.attributes, scene.region_colors);
            region.info.path = forest.path(start.path);
            region.place = place_of(origin);
            if (kind == Flattener::Kind::nothing) {
                empty_regions.push_back(region.info.path);
            } else if (kind == Flattener::Kind::everything || contains_empty_space(region.tree)) {
                contains_space("region " + region.info.path, region.place);
            } else {
                result.regions.push_back(std::move(region));
            }
        });
        if (result.regions.size() == regions_before && empty_regions.size() == empty_before &&
            air_regions.size() == air_before && findings.empty())
            result.notes.push_back("object " + object + " holds no solid");
    }
    if (!findings.empty()) throw Error(Status::scene, std::move(findings));
    if (!air_regions.empty())
        result.notes.push_back(counted(air_regions.size(), "air region", "air regions") +
                               " left out: " + some(air_regions));
    if (!empty_regions.empty())
        result.notes.push_back(counted(empty_regions.size(), "region without solids", "regions without solids") +
                               " left out: " + some(empty_regions));
    drop_unused(result);
    return result;
}

}  // namespace csgrt
