// The objects of a database while it is read. Their names are unique, and found quickly. Some are no solids but parts
// of them (sketches, cells of an ebm, vol or dsp): they are put where they belong when all is read.
#pragma once

#include <cstddef>
#include <string>
#include <unordered_map>
#include <variant>
#include <vector>

#include <csgrt/scene.hpp>

#include "formats/source.hpp"

namespace csgrt {

/// An empty scene with BRL-CAD's tolerance, which its files do not state.
inline Scene brlcad_scene(bool lenient) {
    Scene scene;
    scene.tolerance = 0.0005;
    scene.lenient = lenient;
    return scene;
}

/// Numbers under a name (BRL-CAD's binunif), as they stand in a binary database: highest byte first.
struct BrlcadNumbers {
    static constexpr int bytes = 4, words = 5;  ///< types: unsigned, of 8 and of 16 bits
    int type = 0;
    std::string data;
};

/// An object that has no inside and is no part of a solid: a grip, a joint, a note.
struct BrlcadNothing {
    std::string type;
};

/// Points (BRL-CAD's pnts). Each with a scale is a ball.
struct BrlcadPoints {
    struct Ball {
        Vec3 center;
        double radius;
    };
    std::vector<Ball> balls;
    std::size_t without_scale = 0;  ///< points
};

/// What stands under a name, unless it is a combination.
struct BrlcadItem {
    std::variant<Shape, Sketch, BrlcadNumbers, BrlcadNothing, BrlcadPoints> content;
    bool cells_in_object = false;  ///< an ebm, vol or dsp: its `file` names an object, not a file
};

/// Whether objects of a type have no inside, so that nothing of them needs to be read.
bool is_brlcad_nothing(std::string_view type);

class BrlcadObjects {
public:
    explicit BrlcadObjects(Findings& findings) : findings_(findings) {}

    /// Keeps the object; a second one of a name is a finding at `offset`, or borne, and is dropped. An extrude or
    /// revolve comes with no more of its sketch than the name; an ebm, vol or dsp without cells.
    void add(Combination combination, std::size_t offset);
    void add(const std::string& name, BrlcadItem item, Place place, std::size_t offset);

    /// An object that cannot be read: in a lenient scene it is Unsupported, with the reason.
    void add_broken(const std::string& name, std::string type, Fault fault);

    bool contains(const std::string& name) const { return index_.count(name) != 0; }
    /// The combination of that name, or nullptr. Valid until the next `add`.
    Combination* find_combination(const std::string& name);

    /// Solids and combinations in the order in which they came; leaves none. Solids are completed from the other
    /// objects and from files, whose names are relative to the folder of `model` and which lie below one of
    /// `file_folders`; one whose parts are not to be had becomes Unsupported, with the reason. What has no inside is
    /// left out, or, if a combination uses it, is the empty set; in a lenient scene, Unsupported. Points are the union
    /// of their balls: a region of its own outside all regions, as any solid is. What is borne is added to `warnings`.
    std::vector<Object> take(const std::string& model, const std::vector<std::string>& file_folders,
                             std::vector<Warning>& warnings);

private:
    struct Entry {
        std::string name;
        Place place;
        std::variant<Combination, BrlcadItem> object;
    };
    void add(Entry entry, std::size_t offset);
    const Entry* find(const std::string& name) const;
    std::vector<bool> used_entries() const;
    void add_balls(const Entry& entry, const BrlcadPoints& points, bool used, std::vector<Object>& objects,
                   std::vector<Warning>& warnings) const;

    Findings& findings_;
    std::vector<Entry> entries_;
    std::unordered_map<std::string, std::size_t> index_;
};

}  // namespace csgrt
