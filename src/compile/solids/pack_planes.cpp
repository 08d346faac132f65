// Pack planes: packs the planes of all solids. Several threads find the equal planes (shards.hpp).
#include <algorithm>
#include <cmath>
#include <optional>
#include <span>
#include <unordered_map>
#include <unordered_set>
#include <utility>

#include "compile/linear.hpp"
#include "compile/pack_chunks.hpp"
#include "compile/solids/pack.hpp"
#include "scene/range.hpp"

namespace csgrt {

namespace {

void insert_large(PackedChunk& chunk) {
    if (chunk.large_faces.empty()) return;
    std::vector<PackedPlane> all;
    auto small = chunk.planes.begin();
    auto large = chunk.large_faces.begin();
    for (std::uint32_t i = 0; i < chunk.parts.size(); ++i) {
        if (chunk.parts[i].is_large) {
            all.insert(all.end(), large->begin(), large->end());
            ++large;
        } else {
            const auto end = small + chunk.parts[i].faces + chunk.parts[i].cuts;
            all.insert(all.end(), small, end);
            small = end;
        }
    }
    chunk.planes = std::move(all);
}

/// Removes repeated faces of a polyhedron. Returns how many references are left.
std::size_t drop_repeated(std::uint32_t* refs, std::size_t count) {
    constexpr std::size_t few = 16;  // an arbn may have very many faces
    std::unordered_set<std::uint32_t> seen;
    std::size_t kept = 0;
    for (std::size_t i = 0; i < count; ++i) {
        const bool again =
            count > few ? !seen.insert(refs[i]).second : std::find(refs, refs + kept, refs[i]) != refs + kept;
        if (!again) refs[kept++] = refs[i];
    }
    return kept;
}

/// A solid without thickness: two of its faces lie in one plane and face away from each other, so nothing is left of
/// the solid.
struct FlatSolid {
    std::size_t solid;
    double thickness;
};

/// The distance of two such faces in the model's numbers; nullopt: there are no such faces.
std::optional<double> flat_thickness(std::span<const PackedPlane> faces) {
    const auto apart = [&](std::size_t i, std::size_t j) {
        const PlaneTable::Key &a = faces[i].key, &b = faces[j].key;
        return std::fabs(glm::dot(wide(a.one.normal), wide(b.one.normal)) < 0 ? a.offset + b.offset
                                                                              : a.offset - b.offset);
    };
    constexpr std::size_t few = 16;
    std::unordered_map<std::uint32_t, std::size_t> seen;
    for (std::size_t i = 0; i < faces.size(); ++i) {
        if (faces.size() > few) {
            seen.emplace(faces[i].ref, i);
            if (const auto other = seen.find(faces[i].ref ^ 1); other != seen.end()) return apart(i, other->second);
            continue;
        }
        for (std::size_t j = 0; j < i; ++j)
            if ((faces[i].ref ^ faces[j].ref) == 1) return apart(i, j);
    }
    return {};
}

/// Warns of the first few flat solids, and says how many more there are.
void note_flat_solids(const std::vector<std::vector<FlatSolid>>& flat_solids, const Box& common, const Shapes& shapes,
                      std::vector<Warning>& warnings) {
    const auto warn = [&](std::string object, std::string reason) {
        Warning& warning = warnings.emplace_back();
        warning.object = std::move(object);
        warning.reason = std::move(reason);
    };
    constexpr std::size_t shown = 5;
    std::size_t count = 0;
    for (const std::vector<FlatSolid>& some : flat_solids) {
        for (const auto& [solid, thickness] : some) {
            // note_on() warns of a revolve that turns by no angle.
            if (shapes.solids[solid].type == SOLID_REVOLVE && thickness == 0) continue;
            if (++count > shown) continue;
            const Box& box = is_finite(shapes.solid_boxes[solid]) ? shapes.solid_boxes[solid] : common;
            const double of_size = PlaneTable::gap * diagonal(box),
                         of_place = coordinate_rounding * largest_coordinate(box);
            const char* const what =
                of_size >= of_place ? "1e-10 of its size" : "what rounding may do to its coordinates";
            std::string reason = "nothing is left of it: two of its faces are " + rounded_text(thickness) +
                                 " mm apart, and faces within " + rounded_text(std::max(of_size, of_place)) + " mm, " +
                                 what + ", are one surface";
            warn(shapes.solid_info[solid].name, std::move(reason));
        }
    }
    if (count > shown) warn({}, "nothing is left of " + std::to_string(count - shown) + " more such solids");
}

/// Sorts the planes into shards.
Shards shards_of(std::vector<PackedChunk>& chunks, const PlaneTable& empty, const Box& common, const Shapes& shapes) {
    Shards shards(chunks.size());
    std::size_t planes = 0;
    for (const PackedChunk& chunk : chunks) planes += chunk.planes.size();
    for_each_chunk(chunks, [&](std::size_t number) {
        PackedChunk& chunk = chunks[number];
        shards.chunk(number).reserve(chunk.planes.size());
        auto plane = chunk.planes.begin();
        for (std::uint32_t i = 0; i < chunk.parts.size(); ++i) {
            const Box& box = shapes.solid_boxes[number * PackedChunk::size + i];
            for (const auto end = plane + chunk.parts[i].faces + chunk.parts[i].cuts; plane != end; ++plane) {
                plane->solid = static_cast<std::uint16_t>(i);
                empty.add_to(shards.chunk(number), plane->key, is_finite(box) ? box : common, planes);
            }
        }
    });
    shards.sort();
    return shards;
}

/// For each shard, the planes that are the first of their records.
using Firsts = std::vector<std::vector<Shards::Member>>;

/// Finds the equal planes. Sets `ref` to the reference in the shard's own table.
Firsts find_shared(std::vector<PackedChunk>& chunks, const Shards& shards, const PlaneTable& empty, const Box& common,
                   const Shapes& shapes) {
    Firsts firsts(Shards::count);
    shards.for_each(empty, [&](PlaneTable& table, std::span<const Shards::Member> members, std::size_t shard) {
        const auto plane_at = [&](std::size_t i) -> PackedPlane& {
            return chunks[members[i].chunk].planes[members[i].index];
        };
        const auto box_at = [&](std::size_t i) -> const Box& {
            return shapes.solid_boxes[members[i].chunk * PackedChunk::size + plane_at(i).solid];
        };
        table.reserve(members.size());
        for (std::size_t i = 0; i < members.size(); ++i) {
            // The entries lie far apart in memory: without prefetching the thread would wait for memory most of the
            // time.
            constexpr std::size_t soon = 6, later = 12;
            if (i + later < members.size()) prefetch_line(&plane_at(i + later));
            if (i + soon < members.size()) {
                prefetch_line(&box_at(i + soon));
                table.prefetch(plane_at(i + soon).key);
            }
            PackedPlane& plane = plane_at(i);
            const std::size_t before = table.size();
            plane.ref = table.add_keyed(plane.key, is_finite(box_at(i)) ? box_at(i) : common);
            plane.is_first = table.size() > before;
            if (plane.is_first) firsts[shard].push_back(members[i]);
        }
    });
    return firsts;
}

/// Writes the scene's records, in the order of the solids, and sets each `ref` to the reference in the scene's table.
void number_planes(std::vector<PackedChunk>& chunks, const Shards& shards, const Firsts& firsts, const Box& common,
                   Shapes& shapes, Shells& shells) {
    // The distance of a point beyond the plane, outward from the solid whose face the plane is.
    const auto beyond = [](const PlaneTable::Key& key, const Wide& point) {
        const long double out = glm::dot(wide(key.one.normal), point) - key.one.distance;
        return key.flipped ? -out : out;
    };
    std::vector<std::uint32_t> first_record(chunks.size());
    for_each_chunk(chunks, [&](std::size_t number) {
        for (const PackedPlane& plane : chunks[number].planes) first_record[number] += plane.is_first;
    });
    std::size_t records = 0;
    for (std::uint32_t& first : first_record) records += std::exchange(first, static_cast<std::uint32_t>(records));
    PlaneTable::check_count(records);
    resize_cleared(shapes.planes, records);
    for_each_chunk(chunks, [&](std::size_t number) {
        std::uint32_t next = first_record[number];
        for (PackedPlane& plane : chunks[number].planes) {
            if (!plane.is_first) continue;
            shapes.planes[next] = PlaneTable::record_of(plane.key);
            plane.ref = next++ << 1;
        }
    });
    shards.for_each([&](std::span<const Shards::Member> members, std::size_t shard) {
        for (const auto& [number, i] : members) {
            PackedPlane& plane = chunks[number].planes[i];
            if (plane.is_first) continue;
            const Shards::Member first = firsts[shard][plane.ref >> 1];
            if ((plane.ref & 1) == 0) {
                const PackedPlane& other = chunks[first.chunk].planes[first.index];
                const std::size_t solid = number * PackedChunk::size + plane.solid;
                const Box& box = is_finite(shapes.solid_boxes[solid]) ? shapes.solid_boxes[solid] : common;
                const Wide middle = 0.5L * (wide(box.low) + wide(box.high));
                shells.add(first.chunk * PackedChunk::size + other.solid, solid,
                           static_cast<double>(beyond(plane.key, middle) - beyond(other.key, middle)), box);
            }
            plane.ref = chunks[first.chunk].planes[first.index].ref | (plane.ref & 1);
        }
    });
}

/// Writes each solid's references after the words of the solids.
void write_references(const std::vector<PackedChunk>& chunks, const Box& common, Shapes& shapes,
                      std::vector<Warning>& warnings) {
    std::vector<std::vector<kernel::PlaneRef>> of(chunks.size());
    std::vector<std::vector<FlatSolid>> flat_solids(chunks.size());
    for_each_chunk(chunks, [&](std::size_t number) {
        std::vector<kernel::PlaneRef>& own = of[number];
        own.reserve(chunks[number].planes.size());
        auto plane = chunks[number].planes.begin();
        const auto append = [&](std::uint32_t count) {
            for (const auto end = plane + count; plane != end; ++plane) own.push_back(plane->ref);
        };
        for (std::size_t i = 0; i < chunks[number].parts.size(); ++i) {
            const PackedChunk::Part& part = chunks[number].parts[i];
            const std::size_t first = own.size();
            // A wall's plane has an inner side only in a polyhedron: two walls of a concave outline that face away from
            // each other may lie in one plane. The caps always have an inner side.
            const bool is_extrude = shapes.solids[number * PackedChunk::size + i].type == SOLID_EXTRUDE;
            if (const auto thickness = flat_thickness({plane, plane + (is_extrude ? 2 : part.faces)}))
                flat_solids[number].push_back({number * PackedChunk::size + i, *thickness});
            append(part.faces);
            if (part.is_polyhedron) own.resize(first + drop_repeated(own.data() + first, part.faces));
            append(part.cuts);
            kernel::SolidRecord& record = shapes.solids[number * PackedChunk::size + i];
            record.first_plane = static_cast<std::uint32_t>(first);
            record.plane_count = static_cast<std::uint32_t>(own.size() - first);
        }
    });
    note_flat_solids(flat_solids, common, shapes, warnings);
    std::vector<std::uint32_t> first_ref(chunks.size());
    std::size_t refs = shapes.words.size();
    for (std::size_t number = 0; number < chunks.size(); ++number) {
        first_ref[number] = static_cast<std::uint32_t>(refs);
        refs += of[number].size();
    }
    check_numbers(refs);
    shapes.words.resize(refs);
    for_each_chunk(chunks, [&](std::size_t number) {
        std::copy(of[number].begin(), of[number].end(), shapes.words.begin() + first_ref[number]);
        for (std::size_t i = 0; i < chunks[number].parts.size(); ++i)
            shapes.solids[number * PackedChunk::size + i].first_plane += first_ref[number];
    });
}

}  // namespace

void share_planes(std::vector<PackedChunk>& chunks, const PlaneTable& empty, const Box& common, Shapes& shapes,
                  Shells& shells, std::vector<Warning>& warnings) {
    for_each_chunk(chunks, [&](std::size_t number) { insert_large(chunks[number]); });
    const Shards shards = shards_of(chunks, empty, common, shapes);
    const Firsts firsts = find_shared(chunks, shards, empty, common, shapes);
    number_planes(chunks, shards, firsts, common, shapes, shells);
    write_references(chunks, common, shapes, warnings);
}

}  // namespace csgrt
