// Reader of a binary database, which is a sequence of objects. The first object is the header. The attributes of
// _GLOBAL are the title, the unit and the region colours. Other objects are solids, combinations, and binary data that
// may be a solid's cells. Attributes make a combination a region. Free storage and notes are ignored. Lengths are in
// millimetres; the unit is for display.
#include "formats/brlcad/g/reader.hpp"

#include <new>
#include <utility>

#include "formats/brlcad/g/bytes.hpp"
#include "formats/brlcad/g/object.hpp"
#include "formats/brlcad/g/solids.hpp"
#include "formats/brlcad/g/tree.hpp"
#include "formats/brlcad/objects.hpp"
#include "formats/brlcad/shader.hpp"
#include "formats/brlcad/v5/attributes.hpp"

namespace csgrt {

namespace {

constexpr int major_geometry = 1, major_attributes = 2, major_numbers = 9;
constexpr int minor_combination = 31;

/// Does the file begin as databases of release 4 do? Their first record begins with I, a unit's number and the release.
bool is_release_4(std::string_view bytes) {
    return bytes.size() > 2 && bytes.starts_with('I') && bytes.substr(2, 2) == "v4";
}

/// Reads a database object by object. A broken object becomes a finding, and reading goes on at the next.
class GReader {
public:
    GReader(const ByteSource& source, bool lenient)
        : source_(source),
          scene_(brlcad_scene(lenient)),
          findings_(source, lenient ? &scene_.warnings : nullptr),
          objects_(findings_) {}

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
        objects_.take(scene_, source_.name(), source_.file_folders);
        warn_of_shaders(scene_);
        return std::move(scene_);
    }

private:
    void read_objects(std::size_t size) {
        for (std::size_t at = 0; at < size;) {
            GObject object;
            try {
                read_g_object(source_, at, object);
                check_header(object);
                read_object(object);
            } catch (Fault& fault) {
                // Without an object's end, the next object cannot be found. Without a header at its start, the file is
                // of another kind.
                if (object.end == 0 || is_misplaced(object)) {
                    findings_.add(std::move(fault), object.name);
                } else {
                    findings_.tolerate(std::move(fault), object.name, "left out");
                }
            }
            if (object.end == 0) return;
            at = object.end;
        }
    }

    static bool is_misplaced(const GObject& object) {
        return (object.kind == GObject::Kind::header) != (object.offset == 0);
    }

    static void check_header(const GObject& object) {
        if (object.kind == GObject::Kind::unknown) {
            throw Fault{object.offset + 1, "the object is neither data, nor header, nor free", {}};
        }
        if (is_misplaced(object)) {
            throw Fault{object.offset,
                        object.offset == 0 ? "the file does not start with the header of a database"
                                           : "a second header of a database",
                        {}};
        }
    }

    void read_object(const GObject& object) {
        if (object.kind != GObject::Kind::data) return;
        if (object.major == major_attributes && object.name == "_GLOBAL") return read_global(object);
        if (object.major == major_geometry) return read_geometry(object);
        if (object.major == major_numbers) read_numbers(object);
    }

    void read_global(const GObject& object) {
        try {
            for (const Attribute& attribute : read_g_attributes(object.attributes))
                set_global_attribute(scene_, attribute, source_);
        } catch (Fault& fault) {
            findings_.tolerate(std::move(fault), object.name, passed_over);
        }
    }

    void read_geometry(const GObject& object) {
        if (object.name.empty()) throw Fault{object.offset, "the object has no name", {}};
        Place place = source_.place(object.offset, object.name);
        try {
            if (object.minor == minor_combination) {
                objects_.add(read_combination(object, std::move(place)), object.offset);
            } else {
                BrlcadItem item = read_g_solid(object.minor, object.body);
                objects_.add(object.name, std::move(item), std::move(place), object.offset);
            }
        } catch (Fault& fault) {
            objects_.add_broken(object.name, g_type_name(object.minor), std::move(fault));
        }
    }

    /// Reads the cells of an ebm, vol or dsp. csgrt cannot use compressed cells.
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
        try {
            set_attributes(combination, read_g_attributes(object.attributes), findings_);
        } catch (Fault& fault) {
            findings_.tolerate(std::move(fault), object.name, passed_over);
        }
        return combination;
    }

    const ByteSource& source_;
    Scene scene_;
    Findings findings_;
    BrlcadObjects objects_;
};

}  // namespace

Scene read_brlcad_g(const std::string& path, bool lenient, const std::vector<std::string>& file_folders) {
    try {
        ByteSource source(path, read_file(path));
        source.file_folders = file_folders_of(path, file_folders);
        return parse_brlcad_g(source, lenient);
    } catch (const std::bad_alloc&) {
        throw Error(Status::out_of_memory, path + ": the model does not fit the memory");
    }
}

bool is_brlcad_g(std::string_view bytes) {
    constexpr char begin = 0x76;
    constexpr unsigned kind = 3, header = 1;  // bits of the second byte
    return is_release_4(bytes) ||
           (bytes.size() > 1 && bytes[0] == begin && (static_cast<unsigned>(bytes[1]) & kind) == header);
}

Scene parse_brlcad_g(const ByteSource& source, bool lenient) { return GReader(source, lenient).read(); }

}  // namespace csgrt
