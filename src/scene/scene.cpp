#include <csgrt/scene.hpp>

#include <algorithm>

#include "base/floating_point.hpp"
#include "scene/names.hpp"
#include "scene/solids/shape_forms.hpp"

namespace csgrt {

const char* type_name(const Shape& shape) {
    const auto* unsupported = std::get_if<Unsupported>(&shape);
    if (unsupported != nullptr) return unsupported->type.c_str();
    return std::visit([]<class S>(const S&) { return form::of<S>.head.name; }, shape);
}

const Object* Scene::find(const std::string& name) const {
    const auto found =
        std::find_if(objects.begin(), objects.end(), [&](const Object& object) { return name_of(object) == name; });
    return found == objects.end() ? nullptr : &*found;
}

const std::string& name_of(const Object& object) {
    return std::visit([](const auto& it) -> const std::string& { return it.name; }, object);
}

const Place& place_of(const Object& object) {
    return std::visit([](const auto& it) -> const Place& { return it.place; }, object);
}

std::vector<std::string> top_objects(const Scene& scene) {
    const FloatingPoint own;  // hash tables compute, too
    return scene.top.empty() ? Names(scene).top_objects() : scene.top;
}

}  // namespace csgrt
