// Pack planes: packs the planes of all solids. Several threads find the equal planes (shards.hpp).
#include <algorithm>
#include <cmath>
#include <optional>
#include <span>
#include <unordered_map>
#include <unordered_set>
#include <utility>

#include "base/prefetch.hpp"
#include "compile/linear.hpp"
#include "compile/pack_chunks.hpp"
#include "compile/solids/pack.hpp"
#include "scene/range.hpp"

namespace csgrt {

namespace {

/// Puts the planes of large solids among the others.
void insert_large(PackedChunk& chunk) {
    std::vector<PackedPlane> all;
    auto small = chunk.planes.begin();
    auto large = chunk.large_faces.begin();
    std::uint32_t first = 0;
    for (PackedChunk::Part& part : chunk.parts) {
        const std::uint32_t count = part.faces + part.cuts;
        part.first_plane = std::exchange(first, first + count);
        if (chunk.large_faces.empty()) continue;
        if (part.is_large) {
            all.insert(all.end(), large->begin(), large->end());
            ++large;
        } else {
            all.insert(all.end(), small, small + count);
            small += count;
        }
    }
    if (!std::exchange(chunk.large_faces, {}).empty()) chunk.planes = std::move(all);
    chunk.firsts.resize(chunk.planes.size());
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
void note_flat_solids(const std::vector<FlatSolid>& flat_solids, const Box& common, const Shapes& shapes,
                      std::vector<Warning>& warnings) {
    const auto warn = [&](std::string object, std::string reason) {
        Warning& warning = warnings.emplace_back();
        warning.object = std::move(object);
        warning.reason = std::move(reason);
    };
    constexpr std::size_t shown = 5;
    std::size_t count = 0;
    for (const auto& [solid, thickness] : flat_solids) {
        // note_on() warns of a revolve that turns by no angle.
        if (shapes.solids[solid].type == SOLID_REVOLVE && thickness == 0) continue;
        if (++count > shown) continue;
        const Box& box = is_finite(shapes.solid_boxes[solid]) ? shapes.solid_boxes[solid] : common;
        const double of_size = PlaneTable::gap * diagonal(box),
                     of_place = coordinate_rounding * largest_coordinate(box);
        const char* const what = of_size >= of_place ? "1e-10 of its size" : "what rounding may do to its coordinates";
        std::string reason = "nothing is left of it: two of its faces are " + rounded_text(thickness) +
                             " mm apart, and faces within " + rounded_text(std::max(of_size, of_place)) + " mm, " +
                             what + ", are one surface";
        warn(shapes.solid_info[solid].name, std::move(reason));
    }
    if (count > shown) warn({}, "nothing is left of " + std::to_string(count - shown) + " more such solids");
}

/// The distance of a point beyond the plane, outward from the solid whose face the plane is.
long double beyond(const PlaneTable::Key& key, const Wide& point) {
    const long double out = glm::dot(wide(key.one.normal), point) - key.one.distance;
    return key.flipped ? -out : out;
}

PackedChunk::Part& part_of(std::vector<PackedChunk>& chunks, std::uint32_t solid) {
    return chunks[solid / PackedChunk::size].parts[solid % PackedChunk::size];
}

/// Calls call(part, number) for the parts of the solids by number. Neighbours in the hierarchy may lie far apart here.
template <class Call>
void for_each_part(std::vector<PackedChunk>& chunks, const std::vector<std::uint32_t>& order, const Call& call) {
    for (std::size_t i = 0; i < order.size(); ++i) {
        constexpr std::size_t soon = 16;
        if (i + soon < order.size()) prefetch_line(&part_of(chunks, order[i + soon]).first_plane);
        call(part_of(chunks, order[i]), i);
    }
}

/// Writes the scene's records in the order of the solids that have them first, and sets each `ref` to the reference in
/// the scene's table.
void number_planes(std::vector<PackedChunk>& chunks, const std::vector<std::uint32_t>& order, Shapes& shapes) {
    for_each_chunk(chunks, [&](std::size_t number) {
        PackedChunk& chunk = chunks[number];
        for (PackedChunk::Part& part : chunk.parts) {
            part.first_record = 0;
            for (const PackedPlane& plane : chunk.planes_of(part)) part.first_record += plane.is_first;
        }
    });
    std::size_t records = 0;
    for_each_part(chunks, order, [&](PackedChunk::Part& part, std::size_t) {
        records += std::exchange(part.first_record, static_cast<std::uint32_t>(records));
    });
    PlaneTable::check_count(records);
    resize_cleared(shapes.planes, records);
    std::vector<kernel::PlaneRecord>& planes = shapes.planes.own();
    for_each_chunk(chunks, [&](std::size_t number) {
        PackedChunk& chunk = chunks[number];
        for (const PackedChunk::Part& part : chunk.parts) {
            std::uint32_t next = part.first_record;
            if (part.is_gone) continue;
            for (PackedPlane& plane : chunk.planes_of(part)) {
                if (!plane.is_first) continue;
                planes[next] = PlaneTable::record_of(plane.key);
                plane.ref = next++ << 1;
            }
        }
    });
    for_each_chunk(chunks, [&](std::size_t number) {
        PackedChunk& chunk = chunks[number];
        for (std::size_t i = 0; i < chunk.planes.size(); ++i) {
            if (chunk.planes[i].is_first) continue;
            const auto [first, index] = chunk.firsts[i];
            chunk.planes[i].ref = chunks[first].planes[index >> 1].ref | (index & 1);
        }
    });
}

/// Writes each solid's references after the words of the solids.
void write_references(std::vector<PackedChunk>& chunks, const std::vector<std::uint32_t>& order, const Box& common,
                      Shapes& shapes, std::vector<Warning>& warnings) {
    std::vector<std::vector<kernel::PlaneRef>> of(chunks.size());
    std::vector<std::unordered_map<std::size_t, double>> thickness(chunks.size());  // by part: of flat solids
    for_each_chunk(chunks, [&](std::size_t number) {
        PackedChunk& chunk = chunks[number];
        std::vector<kernel::PlaneRef>& own = of[number];
        own.reserve(chunk.planes.size());
        for (std::size_t i = 0; i < chunk.parts.size(); ++i) {
            PackedChunk::Part& part = chunk.parts[i];
            const std::span<const PackedPlane> planes = chunk.planes_of(part);
            part.first_ref = static_cast<std::uint32_t>(own.size());
            // A wall's plane has an inner side only in a polyhedron: two walls of a concave outline that face away from
            // each other may lie in one plane. The caps always have an inner side.
            if (const auto found = flat_thickness(planes.first(part.type == SOLID_EXTRUDE ? 2 : part.faces)))
                thickness[number][i] = *found;
            for (const PackedPlane& plane : planes.first(part.faces)) own.push_back(plane.ref);
            if (part.is_polyhedron) own.resize(part.first_ref + drop_repeated(own.data() + part.first_ref, part.faces));
            for (const PackedPlane& plane : planes.subspan(part.faces)) own.push_back(plane.ref);
            part.refs = static_cast<std::uint32_t>(own.size()) - part.first_ref;
        }
    });
    std::vector<kernel::SolidRecord>& solids = shapes.solids.own();
    std::vector<FlatSolid> flat_solids;
    std::size_t refs = shapes.words.size();
    for_each_part(chunks, order, [&](const PackedChunk::Part& part, std::size_t i) {
        solids[i].first_plane = static_cast<std::uint32_t>(refs);
        solids[i].plane_count = part.refs;
        refs += part.refs;
        const auto& flat = thickness[order[i] / PackedChunk::size];
        if (flat.empty()) return;
        if (const auto found = flat.find(order[i] % PackedChunk::size); found != flat.end())
            flat_solids.push_back({i, found->second});
    });
    check_numbers(refs);
    note_flat_solids(flat_solids, common, shapes, warnings);
    std::vector<std::uint32_t>& words = shapes.words.own();
    words.resize(refs);
    for_chunks(order.size(), PackedChunk::size, 0, [&](std::size_t begin, std::size_t end, std::size_t) {
        const auto first_at = [&](std::size_t i) {
            return of[order[i] / PackedChunk::size].begin() + part_of(chunks, order[i]).first_ref;
        };
        for (std::size_t i = begin; i < end; ++i) {
            constexpr std::size_t soon = 8;
            if (i + soon < end && solids[i + soon].plane_count > 0) prefetch_line(&*first_at(i + soon));
            std::copy_n(first_at(i), solids[i].plane_count, words.begin() + solids[i].first_plane);
        }
    });
}

}  // namespace

PlaneSharing::PlaneSharing(std::vector<PackedChunk>& chunks, const PlaneTable& empty, const std::vector<Box>& boxes,
                           const Box& common, Shells& shells)
    : chunks_(chunks), empty_(empty), boxes_(boxes), common_(common), shells_(shells), shards_(chunks.size()) {
    for_each_chunk(chunks, [&](std::size_t number) { insert_large(chunks[number]); });
    for (const PackedChunk& chunk : chunks) count_ += chunk.planes.size();
    for_each_chunk(chunks, [&](std::size_t number) {
        PackedChunk& chunk = chunks[number];
        shards_.chunk(number).reserve(chunk.planes.size());
        for (std::uint32_t i = 0; i < chunk.parts.size(); ++i) {
            for (PackedPlane& plane : chunk.planes_of(chunk.parts[i])) {
                plane.solid = static_cast<std::uint16_t>(i);
                empty.add_to(shards_.chunk(number), plane.key, box_of(number * PackedChunk::size + i), count_);
            }
        }
    });
    shards_.sort();
    shards_.for_each(empty, [&](PlaneTable& table, std::span<const Shards::Member> members, std::size_t) {
        table.reserve(members.size());
        share(table, members);
    });
    shards_.forget_members();
}

/// Finds the first of each of some planes.
void PlaneSharing::share(PlaneTable& table, std::span<const Shards::Member> members) {
    const auto plane_at = [&](const Shards::Member& m) -> PackedPlane& { return chunks_[m.chunk].planes[m.index]; };
    const auto solid_of = [&](const Shards::Member& m) { return m.chunk * PackedChunk::size + plane_at(m).solid; };
    std::vector<Shards::Member> firsts;  // one a record of the table
    for (std::size_t i = 0; i < members.size(); ++i) {
        // The entries lie far apart in memory: without prefetching the thread would wait for memory most of the time.
        constexpr std::size_t soon = 6, later = 12;
        if (i + later < members.size()) prefetch_line(&plane_at(members[i + later]));
        if (i + soon < members.size()) {
            prefetch_line(&boxes_[solid_of(members[i + soon])]);
            table.prefetch(plane_at(members[i + soon]).key);
        }
        const Shards::Member& member = members[i];
        PackedPlane& plane = plane_at(member);
        const std::size_t before = table.size(), solid = solid_of(member);
        const kernel::PlaneRef ref = table.add_keyed(plane.key, box_of(solid));
        plane.is_first = table.size() > before;
        if (plane.is_first) firsts.push_back(member);
        const Shards::Member& first = firsts[ref >> 1];
        chunks_[member.chunk].firsts[member.index] = {first.chunk, first.index << 1 | (ref & 1)};
        if (plane.is_first || (ref & 1) != 0) continue;
        const Wide middle = 0.5L * (wide(box_of(solid).low) + wide(box_of(solid).high));
        shells_.add(solid_of(first), solid,
                    static_cast<double>(beyond(plane.key, middle) - beyond(plane_at(first).key, middle)),
                    box_of(solid));
    }
}

void PlaneSharing::change(std::size_t solid) {
    const std::size_t number = solid / PackedChunk::size;
    PackedChunk& chunk = chunks_[number];
    const PackedChunk::Part& part = chunk.parts[solid % PackedChunk::size];
    std::size_t index = part.first_plane;
    for (PackedPlane& plane : chunk.planes_of(part)) {
        Shards::Chunk at;
        empty_.add_to(at, plane.key, box_of(solid), count_);
        shards_.replace(number, index++, at);
    }
}

void PlaneSharing::remove(std::size_t solid) {
    const std::size_t number = solid / PackedChunk::size;
    const PackedChunk::Part& part = chunks_[number].parts[solid % PackedChunk::size];
    for (std::uint32_t i = 0; i < part.faces + part.cuts; ++i) shards_.touch(number, part.first_plane + i);
}

void PlaneSharing::share_again() {
    std::vector<Shards::Member> members = shards_.take_changed();
    std::erase_if(members, [&](const Shards::Member& member) {
        PackedChunk& chunk = chunks_[member.chunk];
        return chunk.parts[chunk.planes[member.index].solid].is_gone;
    });
    PlaneTable table = empty_;
    share(table, members);
}

void PlaneSharing::write(const std::vector<std::uint32_t>& order, Shapes& shapes, std::vector<Warning>& warnings) {
    number_planes(chunks_, order, shapes);
    write_references(chunks_, order, common_, shapes, warnings);
}

}  // namespace csgrt
