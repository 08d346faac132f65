#include "formats/brlcad/v5/solids.hpp"

#include "formats/brlcad/described.hpp"
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

template <class S>
BrlcadItem described(Parameters& p) {
    return {Shape(read_described<S>([&](const char* key) { return p.vec3(key); },
                                    [&](const char* key) { return p.number(key); }))};
}

template <auto read>
BrlcadItem item(Parameters& p) {
    return {read(p)};
}

struct Reader {
    std::string_view type;
    BrlcadItem (*read)(Parameters&);
};
constexpr Reader readers[] = {
    {"ell", described<Ell>},
    {"sph", described<Ell>},
    {"tgc", described<Tgc>},
    {"rec", described<Tgc>},
    {"tor", described<Tor>},
    {"arb8", item<arb8>},
    {"arbn", item<arbn>},
    {"half", item<half>},
    {"ehy", described<Ehy>},
    {"part", described<Part>},
    {"epa", described<Epa>},
    {"rpc", described<Rpc>},
    {"rhc", described<Rhc>},
    {"eto", described<Eto>},
    {"hyp", described<Hyp>},
    {"superell", described<Superell>},
    {"hrt", described<Hrt>},
    {"metaball", item<read_v5_metaball>},
    {"pipe", item<read_v5_pipe>},
    {"cline", described<Cline>},
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
