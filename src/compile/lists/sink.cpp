#include "compile/lists/sink.hpp"

#include <cstring>
#include <utility>

namespace csgrt {
namespace {

constexpr std::size_t most_kept = std::size_t{16} << 20;  ///< bytes, more or less

template <class To, class From>
void add(Array<To>& to, const From* from, std::size_t count) {
    static_assert(sizeof(To) == sizeof(From));
    if (!from || count == 0) return;
    const std::size_t size = to.size();
    to.resize(size + count);
    std::memcpy(to.data() + size, from, count * sizeof(From));
}

template <class To>
void add(Array<To>& to, To value) {
    to.resize(to.size() + 1);
    to[to.size() - 1] = value;
}

}  // namespace

RowSink::RowSink(Partitions& answer, Fields fields, std::uint64_t rays) : answer_(answer), fields_(fields) {
    Partitions& a = answer;
    for (auto* ids : {&a.region_ids, &a.in_solids, &a.out_solids, &a.overlap_region_ids}) ids->resize(0);
    for (auto* reals : {&a.t_in, &a.t_out, &a.overlap_t_in, &a.overlap_t_out}) reals->resize(0);
    for (auto* vectors : {&a.in_normals, &a.out_normals}) vectors->resize(0);
    for (auto* splits : {&a.ray_splits, &a.overlap_splits, &a.overlap_region_splits}) splits->resize(0);
    a.ray_splits.resize(rays + 1);
    a.ray_splits[0] = 0;
    if (!fields.overlaps) return;
    a.overlap_splits.resize(rays + 1);
    a.overlap_splits[0] = 0;
    add(a.overlap_region_splits, std::int64_t{0});
}

void RowSink::append(const RowView& rows) {
    const auto before = static_cast<std::int64_t>(answer_.region_ids.size());
    std::int64_t* const splits = answer_.ray_splits.data() + rows.first + 1;
    for (std::size_t i = 0; i < rows.rays(); ++i) splits[i] = before + rows.places[i + 1].segments;
    add(answer_.region_ids, rows.regions, rows.rows());
    add(answer_.t_in, rows.in, rows.rows());
    add(answer_.t_out, rows.out, rows.rows());
    add(answer_.in_solids, rows.in_solids, rows.rows());
    add(answer_.out_solids, rows.out_solids, rows.rows());
    add(answer_.in_normals, rows.in_normals, rows.rows());
    add(answer_.out_normals, rows.out_normals, rows.rows());
    next_ += rows.rays();
    if (!fields_.overlaps) return;
    std::size_t row = 0;
    for (std::size_t ray = 0; ray < rows.rays(); ++ray) {
        for (; row < rows.overlaps.size() && rows.overlaps[row].ray == ray; ++row) {
            const OverlapRow& overlap = rows.overlaps[row];
            const std::size_t end =
                row + 1 < rows.overlaps.size() ? rows.overlaps[row + 1].first_region : rows.overlap_regions.size();
            add(answer_.overlap_t_in, overlap.in);
            add(answer_.overlap_t_out, overlap.out);
            add(answer_.overlap_region_ids, rows.overlap_regions.data() + overlap.first_region,
                end - overlap.first_region);
            add(answer_.overlap_region_splits, static_cast<std::int64_t>(answer_.overlap_region_ids.size()));
        }
        answer_.overlap_splits[rows.first + ray + 1] = static_cast<std::int64_t>(answer_.overlap_t_in.size());
    }
}

void RowSink::put(const RowView& rows) {
    std::unique_lock lock(mutex_);
    moved_.wait(lock, [&] { return is_stopped_ || rows.first == next_ || kept_bytes_ < most_kept; });
    if (rows.first != next_) {
        const auto [place, is_new] = kept_.emplace(rows.first, RowMemory(rows));
        kept_bytes_ += place->second.bytes();
        return;
    }
    append(rows);
    for (auto first = kept_.begin(); first != kept_.end() && first->first == next_; first = kept_.erase(first)) {
        const RowMemory& memory = first->second;
        append(memory.view(next_, memory.places.size() - 1, fields_));
        kept_bytes_ -= memory.bytes();
    }
    moved_.notify_all();
}

void RowSink::stop() {
    const std::lock_guard lock(mutex_);
    is_stopped_ = true;
    moved_.notify_all();
}

}  // namespace csgrt
