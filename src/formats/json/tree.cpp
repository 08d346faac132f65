#include "formats/json/tree.hpp"

#include <algorithm>
#include <limits>

#include "formats/json/placement.hpp"
#include "formats/json/read_form.hpp"
#include "formats/json/scene_forms.hpp"
#include "scene/nearest.hpp"
#include "scene/operators.hpp"
#include "scene/vector.hpp"

namespace csgrt {

namespace {

/// The key that tells a node's kind: "object" or an operator. Empty if there is no such key.
std::string_view kind_of_node(const JsonMembers& members) {
    for (const JsonMember& member : members) {
        if (member.name == "object" || member.name == "postfix") return member.name;
        for (const auto& [name, op] : operator_names) {
            if (op != Operator::leaf && member.name == name) return name;
        }
    }
    return {};
}

Operator operator_called(std::string_view called) {
    const auto found = std::find_if(std::begin(operator_names), std::end(operator_names),
                                    [&](const auto& it) { return it.first == called; });
    return found == std::end(operator_names) ? Operator::leaf : found->second;
}

std::string needs(Operator op) {
    return std::string("'") + std::string(operator_name(op)) + "' needs " +
           (op == Operator::difference ? "two operands or more: the object that is cut, then those that are taken away"
            : op == Operator::not_     ? "exactly one operand"
                                       : "one operand or more");
}

/// Reads a tree into postfix order. Transforms of inner nodes are multiplied into those of the leaves.
class TreeReader {
public:
    explicit TreeReader(Tree& tree) : tree_(tree) {}

    /// Reads a node. `outer`: the transform of the nodes around it; null: none.
    void read(const JsonNode& node, const Matrix* outer) {
        if (node.is_string()) {
            add_leaf(node, node, outer);
            return;
        }
        const std::string_view kind = kind_of(node);
        if (kind.empty()) return;
        if (kind == "postfix") {
            node.fault("'postfix' may stand for a whole tree only");
            return;
        }
        const bool is_leaf = kind == "object";
        const JsonObject o =
            is_leaf ? json_object(node, form::leaf) : json_object(node, form::node("", kind, form::nothing));
        std::optional<Matrix> matrix = read_json_placement(o);
        if (matrix && outer != nullptr) matrix = compose(*outer, *matrix);
        const Matrix* placed = matrix ? &*matrix : outer;
        if (is_leaf) {
            add_leaf(node, o["object"], placed);
            if (o.has("name")) tree_.nodes.back().name = o["name"].name();
        } else {
            read_operator(node, operator_called(kind), o[kind], placed);
        }
    }

    void read_postfix(const JsonNode& node) {
        const JsonObject whole = json_object(node, form::postfix);
        std::size_t waiting = 0;
        for (const JsonNode& item : whole["postfix"].items()) {
            if (item.is_object() && find_member(std::get<JsonMembers>(item.value()->data), "operator") != nullptr) {
                if (!read_postfix_operator(item, waiting)) return;
            } else {
                if (item.is_object() && kind_of(item) != "object") {
                    item.fault(
                        "expected an object's name, {\"object\": ...} or {\"operator\": ..., \"operands\": ...}");
                    return;
                }
                read(item, nullptr);
                ++waiting;
            }
        }
        if (waiting != 1)
            whole["postfix"].fault("a postfix list must leave one operand, this one leaves " + std::to_string(waiting));
    }

private:
    std::string_view kind_of(const JsonNode& node) const {
        if (!node.is_object()) {
            node.fault(std::string("expected a tree: an object's name, or {\"union\": [...]} and the like, found ") +
                       csgrt::kind_of(*node.value()));
            return {};
        }
        const JsonMembers& members = std::get<JsonMembers>(node.value()->data);
        const std::string_view kind = kind_of_node(members);
        if (kind.empty()) {
            std::vector<std::string_view> known = {"object"};
            for (const auto& [name, op] : operator_names) {
                if (op != Operator::leaf) known.push_back(name);
            }
            std::string suggestion;
            for (const JsonMember& member : members) {
                if (suggestion.empty()) suggestion = did_you_mean(member.name, known);
            }
            node.fault("this node has neither 'object' nor an operator: union, intersection, difference, xor or not",
                       suggestion);
        }
        return kind;
    }

    void add_leaf(const JsonNode& node, const JsonNode& name, const Matrix* matrix) {
        tree_.nodes.push_back({Operator::leaf, 0, name.name(), matrix == nullptr ? identity : *matrix, node.place()});
    }

    void read_operator(const JsonNode& node, Operator op, const JsonNode& operands, const Matrix* placed) {
        std::size_t arity = 1;
        if (op == Operator::not_ && !operands.is_array()) {
            read(operands, placed);
        } else {
            const std::vector<JsonNode> items = operands.items();
            arity = items.size();
            if (operands.is_array() && !takes(op, arity))
                operands.fault(needs(op) + ", found " + std::to_string(arity));
            for (const JsonNode& item : items) read(item, placed);
        }
        tree_.nodes.push_back({op, static_cast<std::uint32_t>(arity), {}, identity, node.place()});
    }

    /// Reads an operator. `waiting`: the number of operands that no operator has taken yet. False: the rest of the tree
    /// cannot be read.
    bool read_postfix_operator(const JsonNode& item, std::size_t& waiting) {
        const JsonObject o = json_object(item, form::postfix_operator);
        const std::string name = o["operator"].string();
        const Operator op = operator_called(name);
        const int arity = o["operands"].integer(1, std::numeric_limits<int>::max(), 1);
        if (op == Operator::leaf) {
            if (o["operator"].is_string()) o["operator"].fault("there is no operator '" + name + "'");
            return false;
        }
        if (!takes(op, static_cast<std::uint64_t>(arity))) {
            o["operands"].fault(needs(op) + ", found " + std::to_string(arity));
            return false;
        }
        if (static_cast<std::size_t>(arity) > waiting) {
            item.fault("'" + name + "' takes " + std::to_string(arity) + " operands, but only " +
                       std::to_string(waiting) + " stand before it");
            return false;
        }
        waiting = waiting - static_cast<std::size_t>(arity) + 1;
        tree_.nodes.push_back({op, static_cast<std::uint32_t>(arity), {}, identity, item.place()});
        return true;
    }

    Tree& tree_;
};

}  // namespace

Tree read_json_tree(const JsonNode& node) {
    Tree tree;
    if (!node.present() || node.is_null()) return tree;
    TreeReader reader(tree);
    if (node.is_object() && find_member(std::get<JsonMembers>(node.value()->data), "postfix") != nullptr) {
        reader.read_postfix(node);
    } else {
        reader.read(node, nullptr);
    }
    return tree;
}

}  // namespace csgrt
