// An object, in multiples of 8 bytes:
//
//     0x76  flags of the object, of its attributes, of its body  major type  minor type  length
//     name?  attributes?  body?  padding  0x35
//
// The flags tell which parts exist. Each part follows its own length. The object's length is in units of 8 bytes, from
// the 0x76 to the 0x35. A length has 1, 2, 4 or 8 bytes, as the flags say, highest byte first.
#include "formats/brlcad/g/object.hpp"

namespace csgrt {

namespace {

constexpr std::uint8_t magic_begin = 0x76, magic_end = 0x35;
constexpr std::size_t unit = 8;
constexpr std::uint8_t is_present = 0x20;  // the same bit in all three bytes of flags

struct Flags {
    std::uint8_t object, attributes, body;
};

unsigned width_of(std::uint8_t flags) { return flags >> 6; }

GObject::Kind kind_of(std::uint8_t flags) {
    constexpr GObject::Kind kinds[] = {GObject::Kind::data, GObject::Kind::header, GObject::Kind::free,
                                       GObject::Kind::unknown};
    return kinds[flags & 0x03];
}

std::string read_name(ByteReader& bytes, std::uint8_t flags) {
    if ((flags & is_present) == 0) return {};
    const std::uint64_t length = bytes.number(flags >> 3 & 0x03, "the length of the name");
    const std::size_t at = bytes.offset();
    ByteReader name(bytes.take(length, "the name"), at);
    const std::string_view text = name.name("the name");
    if (name.left() > 0) throw Fault{name.offset(), "the name goes on after the zero byte that ends it", {}};
    return std::string(text);
}

GBlock read_block(ByteReader& bytes, std::uint8_t flags, const char* what) {
    GBlock block;
    block.offset = bytes.offset();  // the part's position, even if it is missing
    if ((flags & is_present) == 0) return block;
    const std::uint64_t length = bytes.number(width_of(flags), what);
    block.offset = bytes.offset();
    block.bytes = bytes.take(length, what);
    block.compressed = (flags & 0x07) != 0;
    return block;
}

/// The name of an object that is cut off, for a finding. Empty if the name is cut off, too.
std::string name_if_any(ByteReader bytes, std::uint8_t flags) {
    try {
        return read_name(bytes, flags);
    } catch (const Fault&) {
        return {};
    }
}

}  // namespace

void read_g_object(const ByteSource& source, std::size_t offset, GObject& object) {
    const std::string_view file = source.bytes().substr(offset);
    ByteReader head(file, offset);
    object.offset = offset;
    if (head.byte("an object") != magic_begin) {
        throw Fault{offset, "no object starts here: the byte is not 0x76", "the file is damaged from here on"};
    }
    constexpr const char* what = "the head of an object";
    const Flags flags{head.byte(what), head.byte(what), head.byte(what)};
    object.kind = kind_of(flags.object);
    object.major = head.byte(what);
    object.minor = head.byte(what);
    const std::size_t length_at = head.offset();
    const std::uint64_t units = head.number(width_of(flags.object), "the length of an object");
    const std::size_t head_size = head.offset() - offset;
    object.name = name_if_any(head, flags.object);

    if (units > file.size() / unit) {
        throw Fault{length_at,
                    "the object is " + std::to_string(units) + " times 8 bytes long, but the file ends " + "after " +
                        std::to_string(file.size()) + " bytes of it",
                    "the file is cut off or damaged"};
    }
    const auto length = static_cast<std::size_t>(units) * unit;
    if (length <= head_size) {
        throw Fault{length_at, "the object is " + std::to_string(length) + " bytes long, less than its head needs",
                    "the file is damaged from here on"};
    }
    if (static_cast<std::uint8_t>(file[length - 1]) != magic_end) {
        throw Fault{offset + length - 1, "the object does not end here: the byte is not 0x35",
                    "the file is damaged from here on"};
    }
    object.end = offset + length;
    if (object.kind == GObject::Kind::free) return;

    ByteReader parts(file.substr(head_size, length - 1 - head_size), offset + head_size);
    object.name = read_name(parts, flags.object);
    object.attributes = read_block(parts, flags.attributes, "the attributes");
    object.body = read_block(parts, flags.body, "the body");
}

std::vector<Attribute> read_g_attributes(const GBlock& block) {
    std::vector<Attribute> attributes;
    ByteReader bytes = read_g_block(block, "the attributes");
    // An empty key ends the attributes. Binary attributes may follow, but none that concerns a shape.
    while (bytes.left() > 0 && bytes.peek() != 0) {
        Attribute attribute;
        attribute.key = bytes.name("an attribute");
        attribute.value.offset = bytes.offset();
        attribute.value.text = bytes.text("an attribute's value");
        attributes.push_back(attribute);
    }
    return attributes;
}

ByteReader read_g_block(const GBlock& block, const char* what) {
    if (block.compressed) {
        throw Fault{block.offset, std::string(what) + " of the object are compressed, which csgrt cannot read",
                    "convert the file with BRL-CAD's `g2asc FILE.g FILE.asc`"};
    }
    return {block.bytes, block.offset};
}

}  // namespace csgrt
