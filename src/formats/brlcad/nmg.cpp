// Nmg: records of 26 kinds, sorted by kind. A record is a row of 4-byte words, highest byte first; its first word is a
// magic number of four letters. Records refer to each other by their numbers, counted from 1 through all kinds. A
// list's head and each of its elements hold the number of the next element; -1 leads back to the head.
//
//     model -> regions -> shells -> faceuses -> loopuses -> edgeuses -> vertexuse -> vertex -> vertex_g, 3 doubles
//
// Each face has two uses, one for each side; the use with orientation 1 is outside. Each loop has two uses, too:
// orientation 1 is an outline, 2 a hole.
#include "formats/brlcad/nmg.hpp"

#include <bit>
#include <cmath>
#include <string>
#include <unordered_map>
#include <utility>

#include "formats/source.hpp"

namespace csgrt {

namespace {

struct Kind {
    std::size_t number, bytes;
    std::string_view magic;
};
constexpr Kind model{0, 16, "Nmod"}, region{1, 28, "Nreg"}, shell{3, 48, "Nshl"}, faceuse{5, 40, "Nfu "},
    loopuse{9, 40, "Nlu "}, edgeuse{12, 52, "Neu "}, vertexuse{16, 24, "Nvu "}, vertex{19, 16, "Nvrt"},
    vertex_g{20, 28, "Nv_g"};

/// Bytes of a record of each kind. 0: the size varies, or the kind does not exist.
constexpr std::array<std::size_t, 26> sizes = {16, 28, 52, 48, 52, 40, 24, 44, 52, 40, 12, 52, 52,
                                               12, 60, 36, 24, 28, 28, 16, 28, 0,  0,  0,  0,  0};
constexpr std::size_t curved_face = 8, curved_edge = 15;

constexpr std::uint32_t list_end = 0xffffffff;
constexpr std::uint32_t same = 1, opposite = 2;  // orientations

/// Positions of words in the records, counted from the magic number.
constexpr std::size_t next = 1, model_regions = 2, region_shells = 5, shell_faceuses = 5, orientation = 5,
                      face_loopuses = 8, loop_edgeuses = 8, edge_vertexuse = 11, use_vertex = 4, vertex_point = 3;

/// Follows the records of an nmg from the model to the vertices, and checks each reference.
class NmgReader {
public:
    NmgReader(const NmgCounts& counts, std::string_view bytes, std::size_t offset, std::size_t step)
        : counts_(counts), bytes_(bytes), offset_(offset), step_(step) {
        std::uint64_t first = 1, begin = 0;
        for (std::size_t kind = 0; kind < counts.size(); ++kind) {
            first_[kind] = first;
            begin_[kind] = begin;
            first += counts[kind];
            begin += std::uint64_t{counts[kind]} * sizes[kind];
        }
        if (begin > bytes.size()) {
            fail(0, "the nmg's records need " + std::to_string(begin) + " bytes, but only " +
                        std::to_string(bytes.size()) + " are there");
        }
    }

    Shape read() {
        if (counts_[curved_face] > 0 || counts_[curved_edge] > 0) {
            return Unsupported{"nmg", "it has curved faces"};
        }
        if (counts_[model.number] != 1) fail(0, "the nmg is not one model");
        // The elements of each list are counted, because a list with more elements than there are records would never
        // end.
        std::uint32_t regions = 0, shells = 0, faces = 0;
        for (auto r = link(model, 1, model_regions); r != list_end; r = step(region, r, regions)) {
            for (auto s = link(region, r, region_shells); s != list_end; s = step(shell, s, shells)) {
                for (auto f = link(shell, s, shell_faceuses); f != list_end; f = step(faceuse, f, faces)) {
                    if (link(faceuse, f, orientation) == same) read_face(f);
                }
            }
        }
        return std::move(nmg_);
    }

private:
    [[noreturn]] void fail(std::size_t at, std::string message) const {
        throw Fault{offset_ + step_ * at, std::move(message), {}};
    }

    /// The position of a record. A Fault if its number or its magic number belongs to another kind.
    std::size_t record(const Kind& kind, std::uint32_t number) const {
        const std::uint64_t first = first_[kind.number];
        if (number < first || number >= first + counts_[kind.number]) {
            fail(0, "record " + std::to_string(number) + " of the nmg is no " + std::string(kind.magic));
        }
        const auto at = static_cast<std::size_t>(begin_[kind.number] + (number - first) * kind.bytes);
        if (bytes_.substr(at, 4) != kind.magic) {
            fail(at, "record " + std::to_string(number) + " of the nmg does not start with " + std::string(kind.magic));
        }
        return at;
    }
    std::uint32_t word_at(std::size_t at) const {
        std::uint32_t value = 0;
        for (const char c : bytes_.substr(at, 4)) value = value << 8 | static_cast<std::uint8_t>(c);
        return value;
    }
    std::uint32_t link(const Kind& kind, std::uint32_t number, std::size_t word) const {
        return word_at(record(kind, number) + 4 * word);
    }
    /// The next element of a list; `seen` counts the elements of all lists of the kind.
    std::uint32_t step(const Kind& kind, std::uint32_t number, std::uint32_t& seen) const {
        if (++seen > counts_[kind.number]) {
            fail(record(kind, number), "a list of the nmg does not end, or stands in two others");
        }
        return link(kind, number, next);
    }
    bool is(const Kind& kind, std::uint32_t number) const {
        return number >= first_[kind.number] && number - first_[kind.number] < counts_[kind.number];
    }

    void read_face(std::uint32_t face) {
        std::vector<Nmg::Loop> outlines, holes;
        for (auto l = link(faceuse, face, face_loopuses); l != list_end; l = step(loopuse, l, loops_)) {
            const std::uint32_t first = link(loopuse, l, loop_edgeuses);
            if (is(vertexuse, first)) continue;  // a loop of one vertex encloses nothing
            Nmg::Loop loop;
            for (auto e = first; e != list_end; e = step(edgeuse, e, edges_)) {
                loop.push_back(read_vertex(link(edgeuse, e, edge_vertexuse)));
            }
            (link(loopuse, l, orientation) == opposite ? holes : outlines).push_back(std::move(loop));
        }
        outlines.insert(outlines.end(), std::make_move_iterator(holes.begin()), std::make_move_iterator(holes.end()));
        if (!outlines.empty()) nmg_.faces.push_back(std::move(outlines));
    }

    std::uint32_t read_vertex(std::uint32_t use) {
        const std::uint32_t number = link(vertexuse, use, use_vertex);
        const auto [known, is_new] = vertices_.try_emplace(number, static_cast<std::uint32_t>(nmg_.vertices.size()));
        if (is_new) nmg_.vertices.push_back(read_point(record(vertex_g, link(vertex, number, vertex_point)) + 4));
        return known->second;
    }

    Vec3 read_point(std::size_t at) const {
        double p[3];
        for (std::size_t i = 0; i < 3; ++i, at += 8) {
            p[i] = std::bit_cast<double>(std::uint64_t{word_at(at)} << 32 | word_at(at + 4));
            if (!std::isfinite(p[i])) fail(at, "a coordinate of the nmg is not a finite number");
        }
        return {p[0], p[1], p[2]};
    }

    const NmgCounts& counts_;
    std::string_view bytes_;
    std::size_t offset_, step_;
    std::array<std::uint64_t, 26> first_{}, begin_{};  ///< for each kind: its first record's number and position
    std::uint32_t loops_ = 0, edges_ = 0;              ///< seen so far
    std::unordered_map<std::uint32_t, std::uint32_t> vertices_;  ///< the solid's vertex for each vertex record
    Nmg nmg_;
};

}  // namespace

Shape read_nmg(const NmgCounts& counts, std::string_view bytes, std::size_t offset, std::size_t step) {
    return NmgReader(counts, bytes, offset, step).read();
}

}  // namespace csgrt
