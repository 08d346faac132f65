#include "pipeline/picture_lines.hpp"

#include <algorithm>
#include <system_error>
#include <utility>

#include "kernel_geometry.hpp"
#include "pipeline/known_picture.hpp"

namespace csgrt {

PictureLines::PictureLines(Device& device)
    : device_(device), places_(device, "places of blocks"), extents_(device, "extents of rows"), lines_(device, "lines") {}

void PictureLines::build() {
    program_.emplace(device_, assemble_program({"picture_lines.cl"}));
    find_shown_.emplace(program_->kernel("find_shown"));
    put_lines_.emplace(program_->kernel("put_lines"));
    copies_.emplace(device_);
}

bool PictureLines::has_room(const Buffer& buffer, std::uint64_t bytes) const {
    return bytes <= buffer.size() || bytes <= std::min(device_.available() + buffer.size(), device_.max_buffer());
}

bool PictureLines::put_blocks(const kernel::Frame& frame, std::uint32_t first, std::uint32_t end, std::uint32_t drawn,
                              const TileBuffers& tile, bool is_last, const RenderTarget& target) {
    if (target.planes.empty()) return true;
    std::vector<std::uint32_t> extents(2 * rows_of(frame, first, end), 0);
    const std::size_t extents_bytes = extents.size() * sizeof(cl_uint), places_bytes = (end - first) * sizeof(cl_uint);
    if (!has_room(places_, places_bytes)) return false;
    places_.reserve(places_bytes);
    if (!has_room(extents_, extents_bytes)) return false;
    extents_.reserve(extents_bytes);

    const auto planes = static_cast<cl_uint>(target.planes.size());
    kernel::PlaneValues background{};
    for (std::size_t p = 0; p < planes; ++p) background.of[p] = target.planes[p].background;
    places_.queue_fill(NONE, places_bytes);
    if (drawn > 0) {
        extents_.queue_fill(0, extents_bytes);
        find_shown_->launch(std::size_t{drawn} * block_rays, block_rays, cl_uint{frame.width}, cl_uint{frame.height}, planes,
                            background, cl_uint{first}, tile.rays, tile.picture, places_, extents_);
        extents = extents_.read<std::uint32_t>(extents.size());
    }
    std::vector<Rectangle> rectangles = find_rectangles(frame, first, end, extents, target);
    std::size_t floats = 0;
    for (Rectangle& r : rectangles) {  // a copy by lines begins with one
        r.begin = (floats + r.columns() - 1) / r.columns() * r.columns();
        floats = r.begin + r.size() * planes;
    }
    if (floats > 0) {
        const std::size_t bytes = floats * sizeof(float);
        copies_->finish();  // before lines_ changes
        if (!has_room(lines_, bytes)) return false;
        lines_.reserve(bytes);
        Event put;
        for (const Rectangle& r : rectangles)
            put = put_lines_->launch(r.size(), work_group, cl_uint{frame.width}, planes, background, cl_uint{first},
                                     static_cast<cl_uint>(end - first), static_cast<cl_uint>(drawn * block_rays),
                                     static_cast<cl_uint>(r.left), static_cast<cl_uint>(r.top),
                                     static_cast<cl_uint>(r.columns()), static_cast<cl_uint>(r.lines()),
                                     static_cast<cl_uint>(r.begin), places_, tile.picture, lines_);
        device_.flush();  // another queue waits for it
        const std::size_t rays = std::size_t{end - first} * block_rays;
        const bool are_many = std::size_t{frame.width} * frame.height > 2 * rays;  // tiles: others may have more to copy
        const std::size_t most = are_many ? rays * planes * sizeof(float) : 0;
        if (target.known && target.known->is_known_to(device_))
            copy_into(frame, rectangles, target, put);
        else
            copy_by_host(frame, std::move(rectangles), bytes, most, is_last, target, put);
    }
    mark_shown(frame, first, end, extents, target);
    return true;
}

void PictureLines::copy_into(const kernel::Frame& frame, const std::vector<Rectangle>& rectangles, const RenderTarget& target,
                             const Event& after) {
    for (const Rectangle& r : rectangles)
        for (std::size_t p = 0; p < target.planes.size(); ++p)
            copies_->queue_read(lines_, r.begin + p * r.size(), target.planes[p].pixels + r.top * frame.width + r.left, frame.width,
                                r.columns(), r.lines(), after);
    copies_->flush();
}

/// Memory that a GPU copies to at full speed takes half a millisecond a megabyte to get.
PictureLines::Slot& PictureLines::free_slot(std::size_t bytes, std::size_t most) {
    Slot& slot = slots_[next_];
    if (slot.done.valid()) slot.done.get();
    if (!slot.memory || slot.memory->size() < bytes) {
        slot.memory.reset();
        slot.memory.emplace(device_, "picture", std::max(bytes, most));
    }
    return slot;
}

void PictureLines::copy_by_host(const kernel::Frame& frame, std::vector<Rectangle> rectangles, std::size_t bytes,
                                std::size_t most, bool is_last, const RenderTarget& target, const Event& after) {
    Slot& slot = free_slot(bytes, most);
    auto* const values = static_cast<float*>(slot.memory->data());
    // Of the copy's end the event tells that the queue gave, not the queue: by then it may be at the next tile's.
    auto copied = std::make_shared<const Event>(copies_->queue_read(lines_, values, bytes, after));
    copies_->flush();
    const auto put = [=, rectangles = std::move(rectangles)] {
        wait_for(*copied);
        put_rectangles(frame, rectangles, values, target);
    };
    if (is_last) return put();
    try {
        slot.done = std::async(std::launch::async, put);
        next_ = (next_ + 1) % slots_.size();
    } catch (const std::system_error&) {  // no more threads
        put();
    }
}

void PictureLines::finish() {
    for (Slot& slot : slots_)
        if (slot.done.valid()) slot.done.get();
    if (copies_) copies_->finish();
}

void PictureLines::abandon() noexcept {
    for (Slot& slot : slots_) slot.done = {};
    try {
        if (copies_) copies_->finish();
    } catch (...) {  // nothing more comes
    }
}

void PictureLines::release() {
    if (copies_) copies_->finish();
    for (Buffer* buffer : {&places_, &extents_, &lines_}) *buffer = Buffer(device_, buffer->name());
}

}  // namespace csgrt
