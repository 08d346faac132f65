// The planes of all solids, those that are one found by several threads: see shards.hpp.
#include <algorithm>
#include <span>
#include <unordered_set>
#include <utility>

#include "compile/linear.hpp"
#include "compile/pack_chunks.hpp"
#include "compile/pack_solids.hpp"
#include "parallel.hpp"

namespace csgrt {

namespace {

/// A chunk's planes on the way to the scene's.
struct Planes {
    std::vector<std::uint16_t> solids;   ///< whose they are, within the chunk
    std::vector<std::uint32_t> refs;     ///< first within the shard's table, then the scene's
    std::vector<std::uint32_t> records;  ///< of those that no plane before them is: NONE if one is, else the number
    std::uint32_t first_record = 0, first_ref = 0;
};

void insert_large(PackedChunk& chunk) {
    if (chunk.large_faces.empty()) return;
    std::vector<PlaneTable::Key> all;
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

/// Leaves out faces of a polyhedron that have come already. Returns how many references are left.
std::size_t drop_repeated(std::uint32_t* refs, std::size_t count) {
    constexpr std::size_t few = 16;  // an arbn may have very many faces
    std::unordered_set<std::uint32_t> seen;
    std::size_t kept = 0;
    for (std::size_t i = 0; i < count; ++i) {
        const bool again = count > few ? !seen.insert(refs[i]).second
                                       : std::find(refs, refs + kept, refs[i]) != refs + kept;
        if (!again) refs[kept++] = refs[i];
    }
    return kept;
}

}  // namespace

void share_planes(std::vector<PackedChunk>& chunks, const PlaneTable& empty, const Box& common,
                  CompiledScene& compiled) {
    std::vector<Planes> of(chunks.size());
    Shards shards(chunks.size());
    const auto for_each_chunk = [&](const auto& call) {
        for_chunks(chunks.size(), 1, 0, [&](std::size_t number, std::size_t, std::size_t) { call(number); });
    };
    for_each_chunk([&](std::size_t number) {
        PackedChunk& chunk = chunks[number];
        insert_large(chunk);
        const std::size_t count = chunk.planes.size();
        Planes& planes = of[number];
        planes.refs.resize(count);
        planes.records.assign(count, NONE);
        planes.solids.reserve(count);
        shards.chunk(number).reserve(count);
        for (std::uint32_t i = 0; i < chunk.parts.size(); ++i)
            planes.solids.insert(planes.solids.end(), chunk.parts[i].faces + chunk.parts[i].cuts,
                                 static_cast<std::uint16_t>(i));
        for (const PlaneTable::Key& plane : chunk.planes) empty.add_to(shards.chunk(number), plane);
    });
    shards.sort();

    std::vector<std::vector<Shards::Member>> firsts(Shards::count);  // where the records of each shard's table came from
    shards.for_each([&](std::span<const Shards::Member> members, std::size_t shard) {
        PlaneTable table = empty;
        for (const auto& [number, i] : members) {
            Planes& planes = of[number];
            const Box& box = compiled.solid_boxes[number * PackedChunk::size + planes.solids[i]];
            const std::size_t before = table.size();
            planes.refs[i] = table.add_keyed(chunks[number].planes[i], is_finite(box) ? box : common);
            if (table.size() == before) continue;
            planes.records[i] = 0;
            firsts[shard].push_back({number, i});
        }
    });

    std::size_t records = 0;
    for_each_chunk([&](std::size_t number) {
        for (const std::uint32_t record : of[number].records) of[number].first_record += record != NONE;
    });
    for (Planes& planes : of) records += std::exchange(planes.first_record, static_cast<std::uint32_t>(records));
    PlaneTable::check_count(records);
    compiled.planes.resize(records);
    for_each_chunk([&](std::size_t number) {
        std::uint32_t next = of[number].first_record;
        for (std::size_t i = 0; i < of[number].records.size(); ++i) {
            if (of[number].records[i] == NONE) continue;
            compiled.planes[next] = PlaneTable::record_of(chunks[number].planes[i]);
            of[number].records[i] = next++;
        }
    });
    shards.for_each([&](std::span<const Shards::Member> members, std::size_t shard) {
        for (const auto& [number, i] : members) {
            std::uint32_t& ref = of[number].refs[i];
            const Shards::Member first = firsts[shard][ref >> 1];
            ref = of[first.chunk].records[first.index] << 1 | (ref & 1);
        }
    });

    std::size_t refs = 0;
    for_each_chunk([&](std::size_t number) {
        Planes& planes = of[number];
        std::size_t from = 0, to = 0;
        for (std::size_t i = 0; i < chunks[number].parts.size(); ++i) {
            const PackedChunk::Part& part = chunks[number].parts[i];
            std::uint32_t* own = planes.refs.data() + from;
            const std::size_t faces = part.is_polyhedron ? drop_repeated(own, part.faces) : part.faces;
            kernel::SolidRecord& record = compiled.solids[number * PackedChunk::size + i];
            record.first_plane = static_cast<std::uint32_t>(to);
            record.plane_count = static_cast<std::uint32_t>(faces + part.cuts);
            std::copy(own, own + faces, planes.refs.data() + to);
            std::copy(own + part.faces, own + part.faces + part.cuts, planes.refs.data() + to + faces);
            from += part.faces + part.cuts;
            to += record.plane_count;
        }
        planes.refs.resize(to);
    });
    for (Planes& planes : of) {
        planes.first_ref = static_cast<std::uint32_t>(refs);
        refs += planes.refs.size();
    }
    check_numbers(refs);
    compiled.plane_refs.resize(refs);
    for_each_chunk([&](std::size_t number) {
        const Planes& planes = of[number];
        std::copy(planes.refs.begin(), planes.refs.end(), compiled.plane_refs.begin() + planes.first_ref);
        for (std::size_t i = 0; i < chunks[number].parts.size(); ++i)
            compiled.solids[number * PackedChunk::size + i].first_plane += planes.first_ref;
    });
}

}  // namespace csgrt
