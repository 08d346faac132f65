#include "rays/row_receivers.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <utility>

#include "base/identical.hpp"
#include "base/parallel.hpp"

namespace csgrt {
namespace {

constexpr std::size_t most_kept = std::size_t{16} << 20;  ///< bytes, approximately

/// Runs work on several threads if the batch is large, as a device's batches are. Smaller batches come from several
/// threads already.
template <class Work>
void in_parts(std::size_t count, const Work& work) {
    constexpr std::size_t part = 1 << 14;
    for_chunks(count, part, count > part ? 0 : 1, [&](std::size_t i, std::size_t end, std::size_t) { work(i, end); });
}

template <class To, class From>
void add(Array<To>& to, const From* from, std::size_t count) {
    static_assert(sizeof(To) == sizeof(From));
    if (!from || count == 0) return;
    const std::size_t size = to.size();
    to.resize(size + count);
    in_parts(count, [&](std::size_t i, std::size_t end) {
        std::memcpy(to.data() + size + i, from + i, (end - i) * sizeof(From));
    });
}

}  // namespace

RowCollector::RowCollector(Partitions& rows, Fields fields, std::uint64_t rays) : RowReceiver(fields), answer_(rows) {
    Partitions& a = rows;
    for (auto* ids : {&a.region_ids, &a.in_solids, &a.out_solids, &a.overlap_region_ids}) ids->resize(0);
    for (auto* reals : {&a.t_in, &a.t_out, &a.overlap_t_in, &a.overlap_t_out}) reals->resize(0);
    for (auto* vectors : {&a.in_normals, &a.out_normals}) vectors->resize(0);
    for (auto* splits : {&a.ray_splits, &a.overlap_splits, &a.overlap_region_splits}) splits->resize(0);
    a.ray_splits.resize(rays + 1);
    a.ray_splits[0] = 0;
    if (!fields.overlaps) return;
    a.overlap_splits.resize(rays + 1);
    a.overlap_splits[0] = 0;
    a.overlap_region_splits.resize(1);
    a.overlap_region_splits[0] = 0;
}

void RowCollector::append(const RowView& rows) {
    const auto before = static_cast<std::int64_t>(answer_.region_ids.size());
    std::int64_t* const splits = answer_.ray_splits.data() + rows.first + 1;
    in_parts(rows.rays(), [&](std::size_t i, std::size_t end) {
        for (; i < end; ++i) splits[i] = before + rows.places[i + 1].segments;
    });
    add(answer_.region_ids, rows.regions, rows.rows());
    add(answer_.t_in, rows.in, rows.rows());
    add(answer_.t_out, rows.out, rows.rows());
    add(answer_.in_solids, rows.in_solids, rows.rows());
    add(answer_.out_solids, rows.out_solids, rows.rows());
    add(answer_.in_normals, rows.in_normals, rows.rows());
    add(answer_.out_normals, rows.out_normals, rows.rows());
    next_ += rows.rays();
    if (!fields().overlaps) return;
    const std::span<const OverlapRow> overlaps = rows.overlaps;
    const std::size_t first = answer_.overlap_t_in.size(), claims = answer_.overlap_region_ids.size();
    answer_.overlap_t_in.resize(first + overlaps.size());
    answer_.overlap_t_out.resize(first + overlaps.size());
    answer_.overlap_region_splits.resize(first + overlaps.size() + 1);
    add(answer_.overlap_region_ids, rows.overlap_regions.data(), rows.overlap_regions.size());
    in_parts(overlaps.size(), [&](std::size_t i, std::size_t end) {
        for (; i < end; ++i) {
            const bool is_last = i + 1 == overlaps.size();
            answer_.overlap_t_in[first + i] = overlaps[i].in;
            answer_.overlap_t_out[first + i] = overlaps[i].out;
            answer_.overlap_region_splits[first + i + 1] = static_cast<std::int64_t>(
                claims + (is_last ? rows.overlap_regions.size() : overlaps[i + 1].first_region));
        }
    });
    in_parts(rows.rays(), [&](std::size_t ray, std::size_t end) {
        auto next = std::ranges::lower_bound(overlaps, ray, {}, &OverlapRow::ray);
        for (; ray < end; ++ray) {
            while (next != overlaps.end() && next->ray == ray) ++next;
            answer_.overlap_splits[rows.first + ray + 1] = static_cast<std::int64_t>(first) + (next - overlaps.begin());
        }
    });
}

void RowCollector::put(const RowView& rows) {
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
        append(memory.view(next_, memory.places.size() - 1, fields()));
        kept_bytes_ -= memory.bytes();
    }
    moved_.notify_all();
}

void RowCollector::stop() {
    const std::lock_guard lock(mutex_);
    is_stopped_ = true;
    moved_.notify_all();
}

bool RowCollector::has(std::uint64_t ray, const Partitions& rows, std::size_t other) const {
    return same_rows(answer_, ray, rows, other);
}

HitCollector::HitCollector(const HitArrays& arrays, std::uint64_t rays)
    : RowReceiver({.solids = arrays.solids != nullptr, .normals = arrays.normals != nullptr, .overlaps = false}, true),
      to_(arrays) {
    const auto fit = [rays](auto* array) {
        if (array) array->resize(rays);
    };
    fit(to_.regions);
    fit(to_.distances);
    fit(to_.solids);
    fit(to_.normals);
    fit(to_.hits);
}

void HitCollector::put(const RowView& rows) {
    in_parts(rows.rays(), [&](std::size_t i, std::size_t end) {
        for (; i < end; ++i) {
            const std::size_t ray = rows.first + i, row = rows.places[i].segments;
            const bool is_hit = rows.places[i + 1].segments > row;
            if (to_.regions) (*to_.regions)[ray] = is_hit ? rows.regions[row] : -1;
            if (to_.distances) (*to_.distances)[ray] = is_hit ? rows.in[row] : std::numeric_limits<double>::infinity();
            if (to_.solids) (*to_.solids)[ray] = is_hit ? rows.in_solids[row] : -1;
            if (to_.normals) (*to_.normals)[ray] = is_hit ? rows.in_normals[row] : Vec3{};
            if (to_.hits) (*to_.hits)[ray] = is_hit;
        }
    });
}

bool HitCollector::has(std::uint64_t ray, const Partitions& rows, std::size_t other) const {
    const auto row = static_cast<std::size_t>(rows.ray_splits[other]);
    const bool is_hit = rows.ray_splits[other + 1] > rows.ray_splits[other];
    if (to_.hits && (*to_.hits)[ray] != is_hit) return false;
    if (to_.regions && (*to_.regions)[ray] != (is_hit ? rows.region_ids[row] : -1)) return false;
    return !is_hit || ((!to_.distances || same_bits((*to_.distances)[ray], rows.t_in[row])) &&
                       (!to_.solids || (*to_.solids)[ray] == rows.in_solids[row]) &&
                       (!to_.normals || same_bits((*to_.normals)[ray], rows.in_normals[row])));
}

PixelCollector::PixelCollector(Array<std::int32_t>& pixels, std::uint32_t width, std::uint64_t rays)
    : RowReceiver({.solids = false, .normals = false, .overlaps = true}), pixels_(pixels), width_(width) {
    pixels.resize(rays * width);
}

/// Fills the pixels whose middles lie in [in, out).
void PixelCollector::fill(std::int32_t* line, double in, double out, std::int32_t value) const {
    const auto pixel = [&](double t) {
        return static_cast<std::ptrdiff_t>(std::clamp(std::ceil(t - 0.5), 0.0, static_cast<double>(width_)));
    };
    std::fill(line + pixel(in), line + std::max(pixel(in), pixel(out)), value);
}

void PixelCollector::put(const RowView& rows) {
    std::size_t overlap_row = 0;
    for (std::size_t i = 0; i < rows.rays(); ++i) {
        std::int32_t* const line = pixels_.data() + (rows.first + i) * width_;
        std::fill_n(line, width_, nothing);
        for (std::size_t row = rows.places[i].segments; row < rows.places[i + 1].segments; ++row)
            fill(line, rows.in[row], rows.out[row], rows.regions[row]);
        for (; overlap_row < rows.overlaps.size() && rows.overlaps[overlap_row].ray == i; ++overlap_row)
            fill(line, rows.overlaps[overlap_row].in, rows.overlaps[overlap_row].out, overlap);
    }
}

bool PixelCollector::has(std::uint64_t ray, const Partitions& rows, std::size_t other) const {
    std::vector<std::int32_t> line(width_, nothing);
    for (auto row = rows.ray_splits[other]; row < rows.ray_splits[other + 1]; ++row)
        fill(line.data(), rows.t_in.data()[row], rows.t_out.data()[row], rows.region_ids.data()[row]);
    for (auto row = rows.overlap_splits[other]; row < rows.overlap_splits[other + 1]; ++row)
        fill(line.data(), rows.overlap_t_in.data()[row], rows.overlap_t_out.data()[row], overlap);
    return std::equal(line.begin(), line.end(), pixels_.data() + ray * width_);
}

}  // namespace csgrt
