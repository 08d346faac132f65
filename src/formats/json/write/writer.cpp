#include "formats/json/write/writer.hpp"

#include <algorithm>
#include <unordered_set>

#include <nlohmann/json.hpp>

#include <csgrt/scene_io.hpp>

#include "formats/brlcad/values.hpp"
#include "formats/json/reader.hpp"
#include "formats/json/scene_forms.hpp"
#include "formats/json/text.hpp"
#include "formats/json/write/write_form.hpp"
#include "formats/json/write/write_object.hpp"
#include "scene/vector.hpp"

namespace csgrt {

namespace {

using nlohmann::ordered_json;

/// An entry of a section.
struct Entry {
    const std::string* name;
    ordered_json value;
};

/// Writes the sections of a scene file, with all lengths in one unit.
class SceneWriter {
public:
    /// `unit`: millimetres in the file's unit, whose name is `unit_name`.
    SceneWriter(const Scene& scene, std::string unit_name, double unit)
        : scene_(scene), unit_name_(std::move(unit_name)), unit_(unit) {}

    std::string text() {
        const ordered_json settings = json_of_settings(), top = json_of_top();
        const std::vector<Entry> solids = entries_of<Solid>();
        const std::vector<Entry> combinations = entries_of<Combination>();
        if (!faults_.empty()) throw Error(Status::scene, std::move(faults_));

        std::string out = "{";
        for (const auto& [key, value] : settings.items()) append_key(out, key, value);
        append_section(out, "solids", solids);
        append_section(out, "combinations", combinations);
        if (const ordered_json order = json_of_order(); !order.empty()) append_key(out, "order", order);
        if (!top.empty()) append_key(out, "objects", top);
        return out + "\n}\n";
    }

    /// Whether every length of the text reads back to the same bits.
    bool exact() const { return unit_.exact(); }

private:
    void fault(const Place& place, std::string message) { faults_.push_back({place, std::move(message), {}, {}}); }

    /// Reports the object if its value holds bytes that are not UTF-8, or a number that is not finite: JSON holds
    /// neither.
    void check(const Place& place, const std::string& what, const ordered_json& value) {
        if (!unit_.finite()) fault(place, what + " has a number that is not finite, which JSON cannot hold");
        unit_.forget_infinities();
        try {
            (void)value.dump();
        } catch (const nlohmann::json::type_error&) {
            fault(place, what + " has a text that is not UTF-8, which JSON cannot hold");
        }
    }

    ordered_json json_of_settings() {
        ordered_json out = {{"csgrt", json_format_version}};
        if (!scene_.title.empty()) out["title"] = scene_.title;
        out["units"] = unit_name_;
        if (scene_.units != unit_name_ || scene_.unit_length != unit_in_millimetres(unit_name_)) {
            out["model_units"] = {{"name", scene_.units}, {"millimetres", unit_.number(scene_.unit_length)}};
        }
        if (ordered_json camera = json_of_camera(); !camera.empty()) out["camera"] = std::move(camera);
        write_members(out, form::of<Scene>, scene_, unit_);
        ordered_json looks = ordered_json::array();
        for (const Look& look : scene_.looks) looks.push_back(json_of(look, unit_));
        if (!looks.empty()) out["looks"] = std::move(looks);
        check({}, "the scene", out);
        return out;
    }

    ordered_json json_of_top() {
        ordered_json top = ordered_json::array();
        for (std::size_t i = 0; i < scene_.top.size(); ++i) {
            const bool is_placed = i < scene_.top_matrices.size();
            top.push_back(json_of(
                TreeNode{.object = scene_.top[i], .matrix = is_placed ? scene_.top_matrices[i] : identity}, unit_));
        }
        check({}, "the list of objects", top);
        if (!scene_.top_matrices.empty() && scene_.top_matrices.size() != scene_.top.size())
            fault({}, "the list of objects has other places than objects");
        return top;
    }

    ordered_json json_of_camera() {
        Camera camera = scene_.camera;
        if (camera.eye) camera.azimuth = Camera().azimuth, camera.elevation = Camera().elevation;
        return write_form(camera, unit_);
    }

    template <class Kind>
    std::vector<Entry> entries_of() {
        std::vector<Entry> entries;
        for (const Object& object : scene_.objects) {
            const Kind* it = std::get_if<Kind>(&object);
            if (it == nullptr) continue;
            const std::string what = "'" + it->name + "'";
            std::string wrong;
            ordered_json value;
            if constexpr (std::is_same_v<Kind, Solid>) {
                value = json_of(it->shape, unit_);
            } else {
                value = json_of(*it, unit_, wrong);
            }
            if (!wrong.empty()) fault(it->place, what + ": " + wrong);
            if (it->name.empty()) fault(it->place, "an object has no name");
            if (!names_.insert(it->name).second) fault(it->place, "there are two objects named " + what);
            check(it->place, what, ordered_json::array({it->name, value}));
            entries.push_back({&it->name, std::move(value)});
        }
        return entries;
    }

    /// The names of all objects, if solids and combinations are mixed. Nothing otherwise, because then the sections
    /// give the order.
    ordered_json json_of_order() const {
        const auto is_solid = [](const Object& object) { return std::holds_alternative<Solid>(object); };
        ordered_json names = ordered_json::array();
        if (std::is_partitioned(scene_.objects.begin(), scene_.objects.end(), is_solid)) return names;
        for (const Object& object : scene_.objects) names.push_back(name_of(object));
        return names;
    }

    static void append_key(std::string& out, const std::string& key, const ordered_json& value) {
        const std::string label = "  " + json_string(key) + ": ";
        out += (out.size() == 1 ? "\n" : ",\n") + label;
        append_json(out, value, 2, label.size());
    }

    static void append_section(std::string& out, const std::string& key, const std::vector<Entry>& entries) {
        if (entries.empty()) return;
        out += ",\n  \"" + key + "\": {";
        bool first = true;
        for (const Entry& entry : entries) {
            const std::string label = "    " + json_string(*entry.name) + ": ";
            out += (first ? "\n" : ",\n") + label;
            first = false;
            append_json(out, entry.value, 4, label.size());
        }
        out += "\n  }";
    }

    const Scene& scene_;
    const std::string unit_name_;
    JsonUnit unit_;
    std::unordered_set<std::string> names_;
    std::vector<Diagnostic> faults_;
};

}  // namespace

std::string json_scene_text(const Scene& scene) {
    const auto& units = form::units.words;
    if (scene.units != "mm" && std::find(units.begin(), units.end(), scene.units) != units.end() &&
        scene.unit_length == unit_in_millimetres(scene.units)) {
        SceneWriter writer(scene, scene.units, scene.unit_length);
        std::string text = writer.text();
        if (writer.exact()) return text;
    }
    return SceneWriter(scene, "mm", 1).text();
}

std::string json_text(const Shape& shape) {
    JsonUnit unit(1);
    const ordered_json value = json_of(shape, unit);
    if (!unit.finite()) throw Error(Status::scene, "the solid has a number that is not finite, which JSON cannot hold");
    std::string text;
    append_json(text, value, 0, 0);
    return text;
}

}  // namespace csgrt
