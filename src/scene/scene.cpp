#include <csgrt/scene.hpp>

#include <algorithm>
#include <iterator>
#include <utility>

#include "base/floating_point.hpp"
#include "scene/names.hpp"
#include "scene/solids/shape_forms.hpp"

namespace csgrt {

const char* type_name(const Shape& shape) {
    const auto* unsupported = std::get_if<Unsupported>(&shape);
    if (unsupported != nullptr) return unsupported->type.c_str();
    return std::visit([]<class S>(const S&) { return form::of<S>.head.name; }, shape);
}

const char* type_name(const Object& object) {
    if (const auto* solid = std::get_if<Solid>(&object)) return type_name(solid->shape);
    return std::get<Combination>(object).region ? "region" : "combination";
}

const Object* Scene::find(const std::string& name) const {
    const auto found =
        std::find_if(objects.begin(), objects.end(), [&](const Object& object) { return name_of(object) == name; });
    return found == objects.end() ? nullptr : &*found;
}

Object* Scene::find(const std::string& name) { return const_cast<Object*>(std::as_const(*this).find(name)); }

Tree tree(std::string object, const Matrix& matrix) {
    return {{{.op = Operator::leaf, .object = std::move(object), .matrix = matrix}}};
}

/// A tree with one operator over both trees. If a tree is empty, the other one.
static Tree joined(Tree a, Operator op, Tree b) {
    if (b.nodes.empty()) return a;
    if (a.nodes.empty()) return op == Operator::union_ || op == Operator::xor_ ? std::move(b) : std::move(a);
    std::ranges::move(b.nodes, std::back_inserter(a.nodes));
    a.nodes.push_back({.op = op, .arity = 2});
    return a;
}

Tree operator|(Tree a, Tree b) { return joined(std::move(a), Operator::union_, std::move(b)); }
Tree operator&(Tree a, Tree b) {
    return b.nodes.empty() ? std::move(b) : joined(std::move(a), Operator::intersection, std::move(b));
}
Tree operator-(Tree a, Tree b) { return joined(std::move(a), Operator::difference, std::move(b)); }
Tree operator^(Tree a, Tree b) { return joined(std::move(a), Operator::xor_, std::move(b)); }

const std::string& name_of(const Object& object) {
    return std::visit([](const auto& it) -> const std::string& { return it.name; }, object);
}

const Place& place_of(const Object& object) {
    return std::visit([](const auto& it) -> const Place& { return it.place; }, object);
}

std::vector<std::string> top_objects(const Scene& scene) {
    const FloatingPoint own;  // hash tables use floating-point numbers, too
    return scene.top.empty() ? Names(scene).top_objects() : scene.top;
}

}  // namespace csgrt
