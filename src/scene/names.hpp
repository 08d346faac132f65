// Names: the objects of a scene by name, and the object that each leaf of their trees names, looked up once for all.
#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <csgrt/scene.hpp>

namespace csgrt {

/// "name@2": the second object of the name.
std::string numbered(std::string name, std::uint32_t number);

/// An index of names. It refers to the scene, which must neither change nor be destroyed while it is used.
class Names {
public:
    static constexpr std::uint32_t none = 0xffffffff, operation = 0xfffffffe, left_out = 0xfffffffd;

    explicit Names(const Scene& scene);

    /// The first object of a name; none: there is none.
    std::uint32_t find(std::string_view name) const { return find(name, hash_of(name)); }
    /// The object that a leaf names: node `node` of the tree of combination `object`.
    std::uint32_t child(std::uint32_t object, std::size_t node) const { return children_[first_child_[object] + node]; }
    /// Node `node` of the tree of combination `object`.
    const TreeNode& node(std::uint32_t object, std::size_t node) const {
        return std::get<Combination>(scene_.objects[object]).tree.nodes[node];
    }
    /// The name of a leaf in paths (TreeNode::name): no two leaves of a tree have the same.
    const std::string& member_name(std::uint32_t object, std::size_t node) const {
        const auto found = member_names_.find(std::pair(object, static_cast<std::uint32_t>(node)));
        return found != member_names_.end() ? found->second : this->node(object, node).object;
    }
    /// Whether two paths may be the same though their members differ: a name holds a '/', or an end that looks like a
    /// number.
    bool has_ambiguous_names() const { return has_ambiguous_names_; }
    /// The children of all nodes of a combination's tree. They are walked several times and take far less memory than
    /// the objects. `operation`: not a leaf; `left_out`: a leaf that is the empty set. Empty for a solid.
    std::span<const std::uint32_t> children(std::uint32_t object) const {
        return std::span(children_).subspan(first_child_[object], first_child_[object + 1] - first_child_[object]);
    }
    /// The kind of an object, known without the object, which takes far more memory.
    enum class Kind : std::uint8_t { combination, region, air_region, solid, composite, unsupported, left_out };
    Kind kind(std::uint32_t object) const { return kinds_[object]; }
    bool is_solid(std::uint32_t object) const { return kinds_[object] >= Kind::solid; }
    /// Makes the object, or one leaf of a tree, the empty set.
    void leave_out(std::uint32_t object) { kinds_[object] = Kind::left_out; }
    void leave_out(std::uint32_t object, std::size_t node) { children_[first_child_[object] + node] = left_out; }
    /// Objects whose names objects before them have.
    const std::vector<std::uint32_t>& taken() const { return taken_; }
    /// See csgrt::top_objects. Objects that are left out use nothing.
    std::vector<std::string> top_objects() const;

private:
    struct Slot {
        std::uint32_t hash, object;  // none: empty
    };

    using MemberNames = std::map<std::pair<std::uint32_t, std::uint32_t>, std::string>;

    static std::uint32_t hash_of(std::string_view name);
    void name_members(std::uint32_t object, const std::vector<TreeNode>& nodes, std::vector<std::uint32_t>& sorted,
                      MemberNames& found) const;
    std::uint32_t find(std::string_view name, std::uint32_t hash) const;

    const Scene& scene_;
    std::vector<Slot> slots_;  // a power of two of them, at most half of them in use
    std::vector<std::uint32_t> taken_;
    std::vector<std::uint64_t> first_child_;  // one an object, and one more: the first of its tree's nodes in
                                              // `children_`
    std::vector<Kind> kinds_;                 // one an object
    MemberNames member_names_;                // of members whose names differ from their objects'
    bool has_ambiguous_names_ = false;
    std::vector<std::uint32_t> children_;
};

}  // namespace csgrt
