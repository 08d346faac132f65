#include "formats/brlcad/v5/solids.hpp"

#include "formats/brlcad/points.hpp"
#include "formats/brlcad/values.hpp"

namespace csgrt {

namespace {

Shape arb8(Parameters& p) {
    constexpr std::string_view keys[] = {"V1", "V2", "V3", "V4", "V5", "V6", "V7", "V8"};
    Arb arb;
    for (std::size_t i = 0; i < 8; ++i) arb.vertices[i] = p.vec3(keys[i]);
    return arb;
}

Shape arbn(Parameters& p) {
    Arbn solid;
    const int count = p.integer("N", 1, static_cast<int>(Limits::faces));
    for (int i = 0; i < count; ++i) {
        const auto plane = p.numbers<4>("P" + std::to_string(i));
        solid.planes.push_back(unit_plane({plane[0], plane[1], plane[2]}, plane[3]));
    }
    return solid;
}

Shape half(Parameters& p) {
    const Vec3 normal = p.vec3("N");
    return Half{unit_plane(normal, p.number("d"))};
}

// Braces evaluate their parts from left to right, so the first missing key is the one that is named.

Shape ell(Parameters& p) { return Ell{p.vec3("V"), p.vec3("A"), p.vec3("B"), p.vec3("C")}; }

Shape tgc(Parameters& p) { return Tgc{p.vec3("V"), p.vec3("H"), p.vec3("A"), p.vec3("B"), p.vec3("C"), p.vec3("D")}; }

Shape tor(Parameters& p) { return Tor{p.vec3("V"), p.vec3("H"), p.number("r_a"), p.number("r_h")}; }

Shape ehy(Parameters& p) {
    return Ehy{p.vec3("V"), p.vec3("H"), unit_vector(p.vec3("A")), p.number("r_1"), p.number("r_2"), p.number("c")};
}

Shape part(Parameters& p) { return Part{p.vec3("V"), p.vec3("H"), p.number("r_v"), p.number("r_h")}; }

Shape epa(Parameters& p) {
    return Epa{p.vec3("V"), p.vec3("H"), unit_vector(p.vec3("A")), p.number("r_1"), p.number("r_2")};
}

Shape rpc(Parameters& p) { return Rpc{p.vec3("V"), p.vec3("H"), p.vec3("B"), p.number("r")}; }

Shape rhc(Parameters& p) { return Rhc{p.vec3("V"), p.vec3("H"), p.vec3("B"), p.number("r"), p.number("c")}; }

Shape eto(Parameters& p) { return Eto{p.vec3("V"), p.vec3("N"), p.vec3("C"), p.number("r"), p.number("r_d")}; }

Shape hyp(Parameters& p) { return Hyp{p.vec3("V"), p.vec3("H"), p.vec3("A"), p.number("b"), p.number("bnr")}; }

Shape superell(Parameters& p) {
    return Superell{p.vec3("V"), p.vec3("A"), p.vec3("B"), p.vec3("C"), p.number("n"), p.number("e")};
}

Shape hrt(Parameters& p) { return Hrt{p.vec3("V"), p.vec3("X"), p.vec3("Y"), p.vec3("Z"), p.number("d")}; }

Shape cline(Parameters& p) { return Cline{p.vec3("V"), p.vec3("H"), p.number("R"), p.number("T")}; }

template <auto read>
BrlcadItem item(Parameters& p) {
    return {read(p)};
}

struct Reader {
    std::string_view type;
    BrlcadItem (*read)(Parameters&);
};
constexpr Reader readers[] = {
    {"ell", item<ell>},
    {"sph", item<ell>},
    {"tgc", item<tgc>},
    {"rec", item<tgc>},
    {"tor", item<tor>},
    {"arb8", item<arb8>},
    {"arbn", item<arbn>},
    {"half", item<half>},
    {"ehy", item<ehy>},
    {"part", item<part>},
    {"epa", item<epa>},
    {"rpc", item<rpc>},
    {"rhc", item<rhc>},
    {"eto", item<eto>},
    {"hyp", item<hyp>},
    {"superell", item<superell>},
    {"hrt", item<hrt>},
    {"metaball", item<read_v5_metaball>},
    {"pipe", item<read_v5_pipe>},
    {"cline", item<cline>},
    {"bot", item<read_v5_bot>},
    {"ars", item<read_v5_ars>},
    {"nmg", item<read_v5_nmg>},
    {"ebm", read_v5_ebm},
    {"vol", read_v5_vol},
    {"dsp", read_v5_dsp},
    {"extrude", item<read_v5_extrude>},
    {"revolve", item<read_v5_revolve>},
    {"sketch", item<read_v5_sketch>},
    {"binunif", item<read_v5_numbers>},
    {"pnts", item<read_v5_points>},
};

}  // namespace

BrlcadItem read_v5_object(const TclWord& type, std::span<const TclWord> keys_and_values, TclStore& store) {
    for (const Reader& reader : readers) {
        if (type.text != reader.type) continue;
        Parameters parameters(type, keys_and_values, store, type.text == "nmg" ? "F" : "");
        BrlcadItem item = reader.read(parameters);
        parameters.end();
        return item;
    }
    if (is_brlcad_nothing(type.text)) return {BrlcadNothing{std::string(type.text)}};
    return {Shape(Unsupported{std::string(type.text)})};
}

}  // namespace csgrt
