#include <csgrt/scene.hpp>

#include <algorithm>

#include "base/floating_point.hpp"
#include "scene/names.hpp"

namespace csgrt {

const char* type_name(const Shape& shape) {
    struct Name {
        const char* operator()(const Ell&) const { return "ell"; }
        const char* operator()(const Tgc&) const { return "tgc"; }
        const char* operator()(const Arb&) const { return "arb8"; }
        const char* operator()(const Arbn&) const { return "arbn"; }
        const char* operator()(const Half&) const { return "half"; }
        const char* operator()(const Tor&) const { return "tor"; }
        const char* operator()(const Ehy&) const { return "ehy"; }
        const char* operator()(const Part&) const { return "part"; }
        const char* operator()(const Epa&) const { return "epa"; }
        const char* operator()(const Rpc&) const { return "rpc"; }
        const char* operator()(const Rhc&) const { return "rhc"; }
        const char* operator()(const Eto&) const { return "eto"; }
        const char* operator()(const Hyp&) const { return "hyp"; }
        const char* operator()(const Superell&) const { return "superell"; }
        const char* operator()(const Hrt&) const { return "hrt"; }
        const char* operator()(const Metaball&) const { return "metaball"; }
        const char* operator()(const Pipe&) const { return "pipe"; }
        const char* operator()(const Cline&) const { return "cline"; }
        const char* operator()(const Bot&) const { return "bot"; }
        const char* operator()(const Ars&) const { return "ars"; }
        const char* operator()(const Nmg&) const { return "nmg"; }
        const char* operator()(const Ebm&) const { return "ebm"; }
        const char* operator()(const Vol&) const { return "vol"; }
        const char* operator()(const Dsp&) const { return "dsp"; }
        const char* operator()(const Extrude&) const { return "extrude"; }
        const char* operator()(const Revolve&) const { return "revolve"; }
        const char* operator()(const Unsupported& solid) const { return solid.type.c_str(); }
    };
    return std::visit(Name{}, shape);
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
