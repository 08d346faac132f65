// Which tree belongs to which region, by BRL-CAD's rules.
//
// The walk goes down from a named object. A combination flagged as a region, or a solid, ends it: there a region
// starts. What stands above is an expression over such starts. Unions there only collect regions; where another
// operator stands above regions, unions are pulled up through it until they alone stand on top:
//
//     (A u B) - C  ->  (A - C) u (B - C)
//     (A u B) + C  ->  (A + C) u (B + C)
//     C + (A u B)  ->  (C + A) u (C + B)
//
// (C - (A u B) stays; xor and complement do not distribute.) Each term is one region: its tree the whole term with the
// trees of all its starts, everything else that of its leftmost start.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

#include "compile/flatten/attributes.hpp"
#include "compile/flatten/fold.hpp"
#include "scene/names.hpp"
#include "scene/object_path.hpp"
#include "scene/walk.hpp"

namespace csgrt {

/// How often trees may lead to combinations and solids.
class ReferenceLimit {
public:
    ReferenceLimit(const Scene& scene, std::uint64_t max_instances);
    /// Throws Error (scene) if that is more often than any model of so many instances does.
    void check(std::uint64_t count) const;

private:
    std::uint64_t most_;
};

/// Throws Error (scene) if the paths of all regions have so many bytes.
void check_path_bytes(std::uint64_t bytes);

/// What regions are found in. All of it outlives who reads it.
struct Source {
    const Scene& scene;
    const Names& names;
    const std::vector<std::uint64_t>& instances;  ///< see Validated
    ReferenceLimit references;
};

/// Where a region starts: a combination with the region flag, or a solid outside all regions.
struct RegionStart {
    std::uint32_t object;
    std::uint32_t path;   ///< see RegionForest::path
    std::uint32_t above;  ///< the combination that uses it, as RegionForest numbers them
    std::uint32_t node;   ///< of that one's tree
};

/// The expression over region starts that stands above the regions of one named object.
class RegionForest {
public:
    /// Walks down from where a path leads. Throws Error (scene) if there are more references than any model has.
    RegionForest(const Source& source, const ObjectPath& object, bool air);

    /// How many solids the trees of all terms hold together. Pulling unions up may multiply them.
    double solids_in_terms() const;

    /// leaf: `left` is a start. Complement: `left` is the operand.
    struct Node {
        Operator op = Operator::leaf;
        std::uint32_t left = 0, right = 0;
    };
    /// Calls with the topmost node of each term, in BRL-CAD's order of regions.
    void for_each_term(const std::function<void(std::uint32_t)>& call);
    /// The expression is true even where no solid is.
    bool is_everything() const { return root_.value == Value::everything; }

    /// The paths of air regions that are left out.
    const std::vector<std::string>& air_regions() const { return air_regions_; }

    const Node& node(std::uint32_t number) const { return nodes_[number]; }
    const RegionStart& start(std::uint32_t number) const { return starts_[number]; }
    const RegionStart& leftmost_start(std::uint32_t node) const { return starts_[leftmost(node)]; }
    /// The object whose id, air code and the like a region has: where it starts, or the region that the path to the
    /// named object leads through.
    std::uint32_t origin_of(const RegionStart& start) const { return inside_ == none ? start.object : inside_; }
    /// Where it stands, and what it and all above have set. Left to those who need them, since the walk is one
    /// thread's.
    Matrix matrix_of(const RegionStart& start) const;
    Attributes attributes_of(const RegionStart& start) const;
    /// "/top/.../name": what the legs are called on the way.
    std::string path(std::uint32_t number) const;
    /// Several terms have one leftmost start, and so one path. Known when for_each_term() has been called.
    bool has_equal_paths() const { return has_equal_paths_; }

private:
    static constexpr std::uint32_t none = 0xffffffff;

    /// Of an expression that is a constant there is no node.
    struct Operand {
        Value value;
        std::uint32_t node;
    };
    /// A combination above regions, in one of its places.
    struct Above {
        std::uint32_t object;
        Matrix matrix;
        Attributes attributes;
    };
    struct Level {
        std::uint32_t above, path;
        std::size_t first_start;  ///< number of the first start below
    };
    using Open = Walk<Level>::Open;
    friend class Walk<Level>;
    struct PathStep {
        std::uint32_t above, object;
        std::uint32_t node;  ///< the leaf that leads here, of the tree of the step above
    };

    /// Where a path leads, with what is above it.
    RegionStart start_of(const ObjectPath& path);
    /// `start`: with the path of what is above it. Returns the level if it is a combination to walk.
    std::optional<Level> visit(RegionStart start);
    // The visitor of the walk.
    std::optional<Level> follow(const Open& parent, std::uint32_t node, std::uint32_t child);
    void operate(const Open& parent, std::uint32_t node);
    void nothing() { operands_.push_back({Value::nothing, none}); }
    void leave(const Open& done);

    std::uint32_t leftmost(std::uint32_t node) const;
    std::uint32_t add_node(Operator op, std::uint32_t left, std::uint32_t right = 0);

    const Source& source_;
    bool air_;
    std::unordered_map<std::uint32_t, Value> hollow_;  ///< combinations without starts, and the constant they are
    std::vector<Above> above_;
    std::vector<Operand> operands_;
    Operand root_ = {Value::nothing, none};
    std::uint32_t inside_ = none;  ///< the region that the named object is a part of, where a path says so
    std::vector<Node> nodes_;
    std::vector<RegionStart> starts_;
    std::vector<PathStep> paths_;
    std::vector<std::string> air_regions_;
    std::uint64_t air_path_bytes_ = 0;
    bool has_equal_paths_ = false;
};

}  // namespace csgrt
