// Meshes: solids of the newer text form that are made of many points.
#include "formats/brlcad/codes.hpp"
#include "formats/brlcad/v5/solids.hpp"
#include "formats/brlcad/values.hpp"

namespace csgrt {

namespace {

struct Word {
    std::string_view text;
    int value;
};
constexpr Word modes[] = {{"surf", 0},  {"surface", 0}, {"volume", 1},     {"solid", 1},
                          {"plate", 2}, {"nocos", 3},   {"plate_nocos", 3}};
constexpr Word orientations[] = {{"no", 0}, {"rh", 1}, {"lh", 2}};

template <std::size_t count>
int read_choice(const TclWord& word, const Word (&words)[count], const char* what, const char* suggestion) {
    for (const Word& known : words) {
        if (word.text == known.text) return known.value;
    }
    throw Fault{word.offset, quoted(word.text) + " is no " + what, suggestion};
}

}  // namespace

Shape read_v5_bot(Parameters& p) {
    Bot bot;
    bot.mode = static_cast<Bot::Mode>(
        read_choice(p.take("mode"), modes, "mode of a bot", "modes are surf, volume, plate and plate_nocos"));
    bot.orientation = static_cast<Bot::Orientation>(
        read_choice(p.take("orient"), orientations, "orientation of a bot", "orientations are no, rh and lh"));
    if (p.has("flags")) p.take("flags");
    bot.vertices = p.points("V");
    bot.faces = p.triangles("F", bot.vertices.size());
    const bool plate = bot.mode == Bot::Mode::plate || bot.mode == Bot::Mode::plate_nocos;
    if (plate || p.has("T")) {
        const std::size_t offset = p.place_of("T");
        bot.thickness = p.all_numbers("T");
        if (bot.thickness.size() != bot.faces.size()) {
            throw Fault{offset,
                        std::to_string(bot.thickness.size()) + " thicknesses for " + std::to_string(bot.faces.size()) +
                            " faces",
                        {}};
        }
    }
    if (plate) bot.append.resize(bot.faces.size());
    if (p.has("fm")) {
        const TclWord& bits = p.take("fm");
        bot.append = read_face_bits(bits.text, bits.offset, bot.faces.size());
    }
    if (!plate) {
        bot.thickness.clear();
        bot.append.clear();
    }
    if (p.has("N")) bot.normals = p.points("N");
    if (p.has("fn")) bot.face_normals = p.triangles("fn", bot.normals.size());
    return bot;
}

Shape read_v5_ars(Parameters& p) {
    Ars ars;
    const std::uint32_t curves = p.count("NC"), points = p.count("PPC");
    for (std::uint32_t i = 0; i < curves; ++i) {
        const std::string key = "C" + std::to_string(i);
        const std::size_t offset = p.place_of(key);
        ars.curves.push_back(p.points(key));
        if (ars.curves.back().size() != points) {
            throw Fault{
                offset,
                key + " has " + std::to_string(ars.curves.back().size()) + " points, not " + std::to_string(points),
                {}};
        }
    }
    return ars;
}

Shape read_v5_nmg(Parameters& p) {
    Nmg nmg;
    nmg.vertices = p.points("V");
    for (const TclWord* face : p.repeated()) {
        auto& loops = nmg.faces.emplace_back();
        TclList list(*face, p.store());
        for (TclWord loop; list.next(loop);) {
            loops.push_back(read_v5_indices(loop, nmg.vertices.size(), p.store()));
        }
    }
    return nmg;
}

Shape read_v5_pipe(Parameters& p) {
    Pipe pipe;
    for (std::size_t i = 0; i == 0 || p.has("V" + std::to_string(i)); ++i) {
        const std::string number = std::to_string(i);
        Pipe::Point point;
        point.position = p.vec3("V" + number);
        point.outer = p.number("O" + number);
        point.inner = p.number("I" + number);
        point.bend = p.number("R" + number);
        pipe.points.push_back(point);
    }
    return pipe;
}

Shape read_v5_metaball(Parameters& p) {
    Metaball ball;
    ball.method = static_cast<Metaball::Method>(p.integer("method", 0, 2));
    ball.threshold = p.number("thresh");
    for (const auto& point : p.rows<5>("PL")) {
        ball.points.push_back({{point[0], point[1], point[2]}, point[3], point[4]});
    }
    return ball;
}

}  // namespace csgrt
