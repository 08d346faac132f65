// Objects of a database while it is read. Their names are unique, and found quickly. Some objects are parts of solids
// (sketches, cells of an ebm, vol or dsp): they are put into their solids when all objects are read.
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

/// Numbers under a name (BRL-CAD's binunif), in the form of a binary database: highest byte first.
struct BrlcadNumbers {
    static constexpr int bytes = 4, words = 5;  ///< types: unsigned, of 8 and of 16 bits
    int type = 0;
    std::string data;
};

/// An object that has no inside and is not a part of a solid: a grip, a joint, a note.
struct BrlcadNothing {
    std::string type;
};

/// Points (BRL-CAD's pnts). A point with a scale is a ball.
struct BrlcadPoints {
    struct Ball {
        Vec3 center;
        double radius;
    };
    std::vector<Ball> balls;
    std::size_t without_scale = 0;  ///< number of points
};

/// The object of a name, unless it is a combination.
struct BrlcadItem {
    std::variant<Shape, Sketch, BrlcadNumbers, BrlcadNothing, BrlcadPoints> content;
    bool cells_in_object = false;  ///< an ebm, vol or dsp: its `file` names an object, not a file
};

/// Whether objects of a type have no inside, so that they need not be read.
bool is_brlcad_nothing(std::string_view type);

/// Collects the objects of a database, whatever its form. When all are read, take() completes solids from the objects
/// and files that they name.
class BrlcadObjects {
public:
    explicit BrlcadObjects(Findings& findings) : findings_(findings) {}

    /// Adds an object. A second object of a name is dropped, with a finding at `offset`, or with a warning in a lenient
    /// scene. An extrude or revolve has only the name of its sketch yet; an ebm, vol or dsp no cells.
    void add(Combination combination, std::size_t offset);
    void add(const std::string& name, BrlcadItem item, Place place, std::size_t offset);

    /// Adds an object that cannot be read: in a lenient scene it is Unsupported, with the reason.
    void add_broken(const std::string& name, std::string type, Fault fault);

    bool contains(const std::string& name) const { return index_.count(name) != 0; }
    /// The combination of a name, or nullptr. Valid until the next `add`.
    Combination* find_combination(const std::string& name);

    /// Returns solids and combinations in the order in which they were added, and leaves none. Solids are completed
    /// from the other objects and from files, whose names are relative to the folder of `model` and which lie below one
    /// of `file_folders`. A solid whose parts are not available becomes Unsupported, with the reason. An object without
    /// an inside is left out, or, if a combination uses it, is the empty set; in a lenient scene, Unsupported. Points
    /// are the union of their balls: a region of their own outside all regions, as any solid is. Faults that a lenient
    /// scene tolerates are added to `warnings`.
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
