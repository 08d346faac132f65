#include "compile/solids/meshes/mesh_repair.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <optional>
#include <unordered_map>
#include <utility>

#include "compile/solids/meshes/near_lookup.hpp"
#include "scene/vector.hpp"

namespace csgrt {

namespace {

using Corners = std::array<std::uint32_t, 3>;

constexpr std::uint32_t none = CellTable::none;

std::string counted(std::size_t count, const char* one, const char* many) {
    return std::to_string(count) + " " + (count == 1 ? one : many);
}

/// A hash that is different for different keys (each step is invertible) and looks random.
std::uint64_t scrambled(std::uint64_t key) {
    key = (key ^ key >> 32) * 0xd6e8feb86659fd93u;
    key = (key ^ key >> 32) * 0xd6e8feb86659fd93u;
    return key ^ key >> 32;
}
std::uint64_t pair_of(std::uint32_t a, std::uint32_t b) { return std::uint64_t{a} << 32 | b; }

/// For each vertex the first vertex at the same point.
std::vector<std::uint32_t> first_at_point(const std::vector<Vec3>& vertices) {
    std::vector<std::uint32_t> first(vertices.size()), before(vertices.size(), none);
    CellTable table;
    for (std::uint32_t i = 0; i < vertices.size(); ++i) {
        const Vec3& v = vertices[i];
        std::uint64_t hash = 0;
        for (const double x : {v.x + 0.0, v.y + 0.0, v.z + 0.0}) {  // 0 and -0 are equal
            std::uint64_t bits;
            std::memcpy(&bits, &x, sizeof bits);
            hash = scrambled(hash ^ bits);
        }
        first[i] = i;
        const std::uint32_t known = table.find(hash);
        for (std::uint32_t j = known; j != none && first[i] == i; j = before[j])
            if (vertices[j] == v) first[i] = j;
        if (first[i] != i) continue;
        before[i] = known;
        table.exchange(hash, i);
    }
    return first;
}

/// Lists of numbers of faces or edges, one list an owner.
struct Lists {
    std::vector<std::uint32_t> first, all;

    /// Makes the lists. `each(add)` calls add(owner, member) for all members; it is called twice.
    template <class Each>
    Lists(std::size_t owners, const Each& each) : first(owners + 1, 0) {
        each([&](std::uint32_t owner, std::uint32_t) { ++first[owner + 1]; });
        for (std::size_t i = 0; i < owners; ++i) first[i + 1] += first[i];
        all.resize(first.back());
        std::vector<std::uint32_t> next(first.begin(), first.end() - 1);
        each([&](std::uint32_t owner, std::uint32_t member) { all[next[owner]++] = member; });
    }
    auto begin_of(std::uint32_t owner) const { return all.begin() + first[owner]; }
    auto end_of(std::uint32_t owner) const { return all.begin() + first[owner + 1]; }
};

/// The edges of faces, each once, between two points.
struct Edges {
    struct Edge {
        std::uint32_t low, high;
        std::uint32_t faces = 0;
        std::int32_t sense = 0;  ///< faces that run through the edge from low to high, minus faces from high to low
    };
    std::vector<Edge> all;
    std::vector<Corners> of_face;  ///< edge k begins at corner k
    std::size_t open = 0, crowded = 0;
    bool winds_one_way = true;  ///< through each edge that is not open, equally many faces run in either direction

    explicit Edges(const std::vector<Corners>& faces) {
        CellTable table;
        all.reserve(faces.size() * 3 / 2 + 3);
        of_face.reserve(faces.size());
        for (const Corners& face : faces) {
            Corners& own = of_face.emplace_back();
            for (std::size_t k = 0; k < 3; ++k) {
                const std::uint32_t from = face[k], to = face[(k + 1) % 3];
                const auto [low, high] = std::minmax(from, to);
                const std::uint64_t hash = scrambled(pair_of(low, high));
                own[k] = table.find(hash);
                if (own[k] == none) {
                    own[k] = static_cast<std::uint32_t>(all.size());
                    all.push_back({low, high});
                    table.exchange(hash, own[k]);
                }
                ++all[own[k]].faces;
                all[own[k]].sense += from == low ? 1 : -1;
            }
        }
        for (const Edge& edge : all) {
            open += edge.faces % 2;
            crowded += edge.faces > 2;
            winds_one_way = winds_one_way && (edge.faces % 2 != 0 || edge.sense == 0);
        }
    }
};

/// Numbers faces by their points, whatever their winding.
class FaceNumbers {
public:
    /// The number of a face, which is the next number if the face is new. The face's points must differ.
    std::uint32_t operator()(const Corners& face) {
        // An edge has a number, and with the third point the face has one.
        Corners sorted = face;
        std::sort(sorted.begin(), sorted.end());
        const std::uint32_t edge = number(edges_, edge_count_, pair_of(sorted[0], sorted[1]));
        return number(faces_, face_count_, pair_of(edge, sorted[2]));
    }

private:
    static std::uint32_t number(CellTable& table, std::uint32_t& count, std::uint64_t key) {
        const std::uint64_t hash = scrambled(key);
        const std::uint32_t known = table.find(hash);
        if (known != none) return known;
        table.exchange(hash, count);
        return count++;
    }

    CellTable edges_, faces_;
    std::uint32_t edge_count_ = 0, face_count_ = 0;
};

/// Rules for faces that are given several times.
enum class Copies {
    count_once,
    vanish_as_walls,   ///< a face does not count if its edges have an even number of faces without it
    vanish_as_sheets,  ///< and a face that is given with its two sides does not count if no edge needs it
};

/// The numbers of faults of each kind, for the notes.
struct Counts {
    std::size_t repeated = 0, walls = 0, flat = 0, split = 0, turned = 0, not_looked_at = 0;
};

/// The repair of a bot's faces, which aims at a closed surface.
class MeshRepair {
public:
    explicit MeshRepair(const Bot& bot);

    RepairedMesh volume();
    RepairedMesh plates();

private:
    Corners points_of(std::uint32_t face) const {
        const Corners& given = bot_.faces[face];
        return {point_[given[0]], point_[given[1]], point_[given[2]]};
    }
    bool is_flat(const Corners& face) const;
    void take_faces();
    void choose(Copies rule);
    std::vector<std::vector<std::uint32_t>> points_on(const std::vector<Edges::Edge>& edges);
    bool split(const Edges& edges);
    Edges joined();
    RepairedMesh surface(const Edges& edges);
    std::size_t turn_over(const Edges& edges, bool apply);
    bool winds_outward() const;
    std::vector<std::string> common_notes() const;
    RepairedMesh finish(std::vector<std::string> notes) const;

    const Bot& bot_;
    std::vector<std::uint32_t> point_;  ///< of each vertex
    double reach_ = 0, size_ = 0;
    std::vector<Corners> faces_;       ///< points
    std::vector<std::uint32_t> from_;  ///< as in RepairedMesh
    /// One entry a face, while faces are chosen: how often the face is given, how often with the opposite winding, and
    /// whether it may be left out.
    std::vector<std::uint32_t> copies_, turned_copies_;
    std::vector<bool> optional_;
    bool any_optional_ = false;
    bool has_gaps_ = false;  ///< edges were open before faces were cut
    Counts counts_;
};

MeshRepair::MeshRepair(const Bot& bot) : bot_(bot), point_(first_at_point(bot.vertices)) {
    Vec3 low = bot.vertices[bot.faces[0][0]], high = low;
    for (const Corners& face : bot.faces)
        for (const std::uint32_t corner : face) {
            const Vec3& v = bot.vertices[corner];
            low = {std::min(low.x, v.x), std::min(low.y, v.y), std::min(low.z, v.z)};
            high = {std::max(high.x, v.x), std::max(high.y, v.y), std::max(high.z, v.z)};
            reach_ = std::max({reach_, std::abs(v.x), std::abs(v.y), std::abs(v.z)});
        }
    size_ = length(high - low);
}

/// Is the face without area, as far as the rounding of its vertices tells?
bool MeshRepair::is_flat(const Corners& face) const {
    const Vec3 &a = bot_.vertices[face[0]], &b = bot_.vertices[face[1]], &c = bot_.vertices[face[2]];
    const Vec3 u = b - a, v = c - a, w = c - b, n = cross(u, v);
    const double longest = std::max({dot(u, u), dot(v, v), dot(w, w)});
    const double least = 8 * std::numeric_limits<double>::epsilon() * reach_;
    return dot(n, n) <= least * least * longest;
}

bool even_turn(const Corners& a, const Corners& b) {
    return (a[0] == b[0] && a[1] == b[1]) || (a[0] == b[1] && a[1] == b[2]) || (a[0] == b[2] && a[1] == b[0]);
}

bool has_two_equal(const Corners& face) { return face[0] == face[1] || face[1] == face[2] || face[2] == face[0]; }

/// Takes each face once, except faces with two equal points.
void MeshRepair::take_faces() {
    FaceNumbers number_of;
    faces_.reserve(bot_.faces.size());
    from_.reserve(bot_.faces.size());
    copies_.reserve(bot_.faces.size());
    turned_copies_.reserve(bot_.faces.size());
    for (std::uint32_t i = 0; i < bot_.faces.size(); ++i) {
        const Corners face = points_of(i);
        if (has_two_equal(face)) {
            ++counts_.flat;
            continue;
        }
        const std::uint32_t number = number_of(face);
        if (number == faces_.size()) {
            faces_.push_back(face);
            from_.push_back(i);
            copies_.push_back(0);
            turned_copies_.push_back(0);
            optional_.push_back(is_flat(face));
            any_optional_ = any_optional_ || optional_.back();
        }
        if (++copies_[number] > 1) optional_[number] = any_optional_ = true;
        if (!even_turn(faces_[number], face)) ++turned_copies_[number];
    }
}

/// Decides which of the optional faces count, so that edges have an even number of faces. An edge with one undecided
/// face decides this face. An edge that has only one face in all decides nothing.
void MeshRepair::choose(Copies rule) {
    if (!any_optional_) return;
    const Edges edges(faces_);
    enum : std::uint8_t { unknown, out, in };
    std::vector<std::uint8_t> state(faces_.size(), in);
    for (std::uint32_t f = 0; f < faces_.size(); ++f)
        if (optional_[f] && (rule != Copies::count_once || is_flat(faces_[f]))) state[f] = unknown;
    const Lists at(edges.all.size(), [&](const auto& add) {
        for (std::uint32_t f = 0; f < faces_.size(); ++f)
            if (state[f] == unknown)
                for (const std::uint32_t e : edges.of_face[f]) add(e, f);
    });
    std::vector<std::uint32_t> open(edges.all.size()), sum(edges.all.size()), queue;
    for (std::uint32_t e = 0; e < edges.all.size(); ++e) {
        open[e] = at.first[e + 1] - at.first[e];
        sum[e] = edges.all[e].faces - open[e];
        if (open[e] == 1 && edges.all[e].faces > 1) queue.push_back(e);
    }
    const auto decide = [&](std::uint32_t f, bool counts) {
        state[f] = counts ? in : out;
        for (const std::uint32_t e : edges.of_face[f]) {
            sum[e] += counts;
            if (--open[e] == 1 && edges.all[e].faces > 1) queue.push_back(e);
        }
    };
    const auto settle = [&] {
        while (!queue.empty()) {
            const std::uint32_t e = queue.back();
            queue.pop_back();
            for (auto f = at.begin_of(e); f != at.end_of(e); ++f)
                if (state[*f] == unknown) decide(*f, sum[e] % 2 == 1);
        }
    };
    settle();
    // Faces that no edge decides: copies of one face count once, and a face without an area does not count.
    const auto is_sheet = [&](std::uint32_t f) {
        return 2 * turned_copies_[f] == copies_[f] &&
               std::any_of(edges.of_face[f].begin(), edges.of_face[f].end(),
                           [&](std::uint32_t e) { return edges.all[e].faces == 1; });
    };
    for (const bool flat : {false, true})
        for (std::uint32_t f = 0; f < faces_.size(); ++f) {
            if (state[f] != unknown || is_flat(faces_[f]) != flat) continue;
            decide(f, !flat && !(rule == Copies::vanish_as_sheets && is_sheet(f)));
            settle();
        }

    std::size_t kept = 0;
    for (std::uint32_t f = 0; f < faces_.size(); ++f) {
        if (optional_[f]) {
            if (is_flat(faces_[f])) {
                counts_.flat += copies_[f];
            } else if (state[f] == out) {
                counts_.walls += copies_[f];
            } else {
                counts_.repeated += copies_[f] - 1;
            }
        }
        if (state[f] == out) continue;
        faces_[kept] = faces_[f];
        from_[kept++] = from_[f];
    }
    faces_.resize(kept);
    from_.resize(kept);
}

/// Lists for each edge the ends of other edges that lie on it, from low to high. The search stops early where many
/// edges lie on one another with the same points: the time would grow as the square of their number.
std::vector<std::vector<std::uint32_t>> MeshRepair::points_on(const std::vector<Edges::Edge>& edges) {
    // The distance that rounding to single precision makes.
    const double near = std::min(0x1p-23 * reach_, 1e-6 * size_);
    const std::vector<Vec3>& v = bot_.vertices;
    std::vector<std::uint32_t> ends;
    for (const Edges::Edge& edge : edges) ends.insert(ends.end(), {edge.low, edge.high});
    std::sort(ends.begin(), ends.end());
    ends.erase(std::unique(ends.begin(), ends.end()), ends.end());

    // The cell's size: so small that a surface has about one end in each cell, and not smaller than the search
    // distance.
    const double side =
        std::max(size_ / std::clamp(std::sqrt(static_cast<double>(ends.size())), 1.0, 1024.0), 2 * near);
    const auto cell = [&](double x) { return static_cast<std::int64_t>(std::floor(x / side)); };
    std::vector<std::pair<std::uint64_t, std::uint32_t>> cells;
    for (const std::uint32_t p : ends) cells.emplace_back(cell_hash({cell(v[p].x), cell(v[p].y), cell(v[p].z)}), p);
    std::sort(cells.begin(), cells.end());

    std::vector<std::vector<std::uint32_t>> found(edges.size());
    std::vector<std::pair<double, std::uint32_t>> on;
    const std::size_t most_tests = 10'000'000 + 100 * edges.size();
    std::size_t tests = 0;
    for (std::size_t i = 0; i < edges.size(); ++i) {
        counts_.not_looked_at = tests > most_tests ? edges.size() - i : 0;
        if (counts_.not_looked_at > 0) break;
        const Vec3 &a = v[edges[i].low], &b = v[edges[i].high], ab = b - a;
        const double whole = length(ab);
        on.clear();
        const auto try_point = [&](std::uint32_t p) {
            ++tests;
            if (p == edges[i].low || p == edges[i].high) return;
            const Vec3 ap = v[p] - a;
            const double along = dot(ap, ab) / whole;
            if (!(along > near && along < whole - near) || !(length(cross(ap, ab)) <= near * whole)) return;
            on.emplace_back(along, p);
        };
        // Searches the cells that the edge touches, along its main axis.
        const std::array<double, 3> from{a.x, a.y, a.z}, way{ab.x, ab.y, ab.z};
        std::size_t axis = 0;
        for (std::size_t k = 1; k < 3; ++k)
            if (std::abs(way[k]) > std::abs(way[axis])) axis = k;
        const std::size_t second = (axis + 1) % 3, third = (axis + 2) % 3;
        const double low = std::min(from[axis], from[axis] + way[axis]) - near;
        const double high = std::max(from[axis], from[axis] + way[axis]) + near;
        for (std::int64_t c = cell(low); c <= cell(high); ++c) {
            const auto range = [&](std::size_t k) {
                double least = std::numeric_limits<double>::infinity(), most = -least;
                for (const double x : {std::clamp(static_cast<double>(c) * side, low, high),
                                       std::clamp(static_cast<double>(c + 1) * side, low, high)}) {
                    const double at = from[k] + way[k] * std::clamp((x - from[axis]) / way[axis], 0.0, 1.0);
                    least = std::min(least, at);
                    most = std::max(most, at);
                }
                return std::pair(cell(least - 2 * near), cell(most + 2 * near));
            };
            const auto [second_first, second_last] = range(second);
            const auto [third_first, third_last] = range(third);
            for (std::int64_t d = second_first; d <= second_last; ++d)
                for (std::int64_t e = third_first; e <= third_last; ++e) {
                    std::array<std::int64_t, 3> at{};
                    at[axis] = c, at[second] = d, at[third] = e;
                    const std::uint64_t hash = cell_hash(at);
                    for (auto entry = std::lower_bound(cells.begin(), cells.end(), std::pair(hash, std::uint32_t{0}));
                         entry != cells.end() && entry->first == hash; ++entry)
                        try_point(entry->second);
                }
        }
        std::sort(on.begin(), on.end());
        for (const auto& [along, p] : on)
            if (found[i].empty() || found[i].back() != p) found[i].push_back(p);
    }
    return found;
}

/// Cuts of a face: the points in the middle of each of its edges, from corner to corner.
using Cuts = std::array<std::vector<std::uint32_t>, 3>;
void cut(Corners face, Cuts on, std::vector<Corners>& parts) {
    while (on[0].empty()) {
        std::rotate(face.begin(), face.begin() + 1, face.end());
        std::rotate(on.begin(), on.begin() + 1, on.end());
    }
    // A fan from the third corner to the first edge; its two outer triangles are cut at the points of the other edges.
    const auto fan = [&parts](std::uint32_t tip, std::uint32_t from, const std::vector<std::uint32_t>& by,
                              std::uint32_t to) {
        for (const std::uint32_t p : by) parts.push_back({tip, std::exchange(from, p), p});
        parts.push_back({tip, from, to});
    };
    fan(on[0].front(), face[2], on[2], face[0]);
    for (std::size_t i = 1; i < on[0].size(); ++i) parts.push_back({face[2], on[0][i - 1], on[0][i]});
    fan(on[0].back(), face[1], on[1], face[2]);
}

/// Cuts faces at the points on their open edges, where this leaves no part of an edge open.
bool MeshRepair::split(const Edges& edges) {
    std::vector<Edges::Edge> open;
    std::vector<std::uint32_t> number(edges.all.size(), none);
    for (std::uint32_t e = 0; e < edges.all.size(); ++e) {
        if (edges.all[e].faces % 2 == 0) continue;
        number[e] = static_cast<std::uint32_t>(open.size());
        open.push_back(edges.all[e]);
    }
    std::vector<std::vector<std::uint32_t>> points = points_on(open);

    // An edge is split if all its parts are closed after all splits. An edge that is not split may leave other edges
    // open.
    for (bool changed = true; changed;) {
        std::unordered_map<std::uint64_t, bool> odd;
        const auto part_of = [&](std::uint32_t a, std::uint32_t b) -> bool& {
            return odd[pair_of(std::min(a, b), std::max(a, b))];
        };
        const auto each_part = [&](std::size_t i, const auto& call) {
            std::uint32_t last = open[i].low;
            for (const std::uint32_t p : points[i]) call(part_of(std::exchange(last, p), p));
            call(part_of(last, open[i].high));
        };
        for (std::size_t i = 0; i < open.size(); ++i) each_part(i, [](bool& part) { part = !part; });
        changed = false;
        for (std::size_t i = 0; i < open.size(); ++i) {
            if (points[i].empty()) continue;
            bool closed = true;
            each_part(i, [&](bool part) { closed = closed && !part; });
            if (closed) continue;
            points[i].clear();
            changed = true;
        }
    }

    for (std::size_t f = 0, count = faces_.size(); f < count; ++f) {
        Cuts on;
        bool any = false;
        for (std::size_t k = 0; k < 3; ++k) {
            const std::uint32_t e = edges.of_face[f][k];
            if (number[e] == none) continue;
            on[k] = points[number[e]];
            if (faces_[f][k] != edges.all[e].low) std::reverse(on[k].begin(), on[k].end());
            any = any || !on[k].empty();
        }
        if (!any) continue;
        ++counts_.split;
        std::vector<Corners> parts;
        cut(faces_[f], std::move(on), parts);
        faces_[f] = parts[0];
        faces_.insert(faces_.end(), parts.begin() + 1, parts.end());
        from_.insert(from_.end(), parts.size() - 1, from_[f]);
    }
    return counts_.split > 0;
}

/// Counts the faces that wind against most of the faces to which they are joined by edges of two faces. `apply`: turns
/// these faces over.
std::size_t MeshRepair::turn_over(const Edges& edges, bool apply) {
    const Lists at(edges.all.size(), [&](const auto& add) {
        for (std::uint32_t f = 0; f < faces_.size(); ++f)
            for (const std::uint32_t e : edges.of_face[f])
                if (edges.all[e].faces == 2) add(e, f);
    });
    const auto runs_up = [&](std::uint32_t f, std::uint32_t e) {
        std::size_t k = 0;
        while (edges.of_face[f][k] != e) ++k;
        return faces_[f][k] == edges.all[e].low;
    };
    enum : std::uint8_t { unknown, kept, turned };
    std::vector<std::uint8_t> way(faces_.size(), unknown);
    std::vector<std::uint32_t> part;
    std::size_t all = 0;
    for (std::uint32_t first = 0; first < faces_.size(); ++first) {
        if (way[first] != unknown) continue;
        part.assign(1, first);
        way[first] = kept;
        std::size_t count = 0;
        for (std::size_t i = 0; i < part.size(); ++i) {
            const std::uint32_t f = part[i];
            count += way[f] == turned;
            for (const std::uint32_t e : edges.of_face[f])
                for (auto g = at.begin_of(e); g != at.end_of(e); ++g) {
                    if (way[*g] != unknown) continue;
                    way[*g] = (runs_up(f, e) == runs_up(*g, e)) == (way[f] == kept) ? turned : kept;
                    part.push_back(*g);
                }
        }
        const auto against = 2 * count > part.size() ? kept : turned;
        for (const std::uint32_t f : part) {
            if (way[f] != against) continue;
            ++all;
            if (apply) std::swap(faces_[f][1], faces_[f][2]);
        }
    }
    return all;
}

/// For a closed surface whose faces all wind one way: are they counterclockwise, seen from outside?
bool MeshRepair::winds_outward() const {
    const Vec3& middle = bot_.vertices[faces_[0][0]];
    double volume = 0;
    for (const Corners& face : faces_)
        volume += dot(bot_.vertices[face[0]] - middle,
                      cross(bot_.vertices[face[1]] - middle, bot_.vertices[face[2]] - middle));
    return volume > 0;
}

RepairedMesh MeshRepair::finish(std::vector<std::string> notes) const {
    const bool as_given = counts_.turned == 0 && counts_.split == 0 && faces_.size() == bot_.faces.size();
    return {{bot_.vertices, as_given ? bot_.faces : faces_}, from_, true, false, std::move(notes)};
}

/// Makes the edges, after faces are cut where this closes some edges.
Edges MeshRepair::joined() {
    Edges edges(faces_);
    has_gaps_ = edges.open > 0;
    if (has_gaps_ && split(edges)) edges = Edges(faces_);
    return edges;
}

RepairedMesh MeshRepair::volume() {
    take_faces();
    if (!any_optional_) return surface(joined());
    // The best rule is the first that leaves the fewest edges open.
    std::optional<MeshRepair> best;
    std::optional<Edges> best_edges;
    for (const Copies rule : {Copies::count_once, Copies::vanish_as_walls, Copies::vanish_as_sheets}) {
        MeshRepair next = *this;
        next.choose(rule);
        Edges edges = next.joined();
        if (best && edges.open >= best_edges->open) continue;
        best.emplace(std::move(next));
        best_edges.emplace(std::move(edges));
        if (best_edges->open == 0) break;
    }
    return best->surface(*best_edges);
}

RepairedMesh MeshRepair::surface(const Edges& edges) {
    const bool is_closed = edges.open == 0, is_oriented = bot_.orientation != Bot::Orientation::unoriented;
    const std::size_t against = edges.winds_one_way ? 0 : turn_over(edges, is_oriented && !is_closed);
    if (is_oriented && !is_closed) counts_.turned = against;

    std::vector<std::string> notes = common_notes();
    if (counts_.split > 0)
        notes.push_back(counted(counts_.split, "face is", "faces are") +
                        " cut at vertices in the middle of their edges");
    if (counts_.not_looked_at > 0)
        notes.push_back(counted(counts_.not_looked_at, "edge was", "edges were") +
                        " not cut at the vertices in the middle: too many of them lie on one another");
    if (against > 0)
        notes.push_back(counted(against, "face winds", "faces wind") + " against the others" +
                        (is_closed     ? "; what is inside is told by parity"
                         : is_oriented ? against == 1 ? " and counts turned over" : " and count turned over"
                                       : ""));
    const bool lies = is_closed && is_oriented && edges.winds_one_way && !faces_.empty() &&
                      winds_outward() != (bot_.orientation == Bot::Orientation::counterclockwise);
    if (lies)
        notes.push_back(std::string("its faces wind the other way than its orientation says; ") +
                        (has_gaps_ ? "with the vertices in the middle of edges, it is taken at its word"
                                   : "what is inside is told by parity"));
    if (!is_closed)
        notes.push_back(
            counted(edges.open, "edge is", "edges are") + " open; where a ray comes through a gap, " +
            (is_oriented ? "a way in and the next way out are a pair" : "crossings are paired from the first on"));
    if (edges.crowded > 0)
        notes.push_back(counted(edges.crowded, "edge has", "edges have") +
                        " more than two faces; what is inside is told by parity");
    RepairedMesh repaired = finish(std::move(notes));
    repaired.is_closed = is_closed;
    repaired.decided_by_facing = is_oriented && has_gaps_ && (!is_closed || lies);
    return repaired;
}

RepairedMesh MeshRepair::plates() {
    FaceNumbers number_of;
    std::vector<std::uint32_t> last,
        before;  // kept faces: for each number the last face, and for each face the previous one
    const auto same_plate = [&](std::uint32_t a, std::uint32_t b) {
        if (bot_.mode == Bot::Mode::surface) return true;
        return bot_.thickness[a] == bot_.thickness[b] && (bot_.append.empty() || bot_.append[a] == bot_.append[b]);
    };
    for (std::uint32_t i = 0; i < bot_.faces.size(); ++i) {
        const Corners face = points_of(i);
        if (has_two_equal(face)) {
            ++counts_.flat;
            continue;
        }
        const std::uint32_t number = number_of(face);
        if (number == last.size()) last.push_back(none);
        std::uint32_t known = last[number];
        while (known != none && !same_plate(from_[known], i)) known = before[known];
        if (known != none) {
            ++counts_.repeated;
            continue;
        }
        before.push_back(std::exchange(last[number], static_cast<std::uint32_t>(faces_.size())));
        faces_.push_back(face);
        from_.push_back(i);
    }
    return finish(common_notes());
}

/// Notes on faces that do not count, in any mode.
std::vector<std::string> MeshRepair::common_notes() const {
    std::vector<std::string> notes;
    if (counts_.repeated > 0)
        notes.push_back(
            counted(counts_.repeated, "face that was given before does", "faces that were given before do") +
            " not count again");
    if (counts_.walls > 0)
        notes.push_back(counted(counts_.walls, "face", "faces") +
                        " between parts of it count for nothing: they are inside");
    if (counts_.flat > 0)
        notes.push_back(counted(counts_.flat, "face has no area and counts", "faces have no area and count") +
                        " for nothing");
    return notes;
}

}  // namespace

RepairedMesh repair(const Bot& bot) {
    MeshRepair mesh_repair(bot);
    return bot.mode == Bot::Mode::volume ? mesh_repair.volume() : mesh_repair.plates();
}

}  // namespace csgrt
