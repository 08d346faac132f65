#include "scene/object_path.hpp"

#include <algorithm>
#include <optional>
#include <span>
#include <string_view>
#include <utility>

#include "base/floating_point.hpp"
#include "scene/nearest.hpp"
#include "scene/vector.hpp"

namespace csgrt {

namespace {

std::string did_you_mean_one_of(std::string_view wrong, std::vector<std::string_view> names) {
    constexpr std::size_t most = 100'000;
    names.resize(std::min(names.size(), most));
    std::sort(names.begin(), names.end());  // so that the answer does not depend on the file's order
    names.erase(std::unique(names.begin(), names.end()), names.end());
    return did_you_mean(wrong, names);
}

std::vector<std::string_view> members_of(const Combination& combination) {
    std::vector<std::string_view> names;
    for (const TreeNode& node : combination.tree.nodes)
        if (node.op == Operator::leaf) names.push_back(node.object);
    return names;
}

std::string some(const std::vector<std::string_view>& names) {
    constexpr std::size_t shown = 8;
    std::string text;
    for (std::size_t i = 0; i < names.size() && i < shown; ++i) text += (i > 0 ? ", " : "") + std::string(names[i]);
    return text + (names.size() > shown ? ", ..." : "");
}

/// Follows a path, step by step.
class Follower {
public:
    Follower(const Scene& scene, const Names& names, const std::string& text)
        : scene_(scene), names_(names), text_(text), rest_(text) {}

    ObjectPath follow() {
        skip_slashes();
        while (path_.fault.empty() && !rest_.empty()) {
            if (path_.steps.empty()) {
                begin();
            } else {
                go_down(path_.steps.back().object);
            }
            skip_slashes();
        }
        if (!path_.fault.empty()) path_.steps.clear();
        return std::move(path_);
    }

private:
    void skip_slashes() { rest_.remove_prefix(std::min(rest_.find_first_not_of('/'), rest_.size())); }

    std::string_view part() const { return rest_.substr(0, rest_.find('/')); }

    void fail(std::string message, std::string suggestion) {
        path_.fault = std::move(message) + " (in the path '" + text_ + "')";
        path_.suggestion = std::move(suggestion);
    }

    /// Finds the longest beginning of the rest that ends before a '/' and for which `find` finds an object. A name may
    /// itself hold a '/'.
    template <class Find>
    auto longest(const Find& find) -> decltype(find(std::string_view{})) {
        for (std::size_t end = rest_.size();; end = rest_.rfind('/', end - 1)) {
            if (const auto found = find(rest_.substr(0, end))) {
                rest_.remove_prefix(end);
                return found;
            }
            if (end <= part().size()) return std::nullopt;
        }
    }

    void begin() {
        const auto found = longest([this](std::string_view name) -> std::optional<std::uint32_t> {
            const std::uint32_t object = names_.find(name);
            return object == Names::none ? std::nullopt : std::optional(object);
        });
        if (found) {
            path_.steps.push_back({*found, 0});
        } else {
            fail("the scene has no object '" + std::string(part()) + "'", did_you_mean_object(scene_, part()));
        }
    }

    void go_down(std::uint32_t from) {
        const std::string& above = name_of(scene_.objects[from]);
        const auto* combination = std::get_if<Combination>(&scene_.objects[from]);
        if (combination == nullptr)
            return fail("'" + above + "' is a solid; it has no member '" + std::string(part()) + "'", {});
        const auto find_member = [&](const auto& is_called) {
            return longest([&](std::string_view name) -> std::optional<std::uint32_t> {
                const std::vector<TreeNode>& nodes = combination->tree.nodes;
                for (std::uint32_t i = 0; i < nodes.size(); ++i)
                    if (nodes[i].op == Operator::leaf && is_called(i, name)) return i;
                return std::nullopt;
            });
        };
        auto found = longest([&](std::string_view name) -> std::optional<std::uint32_t> {
            const std::uint32_t node = names_.member(from, name);
            return node == Names::none ? std::nullopt : std::optional(node);
        });
        if (!found)
            found = find_member(
                [&](std::uint32_t i, std::string_view name) { return combination->tree.nodes[i].object == name; });
        if (!found) {
            const std::vector<std::string_view> members = members_of(*combination);
            std::string suggestion = did_you_mean_one_of(part(), members);
            if (suggestion.empty() && !members.empty()) suggestion = "its members are " + some(members);
            return fail("'" + above + "' has no member '" + std::string(part()) + "'", std::move(suggestion));
        }
        const std::uint32_t object = names_.child(from, *found);
        const std::string& name = combination->tree.nodes[*found].object;
        if (object == Names::left_out) return fail("'" + above + "' uses '" + name + "', which is left out", {});
        if (object == Names::none)
            return fail("'" + above + "' uses '" + name + "', which does not exist", did_you_mean_object(scene_, name));
        path_.steps.push_back({object, *found});
    }

    const Scene& scene_;
    const Names& names_;
    const std::string& text_;
    std::string_view rest_;
    ObjectPath path_;
};

}  // namespace

const Object* object_at(const Scene& scene, const std::string& path) {
    const FloatingPoint own;
    const ObjectPath found = find_path(scene, Names(scene), path);
    return found.steps.empty() ? nullptr : &scene.objects[found.object()];
}

std::string did_you_mean_object(const Scene& scene, std::string_view wrong) {
    std::vector<std::string_view> names;
    for (const Object& object : scene.objects) names.push_back(name_of(object));
    return did_you_mean_one_of(wrong, std::move(names));
}

ObjectPath find_path(const Scene& scene, const Names& names, const std::string& text) {
    ObjectPath path;
    if (const std::uint32_t object = names.find(text); object != Names::none) {
        path.steps.push_back({object, 0});
    } else if (text.find_first_not_of('/') == std::string::npos || text.find('/') == std::string::npos) {
        const bool is_all = text.starts_with('/');
        path.fault = is_all ? "'" + text + "' is all, not one object" : "the scene has no object '" + text + "'";
        path.suggestion = is_all ? "give the path of one" : did_you_mean_object(scene, text);
    } else {
        path = Follower(scene, names, text).follow();
    }
    return path;
}

ObjectPath follow_path(const Scene& scene, const Names& names, const std::string& text) {
    ObjectPath found = find_path(scene, names, text);
    if (found.steps.empty())
        throw Error(Status::usage, {Diagnostic{.message = found.fault, .suggestion = found.suggestion}});
    return found;
}

std::string_view bare_path(std::string_view path) {
    path.remove_prefix(std::min(path.find_first_not_of('/'), path.size()));
    return path.substr(0, path.find_last_not_of('/') + 1);
}

std::string normal_path(const std::string& path) {
    if (path.empty()) throw Error(Status::usage, "the path '" + path + "' names nothing");
    return "/" + std::string(bare_path(path));
}

MemberPath member_path(const ObjectPath& path, std::size_t step) {
    MemberPath members;
    for (std::size_t i = 0; i < step; ++i) members.emplace_back(path.steps[i].object, path.steps[i + 1].node);
    return members;
}

const Matrix& matrix_of(const Names& names, const ObjectPath& path, std::size_t step) {
    return matrix_of(names, path, step, names.moved());
}

Matrix placement_of(const Names& names, const ObjectPath& path, std::size_t step) {
    return placement_of(names, path, step, names.moved());
}

const Matrix& matrix_of(const Names& names, const ObjectPath& path, std::size_t step, const MemberMatrices& moved) {
    if (step == 0) return names.matrix(path.steps[0].object, Names::none, moved);
    if (!moved.alone.empty())
        if (const auto own = moved.alone.find(member_path(path, step)); own != moved.alone.end()) return own->second;
    return names.matrix(path.steps[step - 1].object, path.steps[step].node, moved);
}

Matrix placement_of(const Names& names, const ObjectPath& path, std::size_t step, const MemberMatrices& moved) {
    Matrix matrix = matrix_of(names, path, 0, moved);
    for (std::size_t i = 1; i <= step; ++i) matrix = compose(matrix, matrix_of(names, path, i, moved));
    return matrix;
}

}  // namespace csgrt
