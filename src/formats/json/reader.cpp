#include "formats/json/reader.hpp"

#include <algorithm>
#include <unordered_map>
#include <unordered_set>

#include "base/identical.hpp"
#include "formats/brlcad/values.hpp"
#include "formats/json/placement.hpp"
#include "formats/json/read_form.hpp"
#include "formats/json/scene_forms.hpp"
#include "formats/json/solids.hpp"
#include "formats/json/tree.hpp"
#include "scene/nearest.hpp"
#include "scene/object_path.hpp"

namespace csgrt {

namespace {

struct Material {
    std::optional<Vec3> color;
    std::optional<Finish> finish;
};

/// Reads a material. The material has a finish if any of the finish's keys is given; then the other keys have their
/// defaults.
Material read_material(const JsonNode& node) {
    const JsonObject o = json_object(node, form::of<Finish>);
    Material material;
    if (o.has("color")) material.color = o["color"].color();
    Finish finish;
    if (o.has("light")) finish.shader = "light";
    read_members(o, form::of<Finish>, finish);
    if (finish.shader == "light") {
        finish.light = o.has("light") ? read_form<Emission>(o["light"]) : Emission();
    } else if (o.has("light")) {
        o["light"].fault("has a meaning only with the shader \"light\"");
    }
    form::for_members(form::of<Finish>, [&](const auto& member) {
        if (member.key.json != "color" && o.has(member.key.json)) material.finish = finish;
    });
    return material;
}

/// Reads the sections of a scene file. Wrong values become findings, and reading goes on.
class SceneReader {
public:
    SceneReader(const TextSource& source, Findings& findings) : file_{source, findings} {}

    Scene read(const JsonValue& value) {
        const JsonNode root(file_, &value, "");
        const JsonObject o = json_object(root, form::of<Scene>);
        if (!root.is_object()) return {};
        if (const JsonNode version = o["csgrt"]; version.present()) {
            if (const double number = version.number(json_format_version); number != json_format_version) {
                version.fault("this csgrt reads version " + std::to_string(json_format_version) + " of the format");
            }
        }
        read_units(o);
        read_settings(o);
        for (const JsonNode::Member& member : members_of(o["materials"])) {
            materials_.emplace(member.name, read_material(member.value));
        }
        // The sections are read in the order of the file, which is the order of the regions.
        for (const JsonMember& section : std::get<JsonMembers>(value.data)) {
            if (section.repeated) continue;
            if (section.name == "solids") read_solids(o["solids"]);
            if (section.name == "combinations") read_combinations(o["combinations"]);
        }
        for (const JsonNode& item : items_of(o["looks"])) scene_.looks.push_back(read_look(item));
        read_order(o["order"]);
        read_top(o["objects"]);
        if (scene_.objects.empty() && file_.findings.empty()) {
            root.fault("the scene is empty", "add \"solids\" and \"combinations\"");
        }
        return std::move(scene_);
    }

private:
    static std::vector<JsonNode> items_of(const JsonNode& node) {
        return node.present() ? node.items() : std::vector<JsonNode>();
    }
    static std::vector<JsonNode::Member> members_of(const JsonNode& node) {
        return node.present() ? node.members() : std::vector<JsonNode::Member>();
    }

    void read_units(const JsonObject& o) {
        if (const JsonNode units = o["units"]; units.present()) {
            const std::string name = units.string();
            const auto& known = form::units.words;
            if (std::find(known.begin(), known.end(), name) != known.end()) {
                scene_.units = name;
                scene_.unit_length = file_.unit = unit_in_millimetres(name);
            } else if (units.is_string()) {
                std::string list;
                for (const std::string_view unit : known) list += (list.empty() ? "known: " : ", ") + std::string(unit);
                units.fault("there is no unit '" + name + "'", list);
            }
        }
        if (const JsonNode model = o["model_units"]; model.present()) {
            read_members(json_object(model, form::model_units), form::model_units, scene_);
        }
    }

    void read_settings(const JsonObject& o) {
        if (o.has("title")) scene_.title = o["title"].string();
        read_members(o, form::of<Scene>, scene_);
        if (!o.has("camera")) return;
        const JsonObject camera = json_object(o["camera"], form::of<Camera>);
        read_members(camera, form::of<Camera>, scene_.camera);
        check_camera(camera);
    }

    void check_camera(const JsonObject& o) {
        const Camera& camera = scene_.camera;
        if (camera.eye) {
            for (const char* key : {"azimuth", "elevation"})
                if (o.has(key)) o[key].fault("cannot stand beside \"eye\", which gives the direction");
            if (camera.view_size && camera.perspective > 0)
                o["size"].fault("cannot stand beside \"eye\" and \"perspective\", which give it");
        }
        if (camera.center && camera.look_at) o["look_at"].fault("cannot stand beside \"center\": they are one point");
    }

    /// Registers a name. False, with a finding, if the name is empty or was registered before.
    bool take_name(const JsonNode::Member& member, const char* what) {
        if (member.name.empty()) {
            member.fault("a name must not be empty");
            return false;
        }
        const auto [taken, is_new] = index_.emplace(member.name, scene_.objects.size());
        if (!is_new) {
            const Place& other = place_of(scene_.objects[taken->second]);
            member.fault("the name of this " + std::string(what) + " is taken by another object",
                         "that one stands in line " + std::to_string(other.line));
        }
        return is_new;
    }

    void read_solids(const JsonNode& section) {
        for (const JsonNode::Member& member : section.members()) {
            Shape shape = read_json_solid(member.value);
            if (take_name(member, "solid"))
                scene_.objects.push_back(Solid{member.name, std::move(shape), member.place});
        }
    }

    void read_combinations(const JsonNode& section) {
        for (const JsonNode::Member& member : section.members()) {
            Combination combination = read_combination(member);
            if (take_name(member, "combination")) scene_.objects.push_back(std::move(combination));
        }
    }

    Combination read_combination(const JsonNode::Member& member) {
        const JsonObject o = json_object(member.value, form::of<Combination>);
        Combination c;
        c.name = member.name;
        c.place = member.place;
        c.tree = read_json_tree(o["tree"]);
        read_members(o, form::of<Combination>, c);
        if (const JsonNode material = o["material"]; material.present()) {
            Material read = find_material(material);
            c.color = read.color;
            c.finish = std::move(read.finish);
        }
        for (const JsonNode& item : items_of(o["inherit"])) {
            const std::string what = item.string();
            if (what == "color") {
                c.color_inherits = true;
            } else if (what == "finish") {
                c.finish_inherits = true;
            } else if (item.is_string()) {
                item.fault("expected \"color\" or \"finish\"");
            }
        }
        return c;
    }

    Look read_look(const JsonNode& node) {
        const JsonObject o = json_object(node, form::of<Look>);
        Look look;
        read_members(o, form::of<Look>, look);
        if (const JsonNode material = o["material"]; material.present()) {
            Material read = find_material(material);
            look.color = read.color;
            look.finish = std::move(read.finish);
        }
        if (const JsonNode state = o["state"]; state.present())
            look.state = static_cast<State>(state.choice(form::states.words, 0));
        return look;
    }

    Material find_material(const JsonNode& node) {
        if (!node.is_string()) return read_material(node);
        const std::string name = node.string();
        const auto found = materials_.find(name);
        if (found != materials_.end()) return found->second;
        std::vector<std::string_view> known;
        if (!file_.findings.full())
            for (const auto& [material, value] : materials_) known.push_back(material);
        std::sort(known.begin(), known.end());
        node.fault("there is no material '" + name + "'", did_you_mean(name, known));
        return {};
    }

    std::string did_you_mean_object(const std::string& wrong) const {
        return file_.findings.full() ? std::string() : csgrt::did_you_mean_object(scene_, wrong);
    }

    void read_top(const JsonNode& node) {
        std::vector<Matrix> matrices;
        for (const JsonNode& item : items_of(node)) {
            std::optional<JsonObject> placed;
            if (item.is_object()) placed.emplace(json_object(item, form::placed));
            std::string name = placed ? (*placed)["object"].name() : item.name();
            matrices.push_back(placed ? read_json_placement(*placed).value_or(identity) : identity);
            if (!name.empty() && !index_.contains(name)) {
                item.fault("there is no object '" + name + "'", did_you_mean_object(name));
            }
            scene_.top.push_back(std::move(name));
        }
        const auto stays = [](const Matrix& matrix) { return same_bits(matrix, identity); };
        if (!std::ranges::all_of(matrices, stays)) scene_.top_matrices = std::move(matrices);
    }

    /// Sorts the objects into the order that the file gives, in which solids and combinations may be mixed.
    void read_order(const JsonNode& node) {
        if (!node.present()) return;
        std::vector<std::size_t> order;
        std::unordered_set<std::size_t> seen;
        for (const JsonNode& item : node.items()) {
            const std::string name = item.name();
            const auto found = index_.find(name);
            if (found == index_.end()) {
                if (!name.empty()) item.fault("there is no object '" + name + "'", did_you_mean_object(name));
            } else if (!seen.insert(found->second).second) {
                item.fault("'" + name + "' stands twice in the order");
            } else {
                order.push_back(found->second);
            }
        }
        if (!node.is_array() || !file_.findings.empty()) return;
        if (order.size() != scene_.objects.size()) {
            node.fault("the order must name all " + std::to_string(scene_.objects.size()) + " objects, and names " +
                       std::to_string(order.size()));
            return;
        }
        std::vector<Object> ordered;
        ordered.reserve(order.size());
        for (const std::size_t i : order) ordered.push_back(std::move(scene_.objects[i]));
        scene_.objects = std::move(ordered);
    }

    JsonFile file_;
    Scene scene_;
    std::unordered_map<std::string, std::size_t> index_;  // of objects, by name
    std::unordered_map<std::string, Material> materials_;
};

}  // namespace

Scene parse_json_scene(const TextSource& source) {
    Findings findings(source);
    Scene scene;
    if (const std::optional<JsonValue> value = parse_json(source, findings)) {
        scene = SceneReader(source, findings).read(*value);
    }
    findings.throw_if_any();
    return scene;
}

Scene read_json(const std::string& path) { return parse_json_scene(TextSource::read(path)); }

}  // namespace csgrt
