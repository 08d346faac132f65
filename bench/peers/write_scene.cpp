// csgrt_peer_scene SOLIDS FOLDER: one generated scene for csgrt (scene.json) and for POV-Ray (scene.pov), with the same
// geometry, colours and view; no shadows, no reflections, nothing but the first hit.
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <stdexcept>
#include <string>
#include <unordered_map>
#include <vector>

#include <csgrt/csgrt.hpp>

#include "compile/compiled_scene.hpp"
#include "compile/frame.hpp"
#include "stress/parts.hpp"

using namespace csgrt;

namespace {

std::string number(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.17g", value);
    return text;
}
std::string vector(double x, double y, double z) { return "<" + number(x) + "," + number(y) + "," + number(z) + ">"; }
std::string vector(const Vec3& v) { return vector(v.x, v.y, v.z); }
double length(const Vec3& v) { return std::sqrt(v.x * v.x + v.y * v.y + v.z * v.z); }

/// The shapes that generated scenes have, in POV-Ray's words.
struct InPov {
    std::string operator()(const Ell& s) const { return "sphere{" + vector(s.v) + "," + number(length(s.a)) + "}"; }
    std::string operator()(const Tgc& s) const {
        return "cylinder{" + vector(s.v) + "," + vector(s.v.x + s.h.x, s.v.y + s.h.y, s.v.z + s.h.z) + "," +
               number(length(s.a)) + "}";
    }
    std::string operator()(const Arb& s) const {
        return "box{" + vector(s.vertices[0]) + "," + vector(s.vertices[6]) + "}";
    }
    std::string operator()(const Tor& s) const {  // its axis is y there, z here
        return "torus{" + number(s.r_a) + "," + number(s.r_h) + " matrix<1,0,0, 0,0,1, 0,-1,0, " + number(s.v.x) + "," +
               number(s.v.y) + "," + number(s.v.z) + ">}";
    }
    template <class Other>
    std::string operator()(const Other&) const {
        throw std::runtime_error("a shape that POV-Ray's scene cannot hold");
    }
};

class Translator {
public:
    explicit Translator(const Scene& scene) {
        for (const Object& object : scene.objects) objects_[name_of(object)] = &object;
    }
    std::string text(const std::string& name) const {
        const Object& object = *objects_.at(name);
        if (const auto* solid = std::get_if<Solid>(&object)) return std::visit(InPov{}, solid->shape);
        const auto& combination = std::get<Combination>(object);
        std::vector<std::string> operands;
        for (const TreeNode& node : combination.tree.nodes) {
            if (node.op == Operator::leaf) {
                operands.push_back(placed(text(node.object), node.matrix));
                continue;
            }
            std::string all = node.op == Operator::union_         ? "union{"
                              : node.op == Operator::intersection ? "intersection{"
                                                                  : "difference{";
            for (std::size_t i = operands.size() - node.arity; i < operands.size(); ++i) all += operands[i] + "\n";
            operands.resize(operands.size() - node.arity);
            operands.push_back(node.arity == 1 ? all.substr(all.find('{') + 1) : all + "}");
        }
        if (!combination.color) return operands.back();
        return "object{" + operands.back() + " pigment{rgb" + vector(*combination.color) + "}}";
    }

private:
    static std::string placed(const std::string& what, const Matrix& m) {
        if (m == identity) return what;
        std::string text = "object{" + what + " matrix<";
        for (std::size_t column = 0; column < 4; ++column)
            for (std::size_t row = 0; row < 3; ++row)
                text += number(m[4 * row + column]) + (column + row < 5 ? "," : ">}");
        return text;
    }

    std::unordered_map<std::string, const Object*> objects_;
};

void write(const std::string& path, const std::string& text) {
    std::ofstream out(path);
    out << text;
    if (!out.flush()) throw std::runtime_error(path + ": cannot be written");
}

}  // namespace

int main(int argc, char** argv) {
    try {
        const int solids = argc == 3 ? std::atoi(argv[1]) : 0;
        if (solids < 3) throw std::runtime_error("csgrt_peer_scene SOLIDS FOLDER, with 3 solids at least");
        Scene scene = stress::scene_of_parts(static_cast<std::uint32_t>(solids));
        scene.background = {0, 0, 1};  // no part is pure blue: the script knows it by that
        const std::string folder = argv[2];
        save_scene(scene, folder + "/scene.json");

        View view;
        view.width = view.height = 1;  // one pixel is the whole picture
        const kernel::Frame frame = prepare_frame(compile(scene), view, -1).frame;
        const auto vec = [](const double(&v)[3]) { return vector(v[0], v[1], v[2]); };
        write(folder + "/scene.pov",
              "#version 3.7;\nglobal_settings{assumed_gamma 1 max_trace_level 1}\nbackground{rgb<0,0,1>}\n"
              "#default{finish{ambient 0.4 diffuse 0.6}}\ncamera{orthographic location " +
                  vec(frame.eye) + " direction " + vec(frame.w) + " right " + vec(frame.u) + " up " + vec(frame.v) +
                  "}\nlight_source{" + vec(frame.eye) + " rgb 1 shadowless}\n" + Translator(scene).text("all") + "\n");
    } catch (const std::exception& error) {
        std::fprintf(stderr, "csgrt_peer_scene: %s\n", error.what());
        return 2;
    }
    return 0;
}
