// Object of a binary database: its frame, its name, and the positions of its attributes and its body.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "formats/brlcad/g/bytes.hpp"
#include "formats/brlcad/v5/attributes.hpp"

namespace csgrt {

/// The bytes of an object's part.
struct GBlock {
    std::string_view bytes;
    std::size_t offset = 0;
    bool compressed = false;
};

/// An object of a database, as its frame describes it.
struct GObject {
    enum class Kind { data, header, free, unknown };

    std::size_t offset = 0;
    std::size_t end = 0;  ///< the position of the next object; 0: unknown
    Kind kind = Kind::data;
    int major = 0, minor = 0;
    std::string name;  ///< empty if the object has no name, or an unknown one
    GBlock attributes, body;
};

/// Reads the object at `offset`, without decoding its body. If it throws Fault, `object` has the parts that
/// were read until then.
void read_g_object(const ByteSource& source, std::size_t offset, GObject& object);

/// The attributes of an object. Throws Fault.
std::vector<Attribute> read_g_attributes(const GBlock& block);

/// The bytes of a block. Throws Fault if they are compressed: csgrt has no decompression.
ByteReader read_g_block(const GBlock& block, const char* what);

}  // namespace csgrt
