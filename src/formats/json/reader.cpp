#include "formats/json/reader.hpp"

#include <algorithm>
#include <limits>
#include <unordered_map>
#include <unordered_set>

#include "formats/brlcad/values.hpp"
#include "formats/json/names.hpp"
#include "formats/json/node.hpp"
#include "formats/json/solids.hpp"
#include "formats/json/tree.hpp"
#include "scene/nearest.hpp"
#include "scene/object_path.hpp"

namespace csgrt {

namespace {

constexpr int int_min = std::numeric_limits<int>::min(), int_max = std::numeric_limits<int>::max();

struct Material {
    std::optional<Vec3> color;
    std::optional<Finish> finish;
};

/// From 0, along the axis, to 180 degrees, everywhere.
double read_beam(const JsonNode& node) {
    const double angle = node.not_negative(180);
    if (angle > 180) node.fault("must be an angle from 0 to 180 degrees, between the beam's axis and its edge");
    return angle;
}

/// A vector of any length but 0, as it stands.
Vec3 read_axis(const JsonNode& node) {
    const Vec3 axis = node.vector();
    if (node.is_vector() && axis == Vec3{}) node.fault("has no direction: all its numbers are 0");
    return axis;
}

Emission read_emission(const JsonNode& node) {
    Emission light;
    if (!node.present()) return light;
    const JsonObject o(node, json_form("emission"));
    if (o.has("intensity")) light.intensity = o["intensity"].positive();
    light.fraction = o["fraction"].not_negative(light.fraction);
    light.angle = read_beam(o["angle"]);
    if (o.has("target")) light.target = o["target"].lengths();
    if (o.has("direction")) light.direction = read_axis(o["direction"]);
    light.infinite = o["infinite"].boolean(light.infinite);
    light.visible = o["visible"].boolean(light.visible);
    light.shadows = o["shadows"].integer(0, int_max, light.shadows);
    return light;
}

/// A finish is there as soon as one of its keys is; the others keep their defaults.
Material read_material(const JsonNode& node) {
    const JsonObject o(node, json_form("material"));
    Material material;
    if (o.has("color")) material.color = o["color"].color();
    Finish finish;
    if (o.has("light")) finish.shader = "light";
    if (o.has("shader")) finish.shader = o["shader"].string();
    if (finish.shader == "light") {
        finish.light = read_emission(o["light"]);
    } else if (o.has("light")) {
        o["light"].fault("has a meaning only with the shader \"light\"");
    }
    finish.specular = o["specular"].not_negative(finish.specular);
    finish.diffuse = o["diffuse"].not_negative(finish.diffuse);
    finish.ambient = o["ambient"].not_negative(finish.ambient);
    finish.shine = o["shine"].integer(0, Limits::shine, finish.shine);
    finish.transmit = o["transmit"].not_negative(finish.transmit);
    finish.reflect = o["reflect"].not_negative(finish.reflect);
    for (const char* key : {"shader", "specular", "diffuse", "ambient", "shine", "transmit", "reflect", "light"}) {
        if (o.has(key)) material.finish = finish;
    }
    return material;
}

class SceneReader {
public:
    SceneReader(const TextSource& source, Findings& findings) : file_{source, findings} {}

    Scene read(const JsonValue& value) {
        const JsonNode root(file_, &value, "");
        const JsonObject o(root, json_form("scene"));
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
        // In the order of the file, which is the order of the regions.
        for (const JsonMember& section : std::get<JsonMembers>(value.data)) {
            if (section.repeated) continue;
            if (section.name == "solids") read_solids(o["solids"]);
            if (section.name == "combinations") read_combinations(o["combinations"]);
        }
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
            const auto& known = json_units();
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
            const JsonObject units(model, json_form("model_units"));
            scene_.units = units["name"].string();
            scene_.unit_length = units["millimetres"].positive();
        }
    }

    void read_settings(const JsonObject& o) {
        if (o.has("title")) scene_.title = o["title"].string();
        scene_.ambient = o["ambient"].not_negative(scene_.ambient);
        if (o.has("background")) scene_.background = o["background"].color();
        if (o.has("tolerance")) scene_.tolerance = file_.unit * o["tolerance"].not_negative(0);
        for (const JsonNode& item : items_of(o["lights"])) {
            const JsonObject light(item, json_form("light"));
            Light& read = scene_.lights.emplace_back();
            read.position = light["position"].present() ? light["position"].lengths() : Vec3{};
            if (light.has("color")) read.color = light["color"].color();
            read.intensity = light["intensity"].not_negative(read.intensity);
            read.infinite = light["infinite"].boolean(read.infinite);
            read.angle = read_beam(light["angle"]);
            if (light.has("direction")) read.direction = read_axis(light["direction"]);
        }
        for (const JsonNode& item : items_of(o["region_colors"])) {
            const JsonObject range(item, json_form("region_color"));
            scene_.region_colors.push_back({range["low"].integer(int_min, int_max, 0),
                                            range["high"].integer(int_min, int_max, 0), range["color"].color()});
        }
        if (o.has("camera")) read_camera(JsonObject(o["camera"], json_form("camera")));
    }

    void read_camera(const JsonObject& o) {
        Camera& camera = scene_.camera;
        camera.azimuth = o["azimuth"].number(camera.azimuth);
        camera.elevation = o["elevation"].number(camera.elevation);
        camera.perspective = o["perspective"].not_negative(camera.perspective);
        if (camera.perspective >= 180) o["perspective"].fault("must be 0 (parallel), or an angle below 180 degrees");
        if (o.has("center")) camera.center = o["center"].lengths();
        if (o.has("size")) camera.view_size = o["size"].positive_length();
        if (o.has("eye")) camera.eye = o["eye"].lengths();
        if (o.has("look_at")) camera.look_at = o["look_at"].lengths();
        if (o.has("up")) camera.up = read_axis(o["up"]);
        if (camera.eye) {
            for (const char* key : {"azimuth", "elevation"})
                if (o.has(key)) o[key].fault("cannot stand beside \"eye\", which gives the direction");
            if (camera.view_size && camera.perspective > 0)
                o["size"].fault("cannot stand beside \"eye\" and \"perspective\", which give it");
        }
        if (camera.center && camera.look_at) o["look_at"].fault("cannot stand beside \"center\": they are one point");
    }

    /// False, and a finding, if the name is taken.
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
        const JsonObject o(member.value, json_form("combination"));
        Combination c;
        c.name = member.name;
        c.place = member.place;
        c.tree = read_json_tree(o["tree"]);
        c.region = o["region"].boolean(c.region);
        c.region_id = o["id"].integer(int_min, int_max, c.region_id);
        c.air = o["air"].integer(int_min, int_max, c.air);
        constexpr Fastgen kinds[] = {Fastgen::plate, Fastgen::volume, Fastgen::none};
        c.fastgen = kinds[o["fastgen"].choice(json_fastgen_kinds, 2)];
        c.material_id = o["material_id"].integer(int_min, int_max, c.material_id);
        c.los = o["los"].integer(int_min, int_max, c.los);
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
        for (const JsonNode& item : items_of(node)) {
            std::string name = item.name();
            if (!name.empty() && !index_.contains(name)) {
                item.fault("there is no object '" + name + "'", did_you_mean_object(name));
            }
            scene_.top.push_back(std::move(name));
        }
    }

    /// Puts the objects into the order that is given: solids and combinations may stand in any order among each other.
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
