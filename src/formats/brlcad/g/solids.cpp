#include "formats/brlcad/g/solids.hpp"

#include <iterator>

#include "formats/brlcad/described.hpp"
#include "formats/brlcad/points.hpp"
#include "formats/brlcad/values.hpp"

namespace csgrt {

namespace {

template <class S>
BrlcadItem described(ByteReader& b) {
    return {Shape(read_described<S>([&](const char* what) { return b.vec3(what); },
                                    [&](const char* what) { return b.real(what); }))};
}

Shape arb8(ByteReader& b) {
    Arb arb;
    for (Vec3& vertex : arb.vertices) vertex = b.vec3("a vertex");
    return arb;
}

Plane plane(ByteReader& b) {
    const Vec3 normal = b.vec3("a plane's normal");
    return unit_plane(normal, b.real("a plane's distance"));
}

Shape half(ByteReader& b) { return Half{plane(b)}; }

Shape arbn(ByteReader& b) {
    const std::size_t count_at = b.offset();
    const std::uint32_t count = b.count(4 * real_size, "the number of planes");
    if (count < 1 || count > Limits::faces) {
        throw Fault{count_at,
                    "the arbn has " + std::to_string(count) + " planes, not 1 to " + std::to_string(Limits::faces),
                    {}};
    }
    Arbn solid;
    for (std::uint32_t i = 0; i < count; ++i) solid.planes.push_back(plane(b));
    return solid;
}

// Initializers in braces are evaluated from left to right, so they read the values in the file's order. These solids
// need code because this is not the description's order.

Shape eto(ByteReader& b) { return Eto{b.vec3("V"), b.vec3("N"), b.vec3("C"), b.real("r"), b.real("r_d")}; }

/// Eight more bytes follow, which BRL-CAD does not use.
BrlcadItem hyp(ByteReader& b) {
    BrlcadItem solid = described<Hyp>(b);
    if (b.left() == real_size) b.take(real_size, "what follows a hyp");
    return solid;
}

Shape cline(ByteReader& b) {
    const double thickness = b.real("the thickness"), radius = b.real("the radius");
    const Vec3 v = b.vec3("V");
    return Cline{v, b.vec3("H"), radius, thickness};
}

template <auto read>
BrlcadItem item(ByteReader& bytes) {
    return {read(bytes)};
}

/// The table of types, by their numbers: BRL-CAD's names, and readers for the types that csgrt knows.
struct Type {
    const char* name = nullptr;
    BrlcadItem (*read)(ByteReader&) = nullptr;
};
constexpr Type types[] = {
    {},                                   // 0
    {"tor", described<Tor>},              //
    {"tgc", described<Tgc>},              //
    {"ell", described<Ell>},              //
    {"arb8", item<arb8>},                 //
    {"ars", item<read_g_ars>},            // 5
    {"half", item<half>},                 //
    {"rec", described<Tgc>},              //
    {"poly"},                             //
    {"bspline"},                          //
    {"sph", described<Ell>},              // 10
    {"nmg", item<read_g_nmg>},            //
    {"ebm", read_g_ebm},                  //
    {"vol", read_g_vol},                  //
    {"arbn", item<arbn>},                 //
    {"pipe", item<read_g_pipe>},          // 15
    {"part", described<Part>},            //
    {"rpc", described<Rpc>},              //
    {"rhc", described<Rhc>},              //
    {"epa", described<Epa>},              //
    {"ehy", described<Ehy>},              // 20
    {"eto", item<eto>},                   //
    {"grip"},                             //
    {"joint"},                            //
    {"hf"},                               //
    {"dsp", read_g_dsp},                  // 25
    {"sketch", item<read_g_sketch>},      //
    {"extrude", item<read_g_extrude>},    //
    {"submodel"},                         //
    {"cline", item<cline>},               //
    {"bot", item<read_g_bot>},            // 30
    {"comb"},                             //
    {},                                   //
    {"binunif"},                          //
    {},                                   //
    {"superell", described<Superell>},    // 35
    {"metaball", item<read_g_metaball>},  //
    {"brep"},                             //
    {"hyp", hyp},                         //
    {"constrnt"},                         //
    {"revolve", item<read_g_revolve>},    // 40
    {"pnts", item<read_g_points>},        //
    {"annot"},                            //
    {"hrt", described<Hrt>},              //
    {"datum"},                            //
    {"script"},                           // 45
    {"material"},                         //
};

Type type_of(int minor) { return minor >= 0 && minor < static_cast<int>(std::size(types)) ? types[minor] : Type{}; }

}  // namespace

std::string g_type_name(int minor) {
    const Type type = type_of(minor);
    return type.name != nullptr ? type.name : "type " + std::to_string(minor);
}

BrlcadItem read_g_solid(int minor, const GBlock& body) {
    const Type type = type_of(minor);
    const std::string name = g_type_name(minor);
    if (is_brlcad_nothing(name)) return {BrlcadNothing{name}};
    if (type.read == nullptr) return {Shape(Unsupported{name})};

    ByteReader bytes = read_g_block(body, "the numbers");
    BrlcadItem read = type.read(bytes);
    if (bytes.left() > 0) {
        throw Fault{
            bytes.offset(),
            "the body of the " + name + " should end here, but has " + std::to_string(bytes.left()) + " bytes more",
            {}};
    }
    return read;
}

}  // namespace csgrt
