// Meshes: solids of the older text form that are made of many points.
//
//     t name mode orientation 0 vertices faces   lines "n: x y z", lines "n: a b c", for plates with the thickness
//                                                behind and a last line with a bit for each face
//     w name                                     lines "inner outer bend x y z", END_PIPE
//     A type name curves points lines all-lines  lines "B type curve line" with 8 points each; but for the very first,
//                                                points stand relative to that
//     N version name granules                    a line of counts, lines of 32 bytes in hexadecimal
#include "formats/brlcad/codes.hpp"
#include "formats/brlcad/nmg.hpp"
#include "formats/brlcad/v4/solids.hpp"

namespace csgrt {

namespace {

/// Takes the next line, which must start with one of `starts`; otherwise a Fault says that `done` of `count` lines
/// exist.
Line next_line(LineReader& lines, std::uint64_t done, std::uint64_t count, std::string_view starts, const char* what) {
    const Line line = lines.peek();
    if (lines.at_end() || line.text.empty() || starts.find(line.text[0]) == std::string_view::npos) {
        throw Fault{line.offset,
                    "the solid ends early: " + std::to_string(done) + " of " + std::to_string(count) + ' ' + what,
                    {}};
    }
    return lines.take();
}

std::uint32_t index_field(Fields& fields, const char* what, std::size_t end) {
    const std::size_t at = fields.offset();
    const std::uint32_t index = fields.count(what);
    if (index >= end) {
        throw Fault{at,
                    "there is no number " + std::to_string(index) + ": there are only " + std::to_string(end) +
                        ", counted from 0",
                    {}};
    }
    return index;
}

Vec3 point(const std::array<double, 3>& p) { return {p[0], p[1], p[2]}; }

}  // namespace

Shape read_v4_bot(Fields& fields, LineReader& lines) {
    constexpr const char* what = "lines of vertices and faces";
    Bot bot;
    bot.mode = static_cast<Bot::Mode>(fields.integer("the mode", 1, 4) - 1);
    bot.orientation = static_cast<Bot::Orientation>(fields.integer("the orientation", 1, 3) - 1);
    fields.integer("the error mode");
    const std::uint64_t vertices = fields.count("the number of vertices");
    const std::uint64_t faces = fields.count("the number of faces");
    const bool plate = bot.mode == Bot::Mode::plate;
    const std::uint64_t all = vertices + faces + (plate ? 1 : 0);
    for (std::uint64_t i = 0; i < vertices; ++i) {
        Fields line(next_line(lines, i, all, "\t", what));
        line.next("the vertex's number");
        bot.vertices.push_back(point(line.numbers<3>("coordinates")));
        line.end();
    }
    for (std::uint64_t i = 0; i < faces; ++i) {
        Fields line(next_line(lines, vertices + i, all, "\t", what));
        line.next("the face's number");
        auto& face = bot.faces.emplace_back();
        for (std::uint32_t& corner : face) corner = index_field(line, "a corner of the face", bot.vertices.size());
        if (plate) bot.thickness.push_back(line.numbers<1>("thicknesses")[0]);
        line.end();
    }
    if (plate) {
        Fields line(next_line(lines, all - 1, all, "\t", what));
        bot.append.resize(bot.faces.size());
        if (line.more()) {
            const Field bits = line.next("the bits of the faces");
            bot.append = read_face_bits(bits.text, bits.offset, bot.faces.size());
        }
        line.end();
    }
    if (bot.mode == Bot::Mode::plate_nocos) {
        return Unsupported{"bot", "older databases do not hold the thickness of its faces"};
    }
    return bot;
}

Shape read_v4_pipe(Fields& fields, LineReader& lines) {
    const std::size_t start = fields.offset();
    Pipe pipe;
    while (!lines.at_end()) {
        const Line line = lines.take();
        if (line.text.starts_with("END_PIPE")) return pipe;
        Fields numbers(line);
        const auto p = numbers.numbers<6>("numbers of a point of the pipe");
        numbers.end();
        pipe.points.push_back({{p[3], p[4], p[5]}, p[1], p[0], p[2]});
    }
    throw Fault{start, "the pipe has no END_PIPE", {}};
}

Shape read_v4_ars(Fields& fields, LineReader& lines, std::string& name) {
    fields.integer("the solid's type");
    name = fields.next("the solid's name").text;
    const std::size_t counts_at = fields.offset();
    const std::uint64_t curves = fields.count("the number of curves");
    const std::uint64_t length = fields.count("the points of a curve");
    fields.integer("the records of a curve");
    const std::uint64_t records = fields.count("the number of records");
    constexpr std::uint64_t points_a_record = 8;
    const std::uint64_t needed = curves * ((length + points_a_record - 1) / points_a_record);
    if (records != needed) {
        throw Fault{counts_at,
                    std::to_string(curves) + " curves of " + std::to_string(length) + " points need " +
                        std::to_string(needed) + " records B, not " + std::to_string(records),
                    {}};
    }
    Ars ars;
    std::uint64_t record = 0;
    for (std::uint64_t i = 0; i < curves; ++i) {
        auto& curve = ars.curves.emplace_back();
        while (curve.size() < length) {
            Fields line(next_line(lines, record++, records, "B", "records B"));
            line.next("the letter B");
            for (const char* what : {"the type", "the curve", "the number of the record"}) line.integer(what);
            const auto p = line.numbers<24>("coordinates");
            line.end();
            for (std::size_t k = 0; k < p.size() && curve.size() < length; k += 3) {
                const bool is_first = i == 0 && curve.empty();
                const Vec3 base = is_first ? Vec3{} : ars.curves[0][0];
                curve.push_back({base.x + p[k], base.y + p[k + 1], base.z + p[k + 2]});
            }
        }
    }
    return ars;
}

Shape read_v4_nmg(Fields& fields, LineReader& lines, std::string& name) {
    const std::size_t start = fields.offset();
    if (const int version = fields.integer("the version"); version != 1) {
        throw Fault{start, "the nmg is of version " + std::to_string(version) + ", not 1", {}};
    }
    name = fields.next("the solid's name").text;
    constexpr std::uint64_t lines_a_granule = 4;
    const std::uint64_t granules = fields.count("the number of granules");
    Fields line(next_line(lines, 0, 1, " 0123456789", "lines of counts"));
    NmgCounts counts;
    for (std::uint32_t& count : counts) count = line.count("a count of the nmg's records");
    std::string bytes;
    for (std::uint64_t i = 0; i < lines_a_granule * granules; ++i) {
        const Line data = next_line(lines, i, lines_a_granule * granules, "0123456789abcdefABCDEF", "lines of data");
        Fields digits(data);
        const Field field = digits.next("data");
        bytes += read_hexadecimal(field.text, field.offset);
    }
    return read_nmg(counts, bytes, start, 0);
}

}  // namespace csgrt
