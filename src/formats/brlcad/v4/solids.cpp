#include "formats/brlcad/v4/solids.hpp"

#include <cmath>
#include <cstdint>
#include <optional>
#include <span>

#include "formats/brlcad/described.hpp"
#include "formats/brlcad/struct_text.hpp"

namespace csgrt {

namespace {

using Parameters = std::array<double, 24>;

/// The part by which a torus's tube may be thicker than its circle and still count as equal, because v4 databases hold
/// floats.
constexpr double torus_rounding = 1e-6;

/// The most faces of an arbn, so that an absurd number is refused at once.
constexpr int max_faces = static_cast<int>(Limits::faces);

Vec3 vec3_at(const Parameters& p, std::size_t at) { return {p[at], p[at + 1], p[at + 2]}; }

/// The length of a vector. It is rounded as BRL-CAD's converter to .g files rounds it, so that both files give the same
/// scene.
double length(const Vec3& v) { return std::sqrt(v.x * v.x + v.y * v.y + v.z * v.z); }

/// Reads numbers in the order of the description.
template <class S>
Shape described(std::span<const double> numbers) {
    std::size_t at = 0;
    const auto number = [&](const char*) { return numbers[at++]; };
    const auto vector = [&](const char*) { return at += 3, Vec3{numbers[at - 3], numbers[at - 2], numbers[at - 1]}; };
    return read_described<S>(vector, number);
}

Shape torus(const Parameters& p) {
    const Vec3 h = vec3_at(p, 3);
    const double r_a = length(vec3_at(p, 6));
    double r_h = length(h);
    const double f = r_h > 0 ? 1 / r_h : 1;
    if (r_h > r_a && r_h <= r_a * (1 + torus_rounding)) r_h = r_a;
    return Tor{vec3_at(p, 0), {h.x * f, h.y * f, h.z * f}, r_a, r_h};
}

/// Reads an arb8. The first vertex is absolute, the others are relative to it.
Shape arb8(const Parameters& p) {
    Arb arb;
    arb.vertices[0] = vec3_at(p, 0);
    const Vec3& first = arb.vertices[0];
    for (std::size_t i = 1; i < 8; ++i) {
        const Vec3 v = vec3_at(p, 3 * i);
        arb.vertices[i] = {first.x + v.x, first.y + v.y, first.z + v.z};
    }
    return arb;
}

Shape shape_of(int number, const Parameters& p, const Field& type) {
    switch (number) {
        case 16:
            return torus(p);
        case 18:
            return described<Tgc>(p);
        case 19:
            return described<Ell>(p);
        case 20:
            return arb8(p);
        case 24:
            return Half{unit_plane(vec3_at(p, 0), p[3])};
        case 26:
            return described<Rpc>(p);
        case 27:
            return described<Rhc>(p);
        case 28:
            return described<Epa>(p);
        case 29:
            return described<Ehy>(p);
        case 30:
            return Eto{vec3_at(p, 0), vec3_at(p, 3), vec3_at(p, 6), p[9], p[10]};
        case 32:
            return described<Superell>(p);
        case 33:
            return described<Hyp>(p);
        default:
            throw Fault{type.offset, "no solid has type " + std::to_string(number),
                        "solids are 16 tor, 18 tgc, 19 ell, 20 arb8, 24 half and 26 to 33"};
    }
}

/// Reads `S type name comgeom-type` and 24 numbers, of which most solids use fewer.
BrlcadItem parameter_solid(Fields& fields, std::string& name) {
    const Field type = fields.next("the solid's type");
    const int number = read_integer(type.text, type.offset, 0, 127);
    name = fields.next("the solid's name").text;
    fields.integer("the COMGEOM type");
    const Parameters p = fields.numbers<24>("parameters");
    fields.end();
    constexpr int grip = 31;
    if (number == grip) return {BrlcadNothing{"grip"}};
    return {shape_of(number, p, type)};
}

/// Reads `n name count`, then a line `n x y z distance` for each plane. All lines are taken even if one is wrong.
Shape arbn(Fields& fields, LineReader& lines, std::string& name) {
    name = fields.next("the solid's name").text;
    const int count = fields.integer("the number of planes", 1, max_faces);
    fields.end();
    Arbn solid;
    std::optional<Fault> first_fault;
    for (int i = 0; i < count; ++i) {
        if (!lines.peek().text.starts_with("n ")) {
            throw Fault{lines.peek().offset,
                        "plane " + std::to_string(i + 1) + " of " + std::to_string(count) + " is missing",
                        {}};
        }
        Fields plane(lines.take());
        try {
            plane.next("the letter n");
            const auto p = plane.numbers<4>("coefficients of the plane");
            plane.end();
            solid.planes.push_back(unit_plane({p[0], p[1], p[2]}, p[3]));
        } catch (Fault& fault) {
            if (!first_fault) first_fault = std::move(fault);
        }
    }
    if (first_fault) throw *first_fault;
    return solid;
}

/// Takes `count` lines that start with one of `starts`; throws a Fault if there are fewer.
void take_lines(LineReader& lines, std::uint64_t count, std::string_view starts, const char* what) {
    for (std::uint64_t i = 0; i < count; ++i) {
        const Line line = lines.peek();
        if (lines.at_end() || line.text.empty() || starts.find(line.text[0]) == std::string_view::npos) {
            throw Fault{line.offset,
                        "the solid ends early: " + std::to_string(i) + " of " + std::to_string(count) + ' ' + what,
                        {}};
        }
        lines.take();
    }
}

Shape polysolid(LineReader& lines) {
    take_lines(lines, 1, "Q", "faces");
    while (lines.peek().text.starts_with('Q')) lines.take();
    return Unsupported{"poly"};
}

Shape spline(Fields& fields, LineReader& lines) {
    constexpr int max_mesh = 32'767;  // the count has 16 bits in a record
    const std::uint64_t surfaces = fields.count("the number of surfaces");
    for (std::uint64_t i = 0; i < surfaces; ++i) {
        const Line head = lines.peek();
        if (!head.text.starts_with('D')) throw Fault{head.offset, "a surface of the spline is missing", {}};
        Fields surface(lines.take());
        surface.next("the letter D");
        surface.integer("the order in u");
        surface.integer("the order in v");
        std::uint64_t numbers = surface.count("the number of knots in u");
        numbers += surface.count("the number of knots in v");
        const auto rows = static_cast<std::uint64_t>(surface.integer("the rows of the mesh", 0, max_mesh));
        const auto columns = static_cast<std::uint64_t>(surface.integer("the columns of the mesh", 0, max_mesh));
        numbers += rows * columns * static_cast<std::uint64_t>(surface.integer("the coordinates of a point", 0, 4));
        take_lines(lines, numbers, "+-.0123456789", "knots and coordinates");
    }
    return Unsupported{"bspline"};
}

/// Reads `s type name parameters`. The parameters are key=value; types that csgrt does not know may have any text.
BrlcadItem string_solid(Fields& fields, std::string& name) {
    const std::string type(fields.next("the solid's type").text);
    name = fields.next("the solid's name").text;
    const Field rest = fields.rest();
    if (type != "ebm" && type != "vol" && type != "dsp") return {Shape(Unsupported{type})};
    StructText parameters(rest.text, rest.offset);
    if (type == "ebm") return read_struct_ebm(parameters);
    return type == "vol" ? read_struct_vol(parameters) : read_struct_dsp(parameters);
}

template <class S>
Shape eight_numbers(Fields& fields) {
    const auto p = fields.numbers<8>("parameters");
    fields.end();
    return described<S>(p);
}

}  // namespace

bool is_v4_solid(char letter) { return std::string_view("SnstwpNPbAecd").find(letter) != std::string_view::npos; }

BrlcadItem read_v4_solid(const Line& line, LineReader& lines, std::string& name) {
    Fields fields(line);
    const char letter = fields.next("the record's letter").text[0];
    switch (letter) {
        case 'S':
            return parameter_solid(fields, name);
        case 'n':
            return {arbn(fields, lines, name)};
        case 's':
            return string_solid(fields, name);
        case 'A':
            return {read_v4_ars(fields, lines, name)};
        case 'N':
            return {read_v4_nmg(fields, lines, name)};
        default:
            break;
    }
    name = fields.next("the solid's name").text;
    switch (letter) {
        case 't':
            return {read_v4_bot(fields, lines)};
        case 'w':
            return {read_v4_pipe(fields, lines)};
        case 'p':
            return {eight_numbers<Part>(fields)};
        case 'c':
            return {eight_numbers<Cline>(fields)};
        case 'e':
            return {read_v4_extrude(fields)};
        case 'd':
            return {read_v4_sketch(fields, lines)};
        case 'b':
            return {spline(fields, lines)};
        default:
            return {polysolid(lines)};
    }
}

}  // namespace csgrt
