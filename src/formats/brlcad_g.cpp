// A database is a row of objects. The first is its header; _GLOBAL holds title, unit and region colours as attributes;
// geometry is solids and combinations, whose attributes make them regions. Binary data may be cells of a solid. All
// other objects (free storage, notes) do not matter to a scene. Lengths are millimetres; the unit is for display.
#include "formats/brlcad_g.hpp"

#include <new>
#include <utility>

#include "formats/brlcad_g_bytes.hpp"
#include "formats/brlcad_g_object.hpp"
#include "formats/brlcad_g_solids.hpp"
#include "formats/brlcad_g_tree.hpp"
#include "formats/brlcad_objects.hpp"
#include "formats/brlcad_v5_attributes.hpp"

namespace csgrt {

namespace {

constexpr int major_geometry = 1, major_attributes = 2, major_numbers = 9;
constexpr int minor_combination = 31;

/// Records of release 4 start with a letter, the first with I, a unit's number and the release.
bool is_release_4(std::string_view bytes) {
    return bytes.starts_with('I') && bytes.substr(2, 2) == "v4";
}

class GReader {
public:
    explicit GReader(const ByteSource& source) : source_(source), findings_(source), objects_(findings_) {}

    Scene read() {
        const std::string_view bytes = source_.bytes();
        if (bytes.empty()) {
            findings_.add(0, {}, "the file is empty");
        } else if (is_release_4(bytes)) {
            findings_.add(0, {}, "this is a database of release 4",
                          "convert it with BRL-CAD's `dbupgrade OLD.g NEW.g`");
        } else {
            read_objects(bytes.size());
        }
        findings_.throw_if_any();
        scene_.objects = objects_.take(source_.name(), scene_.warnings);
        return std::move(scene_);
    }

private:
    void read_objects(std::size_t size) {
        for (std::size_t at = 0; at < size && !findings_.full();) {
            GObject object;
            try {
                read_g_object(source_, at, object);
                read_object(object);
            } catch (Fault& fault) {
                findings_.add(std::move(fault), object.name);
            }
            if (object.end == 0) return;
            at = object.end;
        }
    }

    void read_object(const GObject& object) {
        if (object.kind == GObject::Kind::unknown) {
            throw Fault{object.offset + 1, "the object is neither data, nor header, nor free", {}};
        }
        if ((object.kind == GObject::Kind::header) != (object.offset == 0)) {
            throw Fault{object.offset, object.offset == 0 ? "the file does not start with the header of a database"
                                                          : "a second header of a database", {}};
        }
        if (object.kind != GObject::Kind::data) return;
        if (object.major == major_attributes && object.name == "_GLOBAL") return read_global(object);
        if (object.major == major_geometry) return read_geometry(object);
        if (object.major == major_numbers) read_numbers(object);
    }

    void read_global(const GObject& object) {
        for (const Attribute& attribute : read_g_attributes(object.attributes)) {
            set_global_attribute(scene_, attribute, source_);
        }
    }

    void read_geometry(const GObject& object) {
        if (object.name.empty()) throw Fault{object.offset, "the object has no name", {}};
        Place place = source_.place(object.offset, object.name);
        if (object.minor == minor_combination) {
            objects_.add(read_combination(object, std::move(place)), object.offset);
        } else {
            BrlcadItem item = read_g_solid(object.minor, object.body);
            objects_.add(object.name, std::move(item), std::move(place), object.offset);
        }
    }

    /// The cells of an ebm, vol or dsp. Those that are compressed hold nothing that csgrt could use.
    void read_numbers(const GObject& object) {
        if (object.name.empty()) throw Fault{object.offset, "the object has no name", {}};
        BrlcadNumbers numbers;
        if (!object.body.compressed) numbers = {object.minor, std::string(object.body.bytes)};
        objects_.add(object.name, {std::move(numbers)}, source_.place(object.offset, object.name), object.offset);
    }

    Combination read_combination(const GObject& object, Place place) {
        Combination combination;
        combination.name = object.name;
        combination.tree = read_g_tree(object.body, source_, object.name);
        combination.place = std::move(place);
        set_attributes(combination, read_g_attributes(object.attributes));
        return combination;
    }

    const ByteSource& source_;
    Findings findings_;
    BrlcadObjects objects_;
    Scene scene_ = brlcad_scene();
};

}  // namespace

Scene read_brlcad_g(const std::string& path) {
    try {
        return parse_brlcad_g(ByteSource(path, read_file(path)));
    } catch (const std::bad_alloc&) {
        throw Error(Status::out_of_memory, path + ": the model does not fit the memory");
    }
}

Scene parse_brlcad_g(const ByteSource& source) {
    return GReader(source).read();
}

}  // namespace csgrt
