// Meshes: solids of binary databases that are made of many points.
//
//     bot       vertices, faces: counts  orientation, mode, flags: bytes  points  corners of faces
//               plates: thicknesses, a text with a bit for each face   normals, if the flags say so
//     ars       curves, points of each: counts  points
//     pipe      points: count  for each: point, inner, outer diameter, bend's radius
//     metaball  points: count  method  threshold  for each: point, strength, softness
#include "formats/brlcad/codes.hpp"
#include "formats/brlcad/g/solids.hpp"
#include "formats/brlcad/nmg.hpp"

namespace csgrt {

namespace {

constexpr std::size_t point_size = 3 * real_size;
constexpr std::uint8_t has_normals = 0x01, has_texture = 0x08;

int choice(ByteReader& b, int last, const char* what) {
    const std::size_t at = b.offset();
    const int value = b.byte(what);
    if (value < 1 || value > last) {
        throw Fault{at, std::string(what) + " is " + std::to_string(value) + ", not 1 to " + std::to_string(last), {}};
    }
    return value;
}

/// Checks, before memory is reserved, that the rest of the bytes can hold `count` items of `size` bytes each.
void expect(const ByteReader& b, std::uint64_t count, std::size_t size, const char* what) {
    if (count > b.left() / size) {
        throw Fault{b.offset(),
                    std::string(what) + ": " + std::to_string(count) + " of " + std::to_string(size) +
                        " bytes each do not fit into the " + std::to_string(b.left()) + " bytes that are left",
                    {}};
    }
}

std::vector<Vec3> points(ByteReader& b, std::uint64_t count, const char* what) {
    expect(b, count, point_size, what);
    std::vector<Vec3> out(static_cast<std::size_t>(count));
    for (Vec3& point : out) point = b.vec3(what);
    return out;
}

std::vector<std::array<std::uint32_t, 3>> triangles(ByteReader& b, std::uint32_t count, std::size_t end,
                                                    const char* what) {
    expect(b, count, 3 * word_size, what);
    std::vector<std::array<std::uint32_t, 3>> out(count);
    for (auto& triangle : out) {
        for (std::uint32_t& corner : triangle) corner = b.index(end, what);
    }
    return out;
}

}  // namespace

Shape read_g_bot(ByteReader& b) {
    Bot bot;
    const std::uint32_t vertices = b.count(point_size, "the number of vertices");
    const std::uint32_t faces = b.count(3 * word_size, "the number of faces");
    bot.orientation = static_cast<Bot::Orientation>(choice(b, 3, "the bot's orientation") - 1);
    bot.mode = static_cast<Bot::Mode>(choice(b, 4, "the bot's mode") - 1);
    const std::uint8_t flags = b.byte("the bot's flags");
    bot.vertices = points(b, vertices, "a vertex");
    bot.faces = triangles(b, faces, vertices, "a face's corner");
    if (bot.mode == Bot::Mode::plate || bot.mode == Bot::Mode::plate_nocos) {
        expect(b, faces, real_size, "the thicknesses");
        bot.thickness.resize(faces);
        for (double& thickness : bot.thickness) thickness = b.real("a face's thickness");
        const std::size_t at = b.offset();
        bot.append = read_face_bits(b.text("the bits of the faces"), at, faces);
    }
    if ((flags & has_normals) != 0) {
        const std::uint32_t normals = b.count(point_size, "the number of normals");
        const std::uint32_t face_normals = b.count(3 * word_size, "the number of faces' normals");
        bot.normals = points(b, normals, "a normal");
        bot.face_normals = triangles(b, face_normals, normals, "a face's normal");
    }
    if ((flags & has_texture) != 0) b.take(b.left(), "places in a texture");  // they do not change the shape
    return bot;
}

Shape read_g_ars(ByteReader& b) {
    Ars ars;
    const std::size_t at = b.offset();
    const std::uint32_t curves = b.word("the number of curves");
    const std::uint32_t length = b.word("the number of points of a curve");
    if (curves == 0 || length == 0) throw Fault{at, "the ars has no points", {}};
    expect(b, std::uint64_t{curves} * length, point_size, "the points of the ars");
    for (std::uint32_t i = 0; i < curves; ++i) ars.curves.push_back(points(b, length, "a point of a curve"));
    return ars;
}

Shape read_g_nmg(ByteReader& b) {
    const std::size_t at = b.offset();
    if (const std::uint32_t version = b.word("the version of the nmg"); version != 1) {
        throw Fault{at, "the nmg is of version " + std::to_string(version) + ", not 1", {}};
    }
    NmgCounts counts;
    for (std::uint32_t& count : counts) count = b.word("a count of the nmg's records");
    const std::size_t records_at = b.offset();
    return read_nmg(counts, b.take(b.left(), "the nmg's records"), records_at, 1);
}

Shape read_g_pipe(ByteReader& b) {
    Pipe pipe;
    pipe.points.resize(b.count(point_size + 3 * real_size, "the number of the pipe's points"));
    for (Pipe::Point& point : pipe.points) {
        point.position = b.vec3("a point of the pipe");
        point.inner = b.real("an inner diameter");
        point.outer = b.real("an outer diameter");
        point.bend = b.real("a bend's radius");
    }
    return pipe;
}

Shape read_g_metaball(ByteReader& b) {
    Metaball ball;
    const std::size_t count_at = b.offset();
    const std::uint32_t count = b.word("the number of the metaball's points");
    ball.method = static_cast<Metaball::Method>(b.index(3, "the metaball's method"));
    ball.threshold = b.real("the threshold");
    if (count > b.left() / (point_size + 2 * real_size)) {
        throw Fault{count_at,
                    "the metaball has " + std::to_string(count) + " points, too many for its " +
                        std::to_string(b.left()) + " bytes",
                    {}};
    }
    for (std::uint32_t i = 0; i < count; ++i) {
        Metaball::Point point;
        point.position = b.vec3("a point of the metaball");
        point.strength = b.real("a strength");
        point.softness = b.real("a softness");
        ball.points.push_back(point);
    }
    return ball;
}

}  // namespace csgrt
