// Names: an index of a scene's objects by name, with the object that each leaf of a tree names.
#pragma once

#include <algorithm>
#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

#include <csgrt/scene.hpp>

namespace csgrt {

/// "name@2": the second object with the name.
std::string numbered(std::string name, std::uint32_t number);

/// A leaf: a combination, and the node of its tree. Or an object that is rendered by its name, and Names::none.
using Member = std::pair<std::uint32_t, std::uint32_t>;
/// The members on the way from an object down to one instance of another object.
using MemberPath = std::vector<Member>;
/// Matrices that replace the matrices of leaves in a scene.
struct MemberMatrices {
    std::map<Member, Matrix> all;        ///< in all instances of the combination
    std::map<MemberPath, Matrix> alone;  ///< of the path's last member, in this instance alone
    bool operator==(const MemberMatrices&) const = default;
};

/// An index of names. The scene must not change or be destroyed while the index is used.
class Names {
public:
    static constexpr std::uint32_t none = 0xffffffff, operation = 0xfffffffe, left_out = 0xfffffffd;

    explicit Names(const Scene& scene);

    /// The first object with a name; Names::none if there is no such object.
    std::uint32_t find(std::string_view name) const { return find(name, hash_of(name)); }
    /// The object that a leaf names: node `node` of the tree of combination `object`.
    std::uint32_t child(std::uint32_t object, std::size_t node) const { return children_[first_child_[object] + node]; }
    /// Node `node` of the tree of combination `object`.
    const TreeNode& node(std::uint32_t object, std::size_t node) const {
        return std::get<Combination>(scene_.objects[object]).tree.nodes[node];
    }
    const Scene& scene() const { return scene_; }
    /// The matrix of a leaf, or of an object that is rendered by its name (Scene::top_matrices; else the identity); or
    /// the matrix that replaces it in all instances.
    const Matrix& matrix(std::uint32_t object, std::size_t node, const MemberMatrices& moved) const {
        if (!moved.all.empty())
            if (const auto found = moved.all.find(Member(object, static_cast<std::uint32_t>(node)));
                found != moved.all.end())
                return found->second;
        if (node != none) return this->node(object, node).matrix;
        const auto found = top_.find(object);
        return found == top_.end() ? identity : scene_.top_matrices[found->second];
    }
    const Matrix& matrix(std::uint32_t object, std::size_t node) const { return matrix(object, node, moved_); }
    /// The matrices that replace those of the scene.
    const MemberMatrices& moved() const { return moved_; }
    void set_matrices(const MemberMatrices& moved) { moved_ = moved; }
    /// The name of a leaf in paths (TreeNode::name), which no other leaf of its tree has.
    const std::string& member_name(std::uint32_t object, std::size_t node) const {
        const auto found = first_name({object, static_cast<std::uint32_t>(node)});
        const bool is_its = found != member_names_.end() && found->first == Member(object, node);
        return is_its ? found->second : this->node(object, node).object;
    }
    /// The node of the leaf with a name; Names::none if there is no such leaf.
    std::uint32_t member(std::uint32_t object, std::string_view name) const;
    /// Whether different members may have the same path: a name holds a '/', or ends like a numbered name.
    bool has_ambiguous_names() const { return has_ambiguous_names_; }
    /// For each node of a combination's tree the object that it names: `operation` for an operator, `left_out` for a
    /// leaf that is the empty set. Empty for a solid. Walks use this list because it takes far less memory than the
    /// objects.
    std::span<const std::uint32_t> children(std::uint32_t object) const {
        return std::span(children_).subspan(first_child_[object], first_child_[object + 1] - first_child_[object]);
    }
    /// The kind of an object, in a list that takes far less memory than the objects.
    enum class Kind : std::uint8_t { combination, region, air_region, solid, composite, unsupported, left_out };
    Kind kind(std::uint32_t object) const { return kinds_[object]; }
    bool is_solid(std::uint32_t object) const { return kinds_[object] >= Kind::solid; }
    /// Makes the object, or one leaf of a tree, the empty set.
    void leave_out(std::uint32_t object) { kinds_[object] = Kind::left_out; }
    void leave_out(std::uint32_t object, std::size_t node) { children_[first_child_[object] + node] = left_out; }
    /// Objects that have the same name as an earlier object.
    const std::vector<std::uint32_t>& taken() const { return taken_; }
    /// See csgrt::top_objects. Members of objects that are left out do not count as used.
    std::vector<std::string> top_objects() const;

private:
    struct Slot {
        std::uint32_t hash, object;  // Names::none: the slot is empty
    };

    using MemberNames = std::vector<std::pair<Member, std::string>>;

    static std::uint32_t hash_of(std::string_view name);
    MemberNames::const_iterator first_name(const Member& from) const {
        return std::lower_bound(member_names_.begin(), member_names_.end(), from,
                                [](const auto& entry, const Member& member) { return entry.first < member; });
    }
    void name_members(std::uint32_t object, const std::vector<TreeNode>& nodes, std::vector<std::uint32_t>& sorted,
                      MemberNames& found) const;
    std::uint32_t find(std::string_view name, std::uint32_t hash) const;

    const Scene& scene_;
    std::vector<Slot> slots_;  // a hash table: a power of two of slots, at most half of them in use
    std::vector<std::uint32_t> taken_;
    std::vector<std::uint64_t> first_child_;  // for each object, and one more: where its tree's nodes begin in
                                              // `children_`
    std::vector<Kind> kinds_;                 // for each object
    MemberMatrices moved_;
    MemberNames member_names_;  // names of members that differ from their objects' names, sorted by member
    std::unordered_map<std::uint32_t, std::uint32_t> top_;  // for objects of Scene::top: the index there
    bool has_ambiguous_names_ = false;
    std::vector<std::uint32_t> children_;
};

}  // namespace csgrt
