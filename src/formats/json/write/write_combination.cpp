#include <algorithm>

#include "formats/json/scene_forms.hpp"
#include "formats/json/write/write_form.hpp"
#include "formats/json/write/write_object.hpp"
#include "scene/operators.hpp"
#include "scene/vector.hpp"

namespace csgrt {

using nlohmann::ordered_json;

ordered_json json_of(const TreeNode& leaf, JsonUnit& unit) {
    const Matrix& m = leaf.matrix;
    Matrix moved = identity;
    for (const std::size_t i : {3, 7, 11}) moved[i] = m[i];
    const bool is_placed = !same_bits(m, identity);
    if (!is_placed && leaf.name.empty()) return leaf.object;
    ordered_json out = {{"object", leaf.object}};
    if (is_placed && same_bits(m, moved)) {
        out["translate"] = unit.lengths({m[3], m[7], m[11]});
    } else if (is_placed) {
        ordered_json matrix = ordered_json::array();
        for (std::size_t i = 0; i < 16; ++i)
            matrix.push_back(i == 3 || i == 7 || i == 11 ? unit.length(m[i]) : unit.number(m[i]));
        out["matrix"] = std::move(matrix);
    }
    if (!leaf.name.empty()) out["name"] = leaf.name;
    return out;
}

namespace {

/// The greatest depth of trees that are written as nested operators. Each operator nests two brackets, and the reader
/// allows Limits::file_nesting brackets. Deeper trees are written in postfix form, which does not nest.
constexpr std::size_t deepest_nested = 100;

/// The number of operators above the deepest leaf. Nothing if the nodes are not a tree.
std::optional<std::size_t> depth_of(const Tree& tree) {
    std::vector<std::size_t> waiting;
    for (const TreeNode& node : tree.nodes) {
        if (node.arity > waiting.size() || operator_name(node.op).empty() || !takes(node.op, node.arity))
            return std::nullopt;
        std::size_t depth = 0;
        for (std::uint32_t i = 0; i < node.arity; ++i) {
            depth = std::max(depth, waiting.back() + 1);
            waiting.pop_back();
        }
        waiting.push_back(depth);
    }
    if (waiting.size() != 1) return std::nullopt;
    return waiting.front();
}

ordered_json json_of_postfix(const Tree& tree, JsonUnit& unit) {
    ordered_json list = ordered_json::array();
    for (const TreeNode& node : tree.nodes) {
        if (node.op == Operator::leaf) {
            list.push_back(json_of(node, unit));
        } else {
            list.push_back({{"operator", operator_name(node.op)}, {"operands", node.arity}});
        }
    }
    return {{"postfix", std::move(list)}};
}

ordered_json json_of_nested(const Tree& tree, JsonUnit& unit) {
    std::vector<ordered_json> waiting;
    for (const TreeNode& node : tree.nodes) {
        if (node.op == Operator::leaf) {
            waiting.push_back(json_of(node, unit));
            continue;
        }
        ordered_json operands = ordered_json::array();
        for (std::size_t i = waiting.size() - node.arity; i < waiting.size(); ++i)
            operands.push_back(std::move(waiting[i]));
        waiting.resize(waiting.size() - node.arity);
        if (node.op == Operator::not_) operands = ordered_json(std::move(operands[0]));
        ordered_json written = ordered_json::object();
        written[std::string(operator_name(node.op))] = std::move(operands);
        waiting.push_back(std::move(written));
    }
    return std::move(waiting.front());
}

ordered_json json_of(const Tree& tree, JsonUnit& unit, std::string& fault) {
    if (tree.nodes.empty()) return nullptr;
    const std::optional<std::size_t> depth = depth_of(tree);
    if (!depth) {
        fault = "its tree has operators without their operands, or operands without an operator";
        return nullptr;
    }
    return *depth > deepest_nested ? json_of_postfix(tree, unit) : json_of_nested(tree, unit);
}

/// The JSON of a material. The shader is always written: without any key, the reader would find no finish.
ordered_json json_of_material(const std::optional<Vec3>& color, const std::optional<Finish>& finish, JsonUnit& unit) {
    ordered_json material = ordered_json::object();
    if (color) material["color"] = unit.vector(*color);
    if (finish) {
        write_members(material, form::of<Finish>, *finish, unit);
        if (finish->light) material["light"] = write_form(*finish->light, unit);
    }
    return material;
}

}  // namespace

ordered_json json_of(const Combination& combination, JsonUnit& unit, std::string& fault) {
    ordered_json out = ordered_json::object();
    out["tree"] = json_of(combination.tree, unit, fault);
    write_members(out, form::of<Combination>, combination, unit);
    if (combination.color || combination.finish)
        out["material"] = json_of_material(combination.color, combination.finish, unit);
    ordered_json inherit = ordered_json::array();
    if (combination.color_inherits) inherit.push_back("color");
    if (combination.finish_inherits) inherit.push_back("finish");
    if (!inherit.empty()) out["inherit"] = std::move(inherit);
    return out;
}

ordered_json json_of(const Look& look, JsonUnit& unit) {
    ordered_json out = {{"path", look.path}};
    if (look.color || look.finish) out["material"] = json_of_material(look.color, look.finish, unit);
    if (look.state) out["state"] = form::states.words.at(static_cast<std::size_t>(*look.state));
    return out;
}

}  // namespace csgrt
