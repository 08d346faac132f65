#include "scene.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <unordered_map>
#include <unordered_set>
#include <utility>

#include "base/shell_word.hpp"
#include "partitions.hpp"

namespace csgrt::cli {

namespace {

/// A leaf of a tree, with the text before it, such as "- (", and behind it, such as ")".
struct Member {
    const TreeNode* leaf = nullptr;
    std::string before, behind;
};

const char* symbol(Operator op) {
    return op == Operator::intersection ? "+" : op == Operator::difference ? "-" : op == Operator::xor_ ? "^" : "u";
}

int strength(Operator op) {
    if (op == Operator::leaf || op == Operator::not_) return 3;
    return op == Operator::intersection || op == Operator::difference ? 2 : 1;
}

/// The leaves in order, with the operators between them. As in BRL-CAD, "-" and "+" bind stronger than "u"; brackets
/// are added where the order of evaluation differs.
std::vector<Member> members_of(const Tree& tree) {
    struct Part {
        std::size_t first;  ///< index of the first leaf
        Operator op;
    };
    std::vector<Member> members;
    std::vector<Part> stack;
    for (const TreeNode& node : tree.nodes) {
        if (node.op == Operator::leaf) {
            stack.push_back({members.size(), node.op});
            members.push_back({&node, "", ""});
            continue;
        }
        if (node.arity == 0 || node.arity > stack.size()) return {};  // a broken tree: compilation reports it
        std::size_t base = stack.size() - node.arity;
        for (std::size_t i = base; i < stack.size(); ++i) {
            Member& first = members[stack[i].first];
            std::size_t end = i + 1 < stack.size() ? stack[i + 1].first : members.size();
            int inner = strength(stack[i].op), outer = strength(node.op);
            bool in_order = i == base || (stack[i].op == node.op && node.op != Operator::difference);
            bool clear = inner > outer || (inner == outer && in_order);
            if (end - stack[i].first > 1 && !clear) {
                first.before.insert(0, "(");
                members[end - 1].behind += ")";
            }
            if (node.op == Operator::not_)
                first.before.insert(0, "!");
            else if (i > base)
                first.before.insert(0, std::string(symbol(node.op)) + " ");
        }
        stack.resize(base + 1);
        stack[base].op = node.op;
    }
    return members;
}

class TreePrinter {
public:
    explicit TreePrinter(const Scene& scene) : scene_(scene) {
        for (const Object& object : scene.objects) objects_.emplace(name_of(object), &object);
    }

    /// Prints the tree of an object that the user named or gave a path to.
    void print(const std::string& name, int depth) {
        const auto named = objects_.find(name);  // object_at() would search all objects each time
        const Object* object = named != objects_.end() ? named->second : object_at(scene_, name);
        print(object == nullptr ? name : name_of(*object), name, "", depth, 0);
    }

    std::string text;

private:
    /// Prints an object. `shown`: the name with the operators and brackets before it.
    void print(const std::string& name, const std::string& shown, const std::string& behind, int depth, int level) {
        auto found = objects_.find(name);
        text += std::string(4 * static_cast<std::size_t>(level), ' ') + shown + behind;
        if (found == objects_.end()) {
            text += "  (missing)\n";
            return;
        }
        if (auto* solid = std::get_if<Solid>(found->second)) {
            text += std::string("  ") + type_name(solid->shape) + "\n";
            return;
        }
        const auto& combination = std::get<Combination>(*found->second);
        auto members = members_of(combination.tree);
        text += combination.region ? "  region " + std::to_string(combination.region_id) : "  combination";
        if (combination.region && combination.air) text += "  air " + std::to_string(combination.air);
        text += "  of " + std::to_string(members.size());
        if (level >= depth || members.empty()) {
            text += "\n";
            return;
        }
        if (!unfolded_.insert(&combination).second) {
            text += "  (see above)\n";
            return;
        }
        text += "\n";
        for (const Member& member : members)
            print(member.leaf->object, member.before + member.leaf->object, member.behind, depth, level + 1);
    }

    const Scene& scene_;
    std::unordered_map<std::string, const Object*> objects_;
    std::unordered_set<const Combination*> unfolded_;
};

}  // namespace

std::string model_text(const SceneArguments& arguments) {
    std::string text;
    append_name(text, std::filesystem::path(arguments.scene).filename().string());
    for (const std::string& object : arguments.objects) {
        text += ' ';
        append_name(text, object);
    }
    return text;
}

std::string bounds_text(const Model& model, bool in_words, std::string (*number)(double)) {
    std::size_t unbounded = 0;
    for (const RegionInfo& region : model.regions()) {
        const Vec3 &low = region.bounds.low, &high = region.bounds.high;
        const bool empty = !(low.x <= high.x && low.y <= high.y && low.z <= high.z);
        const double sum = std::abs(low.x) + std::abs(low.y) + std::abs(low.z) + std::abs(high.x) + std::abs(high.y) +
                           std::abs(high.z);
        if (!empty && !std::isfinite(sum)) ++unbounded;
    }
    const Vec3 &low = model.bounds().low, &high = model.bounds().high;
    if (!(low.x <= high.x)) return unbounded > 0 ? "unbounded" : "empty";
    const auto point = [&](const Vec3& v) { return number(v.x) + " " + number(v.y) + " " + number(v.z); };
    if (!in_words) return point(low) + " " + point(high);
    std::string text = point(low) + " to " + point(high) + " mm";
    if (unbounded > 0)
        text += ", and " + std::to_string(unbounded) + (unbounded == 1 ? " unbounded region" : " unbounded regions");
    return text;
}

std::string count_text(const std::map<std::string, std::size_t>& by_type) {
    std::vector<std::pair<std::string, std::size_t>> rows(by_type.begin(), by_type.end());
    std::stable_sort(rows.begin(), rows.end(), [](const auto& a, const auto& b) { return a.second > b.second; });
    std::size_t total = 0;
    std::string list;
    for (const auto& [type, count] : rows) {
        total += count;
        list += (list.empty() ? "" : ", ") + type + " " + std::to_string(count);
    }
    return std::to_string(total) + (list.empty() ? "" : " (" + list + ")");
}

std::string tree_text(const Scene& scene, const std::vector<std::string>& objects, int depth) {
    TreePrinter printer(scene);
    for (const std::string& name : objects) printer.print(name, depth);
    return std::move(printer.text);
}

}  // namespace csgrt::cli
