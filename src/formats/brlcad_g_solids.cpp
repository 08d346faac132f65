#include "formats/brlcad_g_solids.hpp"

#include <iterator>

#include "formats/brlcad_values.hpp"

namespace csgrt {

namespace {

/// BRL-CAD's numbers of the types that csgrt reads.
enum Type : int { tor = 1, tgc = 2, ell = 3, arb8 = 4, half = 6, rec = 7, sph = 10, arbn = 14, ehy = 20 };

/// BRL-CAD's names of all its types, by their numbers; null where there is none.
constexpr const char* type_names[] = {
    nullptr,   "tor",  "tgc",   "ell",     "arb8",  "ars",      "half",     "rec",     "poly",     "bspline",
    "sph",     "nmg",  "ebm",   "vol",     "arbn",  "pipe",     "part",     "rpc",     "rhc",      "epa",
    "ehy",     "eto",  "grip",  "joint",   "hf",    "dsp",      "sketch",   "extrude", "submodel", "cline",
    "bot",     "comb", nullptr, "binunif", nullptr, "superell", "metaball", "brep",    "hyp",      "constrnt",
    "revolve", "pnts", "annot", "hrt",     "datum", "script",   "material",
};

std::string type_name_of(int minor) {
    const bool known = minor >= 0 && minor < static_cast<int>(std::size(type_names)) && type_names[minor] != nullptr;
    return known ? type_names[minor] : "type " + std::to_string(minor);
}

constexpr std::size_t real_size = 8;

void expect_size(const ByteReader& bytes, std::size_t size, int minor) {
    if (bytes.left() == size) return;
    throw Fault{bytes.offset(), "the body of the " + type_name_of(minor) + " has " + std::to_string(bytes.left()) +
                                    " bytes, not " + std::to_string(size), {}};
}

Shape read_tor(ByteReader& bytes) {
    const Vec3 v = bytes.vec3("V"), h = bytes.vec3("H");
    const double r_a = bytes.real("r_a"), r_h = bytes.real("r_h");
    return Tor{v, h, r_a, r_h};
}

Shape read_ehy(ByteReader& bytes) {
    const Vec3 v = bytes.vec3("V"), h = bytes.vec3("H"), a = bytes.vec3("A");
    const double r_1 = bytes.real("r_1"), r_2 = bytes.real("r_2"), c = bytes.real("c");
    return Ehy{v, h, unit_vector(a), r_1, r_2, c};
}

Plane read_plane(ByteReader& bytes) {
    const Vec3 normal = bytes.vec3("a plane's normal");
    return unit_plane(normal, bytes.real("a plane's distance"));
}

Shape read_arb8(ByteReader& bytes) {
    Arb arb;
    for (Vec3& vertex : arb.vertices) vertex = bytes.vec3("a vertex");
    return arb;
}

Shape read_arbn(ByteReader& bytes) {
    constexpr unsigned four_bytes = 2;
    const std::size_t count_at = bytes.offset();
    const std::uint64_t count = bytes.number(four_bytes, "the number of planes");
    if (count < 1 || count > Limits::faces) {
        throw Fault{count_at, "the arbn has " + std::to_string(count) + " planes, not 1 to " +
                                  std::to_string(Limits::faces), {}};
    }
    expect_size(bytes, static_cast<std::size_t>(count) * 4 * real_size, arbn);
    Arbn solid;
    for (std::uint64_t i = 0; i < count; ++i) solid.planes.push_back(read_plane(bytes));
    return solid;
}

/// How many numbers the body of a type holds that csgrt reads; 0 for other types.
std::size_t numbers_of(int minor) {
    switch (minor) {
        case tor: return 8;
        case tgc: case rec: return 18;
        case ell: case sph: case ehy: return 12;
        case arb8: return 24;
        case half: return 4;
        default: return 0;
    }
}

}  // namespace

Shape read_g_solid(int minor, const GBlock& body) {
    const std::size_t numbers = numbers_of(minor);
    if (numbers == 0 && minor != arbn) return Unsupported{type_name_of(minor)};

    ByteReader bytes = read_g_block(body, "the numbers");
    if (minor == arbn) return read_arbn(bytes);
    expect_size(bytes, numbers * real_size, minor);
    // Braces evaluate their parts from left to right, which is the order of the file.
    switch (minor) {
        case tor: return read_tor(bytes);
        case tgc: case rec:
            return Tgc{bytes.vec3("V"), bytes.vec3("H"), bytes.vec3("A"),
                       bytes.vec3("B"), bytes.vec3("C"), bytes.vec3("D")};
        case ell: case sph: return Ell{bytes.vec3("V"), bytes.vec3("A"), bytes.vec3("B"), bytes.vec3("C")};
        case arb8: return read_arb8(bytes);
        case half: return Half{read_plane(bytes)};
        default: return read_ehy(bytes);
    }
}

}  // namespace csgrt
