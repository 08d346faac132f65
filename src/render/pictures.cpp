// Pictures of a Renderer: whole, coarse to fine, with several rays a pixel, and with ghosts.
#include <algorithm>
#include <cmath>
#include <future>
#include <optional>
#include <utility>

#include "base/display_bytes.hpp"
#include "base/fnv1a.hpp"
#include "base/parallel.hpp"
#include "base/thread.hpp"
#include "device/choice.hpp"
#include "kernel_host/geometry.hpp"
#include "render/edges.hpp"
#include "render/image_header.hpp"
#include "render/renderer_impl.hpp"

namespace csgrt {

Image Renderer::render(const View& view) {
    Framebuffer framebuffer;
    render(view, framebuffer);
    return framebuffer.take();
}

void Renderer::render(const View& view, Framebuffer& framebuffer, const std::function<bool(int)>& coarse) {
    const FloatingPoint own;
    Impl& impl = this->impl();
    const AllowedThreads allowed(impl.settings.threads);
    const std::function<bool(int)> shows = own.of_host(coarse);
    Watch::over(own.of_host(impl.settings.progress),
                [&](Watch& watch) { impl.render(view, framebuffer, shows, watch); });
}

/// Resizes the framebuffer to a picture of these channels; new memory is background.
void Renderer::Impl::fit(Framebuffer& framebuffer, const kernel::Frame& frame, std::uint32_t channels,
                         const Watch& watch) const {
    const kernel::Pixel background_pixel = kernel::background_pixel(&frame);
    std::vector<std::string> names;
    std::vector<bool> are_ids;
    std::vector<float> background;
    for (const ChannelSource& source : channel_table) {
        if (!(channels & source.group)) continue;
        names.emplace_back(source.name);
        are_ids.push_back(holds_ids(source));
        background.push_back(source.value(background_pixel, scene().display[0]));
    }
    framebuffer.fit(static_cast<int>(frame.width), static_cast<int>(frame.height), std::move(names),
                    std::move(background), watch);
    framebuffer.image_.are_ids = std::move(are_ids);
}

/// Draws the frame's channels. The framebuffer has them, except, for a frame with edges, those of its surfaces.
void Renderer::Impl::draw(const PreparedFrame& prepared, Framebuffer& framebuffer, Watch& watch) {
    const kernel::Pixel background = kernel::background_pixel(&prepared.frame);
    Image& image = framebuffer.image_;
    std::vector<const ChannelSource*> sources;
    std::vector<ChannelMemory> channels;
    std::size_t own = 0;  // the frame's channels come first
    for (const ChannelSource& source : channel_table) {
        if (!(prepared.frame.channels & source.group)) continue;
        const bool has = own < image.names.size() && image.names[own] == source.name;
        sources.push_back(&source);
        channels.push_back(
            {has ? image.channels[own++].data() : nullptr, source.value(background, scene().display[0])});
    }
    try {
        backend->render(
            prepared, {channels, sources, framebuffer.covered_, framebuffer.drawn_by_, framebuffer.registered_}, watch);
    } catch (...) {
        if (framebuffer.registered_ && framebuffer.registered_->has_lost())
            keep_for_ever(std::make_shared<Framebuffer>(std::move(framebuffer)));
        throw;
    }
}

/// Draws other rays of the view, or other channels, into the framebuffer `beside`.
const Image& Renderer::Impl::draw_beside(const View& view, const Sampling& sampling, std::uint32_t channels,
                                         Watch& watch) {
    PreparedFrame prepared = prepare_frame(scene_of(ClaimingRegions::shown), view, tolerance, sampling);
    prepared.frame.channels = channels;
    fit(beside, prepared.frame, channels, watch);
    draw(prepared, beside, watch);
    return beside.image_;
}

/// The frame whose edges a device draws. Nothing if no device can: then the host draws them.
std::optional<PreparedFrame> Renderer::Impl::with_edges(PreparedFrame prepared) const {
    prepared.frame.channels |= edge_channels;
    prepared.edges = true;
    return backend->draws_edges(prepared) ? std::optional(std::move(prepared)) : std::nullopt;
}

/// Draws as draw_beside() does, with the view's edges, whose channels the picture may have, too.
const Image& Renderer::Impl::draw_with_edges(const View& view, const Sampling& sampling, std::uint32_t channels,
                                             Watch& watch) {
    if (!view.edges) return draw_beside(view, sampling, channels, watch);
    PreparedFrame prepared = prepare_frame(scene_of(ClaimingRegions::shown), view, tolerance, sampling);
    prepared.frame.channels = channels;
    if (const std::optional<PreparedFrame> of_device = with_edges(prepared)) {
        fit(beside, prepared.frame, channels, watch);
        draw(*of_device, beside, watch);
        if (backend->has_drawn_edges()) return beside.image_;
    }
    draw_beside(view, sampling, channels | edge_channels, watch);
    draw_edges(prepared, beside.image_, beside.image_);
    return beside.image_;
}

/// Draws every 8th pixel in each direction, then the missing pixels of every 4th, of every 2nd, and all pixels. In each
/// step drawn pixels also fill the pixels that are still missing. Without `coarse` it draws all pixels at once.
/// With `more` channels it draws all pixels in the last step, and leaves them with these channels in `beside`. Returns
/// false if `coarse` ended the drawing.
bool Renderer::Impl::draw_coarse(const View& view, std::uint32_t channels, std::uint32_t more, Framebuffer& framebuffer,
                                 const std::function<bool(int)>& coarse, Watch& watch) {
    Image& image = framebuffer.image_;
    std::ranges::fill(framebuffer.covered_, std::uint8_t{1});
    const auto put = [&](const Sampling& sampling, std::size_t size) {
        if (sampling.column >= image.width || sampling.line >= image.height) return;
        const Image& part = draw_beside(view, sampling, size == 1 ? channels | more : channels, watch);
        const auto width = static_cast<std::size_t>(image.width), height = static_cast<std::size_t>(image.height);
        const auto columns = static_cast<std::size_t>(part.width), step = static_cast<std::size_t>(sampling.step);
        for_chunks(static_cast<std::size_t>(part.height), 4, 0, [&](std::size_t line, std::size_t end, std::size_t) {
            for (; line < end; ++line)
                for (std::size_t c = 0, own = 0; c < part.channels.size(); ++c) {
                    if (own == image.names.size() || image.names[own] != part.names[c]) continue;
                    const std::size_t top = static_cast<std::size_t>(sampling.line) + line * step;
                    float* const first = image.channels[own++].data() + top * width;
                    const float* from = part.channels[c].data() + line * columns;
                    if (step == 1) {
                        std::copy_n(from, width, first);
                        continue;
                    }
                    for (std::size_t x = static_cast<std::size_t>(sampling.column); x < width; x += step)
                        std::fill_n(first + x, std::min(size, width - x), *from++);
                    for (std::size_t y = top + 1; y < std::min(top + size, height); ++y)
                        for (std::size_t x = static_cast<std::size_t>(sampling.column); x < width; x += step)
                            std::copy_n(first + x, std::min(size, width - x), first + (y - top) * width + x);
                }
        });
    };
    if (!coarse) return put({}, 1), true;
    put({.step = 8}, 8);
    for (int size = 4; size >= 1; size /= 2) {
        if (!coarse(2 * size)) return false;
        if (size == 1 && more) return put({}, 1), true;
        const int step = size == 4 ? 8 : 2 * size;
        put({.step = step, .column = size, .line = 0}, static_cast<std::size_t>(size));
        put({.step = step, .column = 0, .line = size}, static_cast<std::size_t>(size));
        put({.step = step, .column = size, .line = size}, static_cast<std::size_t>(size));
    }
    return true;
}

/// Replaces the colours by the mean of several rays a pixel. The rays are Hammersley's points, moved so that the first
/// point is the pixel's middle.
void Renderer::Impl::add_samples(const View& view, const PreparedFrame& prepared, Framebuffer& framebuffer,
                                 Watch& watch) {
    Image& image = framebuffer.image_;
    const bool has_color = prepared.frame.channels & channel::color;
    const std::size_t pixels = std::size_t{prepared.frame.width} * prepared.frame.height;
    Channels sums(pixels, std::vector<float>(4));
    const auto take = [&](const Image& drawn) {
        for_chunks(pixels, 1 << 16, 0, [&](std::size_t first, std::size_t last, std::size_t) {
            for (std::size_t c = 0; c < 4; ++c)
                for (std::size_t i = first; i < last; ++i) sums[c][i] += drawn.channels[c][i];
        });
    };
    for (int i = 0; i < view.samples; ++i) {
        const auto from_middle = [](double part) { return part < 0.5 ? part : part - 1; };
        double reversed = 0;  // the binary digits of i in reverse, after the binary point
        for (int bit = 0; bit < 8; ++bit) reversed += (i >> bit & 1) * std::ldexp(1.0, -1 - bit);
        const Sampling sampling{.right = from_middle(static_cast<double>(i) / view.samples),
                                .down = from_middle(reversed)};
        take(i == 0 && has_color ? image : draw_with_edges(view, sampling, channel::color, watch));
        for (std::size_t tile = 0; i > 0 && tile < beside.covered_.size(); ++tile)
            framebuffer.covered_[tile] |= beside.covered_[tile];
    }
    const auto words = std::ranges::find(image.names, "RGBA8");
    const std::span<std::uint32_t> display =
        words == image.names.end() ? std::span<std::uint32_t>()
                                   : image.channels.ids(static_cast<std::size_t>(words - image.names.begin()));
    for_chunks(pixels, 1 << 14, 0, [&](std::size_t first, std::size_t last, std::size_t) {
        for (std::size_t i = first; i < last; ++i) {
            float mean[4];
            for (std::size_t c = 0; c < 4; ++c) {
                mean[c] = sums[c][i] / static_cast<float>(view.samples);
                if (has_color) image.channels[c][i] = mean[c];
            }
            if (!display.empty()) display[i] = word_of(mean);
        }
    });
}

/// A colour for a display, as in display_pixels().
std::uint32_t Renderer::Impl::word_of(const float (&color)[4]) const {
    const double alpha = color[3], weight = alpha > 0 ? alpha : 1;
    std::uint32_t word = std::uint32_t{display_byte(alpha, true)} << 24;
    for (int c = 0; c < 3; ++c)
        word |= std::uint32_t{display_byte(color[c] / weight, scene().display_shading)} << 8 * c;
    return word;
}

/// Adds ghosts that lie before the picture's surfaces, whose distances are `distances`. What lies behind the surfaces
/// is not drawn.
void Renderer::Impl::add_ghosts(const View& view, Framebuffer& framebuffer, std::span<const float> distances,
                                Watch& watch) {
    PreparedFrame prepared = prepare_frame(scene_of(ClaimingRegions::ghosts), view, tolerance);
    kernel::Frame& frame = prepared.frame;
    frame.channels = channel::distance | channel::ids;
    const kernel::ScreenBounds& screen = frame.screen;
    const std::size_t columns = kernel::tiles_across(screen), tiles = columns * kernel::tiles_down(screen);
    if (!frame.every_partition) prepared.ends.assign(tiles, 0);
    for_chunks(prepared.ends.size(), 64, 0, [&](std::size_t tile, std::size_t end, std::size_t) {
        for (; tile < end; ++tile) {
            const std::size_t left = screen.left + tile % columns * TILE, top = screen.top + tile / columns * TILE;
            for (std::size_t y = top; y < std::min<std::size_t>(top + TILE, screen.bottom); ++y)
                for (std::size_t x = left; x < std::min<std::size_t>(left + TILE, screen.right); ++x)
                    prepared.ends[tile] = std::max(prepared.ends[tile], distances[y * frame.width + x]);
        }
    });
    prepare(frame.every_partition, ClaimingRegions::ghosts);
    fit(passed, frame, frame.channels, watch);
    draw(prepared, passed, watch);
    const std::span<const float> found = passed.image_.channels[0];
    const std::span<const std::uint32_t> regions = passed.image_.ids("region");
    const std::span<std::uint32_t> ghosts = framebuffer.image_.channels.ids(framebuffer.image_.channels.size() - 1);
    for (std::size_t i = 0; i < ghosts.size(); ++i)
        if (found[i] < distances[i]) ghosts[i] = regions[i];
    std::ranges::fill(framebuffer.covered_, std::uint8_t{1});
}

void Renderer::Impl::render(const View& view, Framebuffer& framebuffer, const std::function<bool(int)>& coarse,
                            Watch& watch) {
    const auto start = Clock::now();
    take_next();
    const PreparedFrame prepared = prepare_frame(scene_of(ClaimingRegions::shown), view, tolerance);
    const bool every_partition = prepared.frame.every_partition;
    start_call(std::uint64_t{prepared.frame.width} * prepared.frame.height, every_partition,
               static_cast<int>(prepared.frame.width), static_cast<int>(prepared.frame.height));
    const auto fit_picture = [&] {
        fit(framebuffer, prepared.frame, prepared.frame.channels | (view.channels & channel::ghosts), watch);
    };
    if (framebuffer.covered_.empty()) {
        std::future<void> fitting = start_async(fit_picture);
        prepare(every_partition, ClaimingRegions::shown);  // while it compiles, most processors are idle
        fitting.get();
    } else {
        prepare(every_partition, ClaimingRegions::shown);
        fit_picture();
    }
    const bool wants_ghosts = view.channels & channel::ghosts,
               has_ghosts = wants_ghosts && model.impl_->has(State::ghost);
    const bool has_colors = prepared.frame.channels & (channel::color | channel::display),
               has_edges = view.edges && has_colors;
    // Channels that the picture does not have, which edges and ghosts are found by.
    const std::uint32_t more =
        ((has_edges ? edge_channels : 0) | (has_ghosts ? channel::distance : 0)) & ~prepared.frame.channels;
    Image& image = framebuffer.image_;
    bool is_whole = true, are_edges_drawn = false;
    if (const auto of_device = has_edges && !has_ghosts && !coarse ? with_edges(prepared) : std::nullopt) {
        draw(*of_device, framebuffer, watch);
        are_edges_drawn = backend->has_drawn_edges();
    }
    if (!are_edges_drawn) {
        if (coarse || more)
            is_whole = draw_coarse(view, prepared.frame.channels, more, framebuffer, coarse, watch);
        else
            draw(prepared, framebuffer, watch);
    }
    if (wants_ghosts) std::ranges::fill(image.channels.ids(image.channels.size() - 1), 0u);
    if (is_whole) {
        const Image& surfaces = more ? beside.image_ : image;
        if (has_edges && !are_edges_drawn) draw_edges(prepared, surfaces, image);
        if (has_ghosts) add_ghosts(view, framebuffer, surfaces.channel("Z"), watch);
        if (view.samples > 1 && has_colors) {
            prepare(every_partition, ClaimingRegions::shown);  // add_ghosts() left the ghosts' model
            add_samples(view, prepared, framebuffer, watch);
        }
    }
    image.display_values = settings.display_shading;
    image.attributes.clear();
    image.attributes["csgrt:version"] = version();
    image.attributes["csgrt:title"] = model.impl_->source.scene->title;
    image.attributes["csgrt:precision"] = statistics.precision;
    image.attributes["csgrt:method"] = statistics.method;
    image.attributes["csgrt:shading"] = settings.display_shading ? "display values" : "linear light";
    image.attributes["csgrt:scene_hash"] = hexadecimal(Model::Impl::of(model.impl_, ClaimingRegions::shown)->hash);
    if (!scene().warnings.empty()) image.attributes["csgrt:warnings"] = warnings_attribute(scene().warnings);
    describe_camera(prepared, image);
    end_call(start);
}

}  // namespace csgrt
