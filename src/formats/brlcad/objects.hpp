// Objects of a database while it is read, by their names, which are unique. Sketches and the cells of an ebm, vol or
// dsp are parts of solids: they are put into their solids after all objects are read.
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

/// A named array of numbers (BRL-CAD's binunif), as bytes, highest byte first.
struct BrlcadNumbers {
    static constexpr int bytes = 4, words = 5;  ///< types of unsigned numbers: 8 and 16 bits
    static constexpr int signed_bytes = 12;
    int type = 0;
    std::string data;
};

/// An object without volume that is not a part of a solid: a grip, a joint, a note.
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
    std::size_t without_scale = 0;  ///< number of points without a scale
};

/// A named object other than a combination.
struct BrlcadItem {
    std::variant<Shape, Sketch, BrlcadNumbers, BrlcadNothing, BrlcadPoints> content;
    bool cells_in_object = false;  ///< an ebm, vol or dsp: its `file` names an object, not a file
};

/// Whether objects of a type have no volume, so that they need not be read.
bool is_brlcad_nothing(std::string_view type);

/// Collects the objects of a database of any form. After all are read, take() completes solids with the objects and
/// files that they name.
class BrlcadObjects {
public:
    explicit BrlcadObjects(Findings& findings) : findings_(findings) {}

    /// Adds an object. A second object with the same name is dropped, with a finding at `offset`, or in a lenient scene
    /// with a warning. An extrude or revolve has only its sketch's name until take(), and an ebm, vol or dsp has no
    /// cells.
    void add(Combination combination, std::size_t offset);
    void add(const std::string& name, BrlcadItem item, Place place, std::size_t offset);

    /// Adds an object that cannot be read: in a lenient scene it is Unsupported, with the reason.
    void add_broken(const std::string& name, std::string type, Fault fault);

    bool contains(const std::string& name) const { return index_.count(name) != 0; }
    /// The combination with this name, or nullptr. Valid until the next `add`.
    Combination* find_combination(const std::string& name);

    /// Takes all solids and combinations into a scene, in the order in which they were added, and its densities. Solids
    /// are completed with other objects and with files, whose names are relative to the folder of `model` and which
    /// must be below one of `file_folders`. A solid whose parts are not available becomes Unsupported, with the reason.
    /// An object without volume is left out; if a combination uses it, it becomes the empty set, or Unsupported in a
    /// lenient scene. Points become the union of their balls. Faults that a lenient scene tolerates are added to its
    /// warnings.
    void take(Scene& scene, const std::string& model, const std::vector<std::string>& file_folders);

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
