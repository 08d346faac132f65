// Region forest: finds the regions below a named object and their trees, by BRL-CAD's rules.
//
// The walk goes down from a named object. At a combination that is flagged as a region, or at a solid, the walk ends:
// there a region starts. The combinations above form an expression over these starts. Unions in it only collect
// regions. Where another operator is above regions, unions are pulled up through it until all unions are on top:
//
//     (A u B) - C  ->  (A - C) u (B - C)
//     (A u B) + C  ->  (A + C) u (B + C)
//     C + (A u B)  ->  (C + A) u (C + B)
//
// (C - (A u B) is left as it is; xor and complement do not distribute.) Each term is one region. The region's tree is
// the whole term with the trees of all its starts; its other attributes come from its leftmost start.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

#include "compile/flatten/attributes.hpp"
#include "compile/flatten/flatten.hpp"
#include "compile/flatten/fold.hpp"
#include "scene/names.hpp"
#include "scene/object_path.hpp"
#include "scene/walk.hpp"

namespace csgrt {

/// A limit on the references to combinations and solids in a scene's trees.
class ReferenceLimit {
public:
    ReferenceLimit(const Scene& scene, std::uint64_t max_instances);
    /// Throws Error (scene) if the count is more than a model of so many instances can have.
    void check(std::uint64_t count) const;

private:
    std::uint64_t most_;
};

/// Throws Error (scene) if the paths of all regions together have too many bytes.
void check_path_bytes(std::uint64_t bytes);

/// The scene that a walk reads, with tables about it. They must outlive the reader.
struct Source {
    const Scene& scene;
    const Names& names;
    const std::vector<std::uint64_t>& instances;  ///< see Validated
    ReferenceLimit references;
};

/// The object in which a region begins on the walk down: a combination with the region flag, or a solid that no such
/// combination contains.
struct RegionStart {
    std::uint32_t object;
    std::uint32_t path;   ///< see RegionForest::path
    std::uint32_t above;  ///< number of the combination that uses the object, in RegionForest
    std::uint32_t node;   ///< of the combination's tree
};

/// The expression over region starts above the regions of one named object.
class RegionForest {
public:
    /// Walks down from the object at a path. Throws Error (scene) if there are more references than ReferenceLimit
    /// allows.
    RegionForest(const Source& source, const ObjectPath& object, bool air);

    /// The number of solids in the trees of all terms together. Pulling unions up may multiply them.
    double solids_in_terms() const;

    /// A node of the expression. In a leaf `left` is a start. In a complement `left` is the operand.
    struct Node {
        Operator op = Operator::leaf;
        std::uint32_t left = 0, right = 0;
    };
    /// Calls `call` with the topmost node of each term, in BRL-CAD's order of regions.
    void for_each_term(const std::function<void(std::uint32_t)>& call);
    /// Whether the expression is true even where no solid is.
    bool is_everything() const { return root_.value == Value::everything; }

    /// The paths of air regions that are left out.
    const std::vector<std::string>& air_regions() const { return air_regions_; }

    const Node& node(std::uint32_t number) const { return nodes_[number]; }
    const RegionStart& start(std::uint32_t number) const { return starts_[number]; }
    const RegionStart& leftmost_start(std::uint32_t node) const { return starts_[leftmost(node)]; }
    /// The object that gives a region its id, air code and so on: the start's object, or the region that contains the
    /// named object by its path.
    std::uint32_t origin_of(const RegionStart& start) const { return inside_ == none ? start.object : inside_; }
    /// The matrix of a start, and the attributes that the start's object and all combinations above have set. They are
    /// not stored: the threads that need them compute them, since only one thread walks.
    Matrix matrix_of(const RegionStart& start) const;
    Attributes attributes_of(const RegionStart& start) const;
    /// Places the combinations above regions again, when the matrices of some members have changed.
    void place_again(const ChangedMembers& changed);
    /// Whether one of these members leads to the start.
    bool has_moved(const RegionStart& start) const;
    /// Whether `is` holds for a start of a term.
    bool any_start(std::uint32_t node, const std::function<bool(const RegionStart&)>& is) const;
    /// "/top/.../name": the names of the members on the way.
    std::string path(std::uint32_t number) const;
    /// True if several terms have the same leftmost start, and so the same path. Known after for_each_term().
    bool has_equal_paths() const { return has_equal_paths_; }

private:
    static constexpr std::uint32_t none = 0xffffffff;

    /// An operand of an expression. A constant has no node.
    struct Operand {
        Value value;
        std::uint32_t node;
    };
    /// A combination above regions, at one position of the walk.
    struct Above {
        std::uint32_t object;
        Matrix matrix;
        Attributes attributes;
        RegionStart start;  ///< itself
        bool has_moved = false;
    };
    struct Level {
        std::uint32_t above, path;
        std::size_t first_start;  ///< number of the first start below
    };
    using Open = Walk<Level>::Open;
    friend class Walk<Level>;
    struct PathStep {
        std::uint32_t above, object;
        std::uint32_t node;  ///< the leaf, in the tree above, that refers to the object
    };

    /// The start at the end of a path, with the combinations above it.
    RegionStart start_of(const ObjectPath& path);
    /// Visits an object. `start.path` is the path of the combination above. Returns the level if the object is a
    /// combination to walk.
    std::optional<Level> visit(RegionStart start);
    // The visitor of the walk calls this for each child.
    std::optional<Level> follow(const Open& parent, std::uint32_t node, std::uint32_t child);
    void operate(const Open& parent, std::uint32_t node);
    void nothing() { operands_.push_back({Value::nothing, none}); }
    void leave(const Open& done);

    std::uint32_t leftmost(std::uint32_t node) const;
    std::uint32_t add_node(Operator op, std::uint32_t left, std::uint32_t right = 0);

    const Source& source_;
    bool air_;
    std::unordered_map<std::uint32_t, Value> constants_;  ///< of combinations without starts
    std::vector<Above> above_;
    std::vector<Operand> operands_;
    Operand root_ = {Value::nothing, none};
    std::uint32_t inside_ = none;  ///< the region that the named object is a part of, if its path says so
    std::vector<Node> nodes_;
    std::vector<RegionStart> starts_;
    std::vector<PathStep> paths_;
    std::vector<std::string> air_regions_;
    std::uint64_t air_path_bytes_ = 0;
    bool has_equal_paths_ = false;
    MemberPath members_to(RegionStart start) const;

    ChangedMembers changed_;
    std::vector<bool> changed_users_;  ///< one an object: whether it has such a member
};

}  // namespace csgrt
