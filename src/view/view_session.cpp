#include "view_session.hpp"

#include <zlib.h>

#include <algorithm>
#include <array>
#include <bit>
#include <chrono>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <numbers>
#include <thread>
#include <tuple>

#include <csgrt/edit.hpp>
#include <csgrt/error.hpp>
#include <csgrt/scene_io.hpp>

#include "base/parallel.hpp"
#include "base/private_folder.hpp"
#include "form/check.hpp"
#include "form/written_back.hpp"
#include "scene/vector.hpp"
#include "view/false_colors.hpp"

namespace csgrt {

namespace {

constexpr std::size_t most_edited = 16, most_pages = 256, most_pooled = 2;
constexpr std::size_t most_parts = 64;                             ///< of a request
constexpr std::size_t export_bytes_of_pixel = 15 * sizeof(float);  ///< all channels
constexpr double pass_ms = 25;                                ///< what a pass is to take; it may take twice as long
constexpr double first_rays = 65536, telling_rays = 200'000;  ///< of a first pass; of one whose rate tells

bool is_finite(const Box& box) {
    return box.low.x <= box.high.x &&
           std::ranges::all_of(std::array{box.low.x, box.low.y, box.low.z, box.high.x, box.high.y, box.high.z},
                               [](double value) { return std::isfinite(value); });
}

Json to_json(const Box& box) {
    if (!is_finite(box)) return nullptr;
    return {{"low", to_json(box.low)}, {"high", to_json(box.high)}};
}

Json distance(double t) { return std::isfinite(t) ? Json(t) : Json(nullptr); }

Json to_json(const Model& model, std::int64_t solid) {
    if (solid < 0 || solid >= static_cast<std::int64_t>(model.solids().size())) return nullptr;
    const SolidInfo& info = model.solids()[static_cast<std::size_t>(solid)];
    return {{"name", info.name}, {"type", info.type}};
}

/// A region that is open toward the ray's start has no surface there.
bool has_surface(const Pick& pick) { return std::isfinite(pick.t) && dot(pick.normal, pick.normal) > 0; }

/// How far a hit's region goes on along the inward normal; null if it is open, or has no surface there.
Json thickness_of(const Model& model, const Pick& pick) {
    if (!has_surface(pick)) return nullptr;
    constexpr double far = std::numeric_limits<double>::infinity();
    const Ray inward{pick.point, -1.0 * pick.normal};
    Partitions rows;
    model.partitions(std::span(&inward, 1), rows, {}, {.all = {-far, far}});
    const double near = std::max(2 * model.tolerance(), 1e-9 * (1 + std::abs(pick.t)));
    for (std::size_t i = 0; i < rows.region_ids.size(); ++i)
        if (rows.region_ids[i] == pick.region && rows.t_in[i] <= near && rows.t_out[i] > near)
            return distance(rows.t_in[i] < -near ? rows.t_out[i] : rows.t_out[i] - rows.t_in[i]);  // at a cut, or not
    return nullptr;
}

/// A camera with every member that a page has. A camera given by its eye becomes upright.
Json camera_of(const Model& model, const Camera& camera) {
    double azimuth = camera.azimuth, elevation = camera.elevation, size = camera.view_size.value_or(1000);
    Vec3 center = camera.center.value_or(camera.look_at.value_or(Vec3{}));
    const Box& box = model.bounds();
    if (box.low.x <= box.high.x) {
        const RayGrid grid = model.grid_of({.width = 1, .height = 1, .camera = camera});
        const Vec3 ahead = unit(grid.direction);
        const Vec3 middle = camera.center || camera.look_at ? center : 0.5 * (box.low + box.high);
        const double distance = dot(middle - grid.origin, ahead);
        center = grid.origin + distance * ahead;
        size = length(grid.up) * (grid.is_pinhole ? distance / length(grid.direction) : 1);
        if (camera.eye) {
            constexpr double degrees = 180 / std::numbers::pi;
            elevation = std::asin(std::clamp(-ahead.z, -1.0, 1.0)) * degrees;
            azimuth = std::atan2(-ahead.y, -ahead.x) * degrees;
        }
    }
    return {{"azimuth", azimuth},
            {"elevation", elevation},
            {"perspective", camera.perspective},
            {"center", to_json(center)},
            {"view_size", size}};
}

/// Each pixel's difference from the pixel before, compressed. Neighbours are alike, so that the differences are small.
std::string deflated(const std::vector<std::uint32_t>& pixels) {
    const std::size_t size = pixels.size() * sizeof pixels[0];
    std::string differences(size, '\0');
    const auto* const bytes = reinterpret_cast<const unsigned char*>(pixels.data());
    for (std::size_t i = 0; i < size; ++i)
        differences[i] = static_cast<char>(i < 4 ? bytes[i] : bytes[i] - bytes[i - 4]);
    return compressed(differences);
}

std::string little_endian(std::uint32_t value) {
    std::string bytes;
    for (const int shift : {0, 8, 16, 24}) bytes += static_cast<char>(value >> shift & 0xff);
    return bytes;
}

template <class Value>
std::string bytes_of(const Value* values, std::size_t count) {
    static_assert(std::endian::native == std::endian::little);
    return {reinterpret_cast<const char*>(values), count * sizeof(Value)};
}

/// A part with two pixels around it: edges on its border need them.
PixelRectangle with_border(const PixelRectangle& part, const View& view) {
    const int left = std::max(part.left - 2, 0), top = std::max(part.top - 2, 0);
    return {left, top, std::min(part.left + part.width + 2, view.width) - left,
            std::min(part.top + part.height + 2, view.height) - top};
}

/// Copies a part of a picture of `view.part` to its place in the whole, whose memory is made unless it has the
/// picture's form.
void put(const Image& image, const View& view, const PixelRectangle& part, Renderer& renderer, Image& whole) {
    if (whole.width != view.width || whole.height != view.height || whole.names != image.names) {
        View blank = view;  // A picture of nothing is memory alone, and its drawing can be ended.
        blank.part = {};
        blank.samples = 1;
        blank.clip = {{{0, 0, 1}, -1e12}};
        Framebuffer made;
        renderer.render(blank, made);
        whole = made.take();
    }
    const auto size = [](int count) { return static_cast<std::size_t>(count); };
    const std::size_t first_row = size(part.top - view.part->top), first = size(part.left - view.part->left);
    for (std::size_t c = 0; c < whole.channels.size(); ++c)
        for (std::size_t row = 0; row < size(part.height); ++row)
            std::ranges::copy(
                image.channels.ids(c).subspan((first_row + row) * size(image.width) + first, size(part.width)),
                whole.channels.ids(c).subspan((size(part.top) + row) * size(whole.width) + size(part.left)).begin());
}

Json to_json(const RegionInfo& region, const Box& box) {
    Json row = Json::object();  // lists of braces would copy each member twice
    row["region_id"] = region.region_id;
    row["air"] = region.air;
    row["material_id"] = region.material_id;
    row["los"] = region.los;
    row["low"] = is_finite(box) ? to_json(box.low) : Json();
    row["high"] = is_finite(box) ? to_json(box.high) : Json();
    return row;
}

/// The numbers of a described struct.
template <class S>
Json numbers_of(const S& s) {
    Json numbers = Json::object();
    form::for_members(form::of<S>, [&](const auto& member) {
        if constexpr (std::is_arithmetic_v<std::remove_cvref_t<decltype(s.*member.at)>>)
            numbers[std::string(member.key.member)] = s.*member.at;
    });
    return numbers;
}

}  // namespace

std::string compressed(std::string_view bytes) {
    uLongf length = compressBound(bytes.size());
    std::string packed(length, '\0');
    if (compress2(reinterpret_cast<Bytef*>(packed.data()), &length, reinterpret_cast<const Bytef*>(bytes.data()),
                  bytes.size(), Z_BEST_SPEED) != Z_OK)
        throw std::bad_alloc();
    packed.resize(length);
    return packed;
}

ViewSession::ViewSession(Model model, const Settings& settings, ViewerOptions options)
    : options_(std::move(options)),
      methods_(options_text(Settings{.precision = settings.precision, .display_shading = settings.display_shading})),
      current_{.base = model},
      settings_(settings) {
    make_renderer(quick_, model);
    device_ = quick_.renderer->statistics().device;
    pool_.reserve(most_pooled);
}

ViewSession::AnswerMemory::AnswerMemory(ViewSession& from, Budget& budget, std::size_t bytes,
                                        const std::function<bool()>& is_wanted)
    : session_(from), budget_(budget) {
    for (; is_wanted(); std::this_thread::sleep_for(Turns::period)) {
        const std::lock_guard lock(session_.current_mutex_);
        if (budget_.used > 0 && budget_.used + bytes > budget_.most) continue;
        budget_.used += bytes_ = bytes;
        if (session_.pool_.empty()) return;
        std::tie(pixels, whole) = std::move(session_.pool_.back());
        session_.pool_.pop_back();
        return;
    }
}

ViewSession::AnswerMemory::~AnswerMemory() {
    const std::lock_guard lock(session_.current_mutex_);
    budget_.used -= bytes_;
    const std::size_t size = static_cast<std::size_t>(whole.width) * static_cast<std::size_t>(whole.height);
    if (sizeof pixels[0] * (pixels.capacity() + size * whole.channels.size()) <= session_.answers_.most &&
        session_.pool_.size() < most_pooled)
        session_.pool_.emplace_back(std::move(pixels), std::move(whole));
}

Json ViewSession::model() const {
    std::unique_lock lock(current_mutex_);
    const Model model = current_.base;
    const std::string error = current_.error, device = device_;
    const std::uint64_t generation = current_.generation;
    lock.unlock();

    // Few looks differ, and a look is told once.
    Json paths = Json::array(), looks = Json::array(), look_of = Json::array(), warnings = Json::array();
    std::map<std::tuple<State, double, double, double>, std::size_t> known;
    for (const RegionInfo& region : model.regions()) {
        const Vec3& color = region.color;
        const auto [look, is_new] = known.try_emplace({region.state, color.x, color.y, color.z}, known.size());
        if (is_new) looks.push_back({{"state", name_of(state_names, region.state)}, {"color", to_json(color)}});
        paths.push_back(region.path);
        look_of.push_back(look->second);
    }
    for (const Warning& warning : model.warnings()) {
        const Place& place = warning.place;
        warnings.push_back(
            {{"text", warning.reason},
             {"object", warning.object},
             {"place",
              place.file.empty() || place.line == 0 ? place.pointer : place.file + ":" + std::to_string(place.line)},
             {"count", warning.count}});
    }
    const Scene scene = model.scene();
    return {{"generation", generation},
            {"name", options_.name},
            {"title", scene.title},
            {"units", scene.units},
            {"unit_length", scene.unit_length},
            {"command", options_.command},
            {"device", device},
            {"bounds", to_json(model.bounds())},
            {"view",
             {{"camera", camera_of(model, scene.camera)},
              {"clip", Json::array()},
              {"looks", Json::array()},
              {"show", "color"},
              {"edges", true},
              {"light", "studio"}}},
            {"paths", std::move(paths)},
            {"own_looks", std::move(looks)},
            {"look_of", std::move(look_of)},
            {"warnings", std::move(warnings)},
            {"exr", bool(options_.write_exr)},
            {"error", error.empty() ? Json(nullptr) : Json(error)}};
}

Json ViewSession::status() const {
    const std::lock_guard lock(current_mutex_);
    return {{"generation", current_.generation},
            {"error", current_.error.empty() ? Json(nullptr) : Json(current_.error)},
            {"device", device_}};
}

Json ViewSession::parts(const Request& request) const {
    std::unique_lock lock(current_mutex_);
    const Model model = current_.base;
    const std::uint64_t generation = current_.generation;
    lock.unlock();
    if (request.number("generation") != static_cast<double>(generation))
        throw Error(Status::usage, "the model has changed: ask again");
    const std::vector<Request> wanted = request.objects("parts");
    if (wanted.size() > most_parts) throw Error(Status::usage, "parts: expected at most " + std::to_string(most_parts));
    Json rows = Json::array();
    for (const Request& part : wanted) {
        const auto ranges = part.ranges("regions", model.regions().size());
        constexpr double far = std::numeric_limits<double>::infinity();
        Vec3 low{far, far, far}, high{-far, -far, -far};
        for (const auto& [first, last] : ranges)
            for (std::size_t i = first; i < last; ++i) {
                const Box& own = model.regions()[i].bounds;
                if (!is_finite(own)) continue;
                low = {std::min(low.x, own.low.x), std::min(low.y, own.low.y), std::min(low.z, own.low.z)};
                high = {std::max(high.x, own.high.x), std::max(high.y, own.high.y), std::max(high.z, own.high.z)};
            }
        rows.push_back(ranges.empty() ? Json() : to_json(model.regions()[ranges.front().first], {low, high}));
    }
    return {{"rows", std::move(rows)}};
}

ViewSession::EditedModel ViewSession::model_with(const std::vector<Look>& looks) {
    std::string key;
    for (const Look& look : looks) {
        key += look.path + '\n';
        if (look.state) key += name_of(state_names, *look.state);
        if (look.color) key += bytes_of(&*look.color, 1);
        key += '\n';
    }
    std::unique_lock lock(current_mutex_);
    const std::uint64_t generation = current_.generation;
    if (looks.empty()) return {current_.base, generation};
    auto& edited = current_.edited;
    if (const auto found = std::ranges::find(edited, key, &std::pair<std::string, Model>::first);
        found != edited.end()) {
        edited.splice(edited.begin(), edited, found);
        return {found->second, generation};
    }
    Edit edit(current_.base);
    for (const Look& look : looks) {
        if (current_.base.regions(look.path).empty()) continue;  // the region was in another version of the file
        if (look.state) edit.set_state(look.path, *look.state);
        if (look.color) edit.set_color(look.path, *look.color);
    }
    edited.emplace_front(std::move(key), edit.commit());
    if (edited.size() > most_edited) edited.pop_back();
    return {edited.front().second, generation};
}

void ViewSession::make_renderer(Drawer& drawer, const Model& model) {
    Settings own = settings_;
    own.progress = [&drawer](double) { return !drawer.wanted || (*drawer.wanted)(); };
    drawer.renderer.emplace(model, own);
}

bool ViewSession::draw_with(Drawer& drawer, const Model& model, const std::function<bool()>& is_wanted,
                            const std::function<void(Renderer&)>& draw) {
    const Turns::Turn turn(drawer.turns, is_wanted);
    if (!turn) return false;
    struct Wanted {
        const std::function<bool()>*& by_renderer;
        ~Wanted() { by_renderer = nullptr; }
    } wanted{drawer.wanted = &is_wanted};
    try {
        if (drawer.renderer)
            drawer.renderer->set_model(model);
        else
            make_renderer(drawer, model);
        draw(*drawer.renderer);
    } catch (const Error& error) {
        if (error.status() != Status::interrupted) throw;
        return false;
    }
    const std::lock_guard current(current_mutex_);
    device_ = drawer.renderer->statistics().device;
    return true;
}

void ViewSession::note_picture(double rays, double ms) {
    // A picture of background alone tells little: the number grows by steps.
    if (rays > telling_rays || ms > pass_ms)
        rays_of_pass_ = std::min(rays * pass_ms / std::max(ms, 0.01), 2 * rays_of_pass_);
}

bool ViewSession::draw_in_passes(const Model& model, View view, const std::function<bool()>& is_wanted, Image& whole,
                                 double& ms) {
    const double all = static_cast<double>(view.width) * view.height * view.samples;
    PixelRectangle part;
    double rays = std::min(rays_of_pass_.load(), first_rays);  // of the next pass
    const auto side = [&](int across, int left) {
        constexpr int tile = 8;  // a Renderer draws these squares whole
        return std::min(left, std::max(tile, static_cast<int>(rays / view.samples / across) / tile * tile));
    };
    for (; part.top < view.height; part.top += part.height) {
        part.height = side(view.width, view.height - part.top);
        for (part.left = 0; part.left < view.width; part.left += part.width) {
            part.width = side(part.height, view.width - part.left);
            view.part = view.edges ? with_border(part, view) : part;
            double took = 0;
            if (!draw_with(slow_, model, is_wanted, [&](Renderer& renderer) {
                    renderer.render(view, slow_.framebuffer);
                    took = renderer.statistics().ms.frame;
                    put(slow_.framebuffer.image(), view, part, renderer, whole);
                }))
                return false;
            ms += took;
            const double drawn = static_cast<double>(part.width) * part.height * view.samples;
            // Where there is only background a pass is quick: what comes next may not be.
            rays = std::min({drawn * pass_ms / std::max(took, 0.01), 4 * drawn, 2 * rays_of_pass_});
        }
    }
    note_picture(all, ms);
    return true;
}

void ViewSession::frame(const Request& request, const Client& client) {
    PageView page = read_page_view(request);
    const auto number = static_cast<std::uint64_t>(request.count("number", 0, std::numeric_limits<int>::max()));
    const bool deflates = request.text("encoding") == "deflate";
    const auto newest = [&] {
        const std::lock_guard lock(current_mutex_);
        if (pages_.size() > most_pages) pages_.clear();  // a frame that is being drawn keeps its page's entry
        auto& of_page = pages_[request.text("page").substr(0, 64)];
        if (!of_page) of_page = std::make_shared<std::atomic<std::uint64_t>>();
        *of_page = std::max<std::uint64_t>(*of_page, number);
        return of_page;
    }();
    const std::function<bool()> is_newest = [&] { return *newest == number && client.is_wanted(); };
    const auto send = [&](const Json& head, std::string_view pixels = {}) {
        const std::string text = head.dump(-1, ' ', false, Json::error_handler_t::replace);
        client.send({little_endian(static_cast<std::uint32_t>(text.size())), text, pixels}, 0);
    };
    const Json cancelled = {{"cancelled", true}};
    try {
        const std::size_t count =
            static_cast<std::size_t>(page.view.width) * static_cast<std::size_t>(page.view.height);
        const double rays = static_cast<double>(count) * page.view.samples;
        // A page waits for its picture of one ray a pixel: passes would make it wait longer.
        const bool is_slow = rays > (page.view.samples > 1 ? 2 : 8) * rays_of_pass_;
        AnswerMemory memory(*this, answers_, sizeof(std::uint32_t) * count * ((deflates ? 3 : 1) + (is_slow ? 2 : 0)),
                            is_newest);
        if (!memory) return send(cancelled);
        const auto [model, generation] = model_with(page.looks);
        const bool has_ghosts =
            std::ranges::any_of(model.regions(), [](const RegionInfo& region) { return region.state == State::ghost; });
        page.view.channels = channels_for(page.show, has_ghosts);
        Json head = {{"number", number},           {"width", page.view.width},
                     {"height", page.view.height}, {"samples", page.view.samples},
                     {"generation", generation},   {"encoding", deflates ? "deflate" : "raw"}};
        std::vector<bool> selected(model.regions().size());
        if (request.has("selected"))
            for (const auto& [first, last] : request.ranges("selected", selected.size()))
                std::fill(selected.begin() + static_cast<std::ptrdiff_t>(first),
                          selected.begin() + static_cast<std::ptrdiff_t>(last), true);
        std::vector<std::uint32_t>& pixels = memory.pixels;
        pixels.resize(count);
        std::optional<std::pair<double, double>> range;
        double ms = 0;
        if (is_slow) {
            if (!draw_in_passes(model, page.view, is_newest, memory.whole, ms)) return send(cancelled);
            range = paint(memory.whole, page.show, selected, pixels);
        } else if (!draw_with(quick_, model, is_newest, [&](Renderer& renderer) {
                       renderer.render(page.view, quick_.framebuffer);
                       ms = renderer.statistics().ms.frame;
                       note_picture(rays, ms);
                       range = paint(quick_.framebuffer.image(), page.show, selected, pixels);
                   })) {
            return send(cancelled);
        }
        head["draw_ms"] = ms;
        if (range) head["range"] = {range->first, range->second};
        head["device"] = status().at("device");
        if (deflates) return send(head, deflated(pixels));
        send(head, {reinterpret_cast<const char*>(pixels.data()), 4 * pixels.size()});
    } catch (const Error& error) {
        send({{"error", error.what()}});
    } catch (const std::bad_alloc&) {
        send({{"error", "not enough memory for this picture"}});
    }
}

Json ViewSession::pick(const Request& request) {
    const PageView page = read_page_view(request);
    const auto [model, generation] = model_with(page.looks);
    const int x = request.count("x", 0, page.view.width - 1), y = request.count("y", 0, page.view.height - 1);
    const Pick pick = model.pick(page.view, x, y);
    Json answer = {{"region", pick.region < 0 ? Json(nullptr) : Json(pick.region)}, {"generation", generation}};
    if (pick.region >= 0) answer["point"] = to_json(pick.point);
    if (request.flag("brief")) return answer;
    answer["solid"] = to_json(model, pick.solid);
    if (pick.solid >= 0)
        if (const std::optional<Shape> shape = model.solid(static_cast<std::size_t>(pick.solid)))
            answer["solid"]["shape"] = Json::parse(json_text(*shape));
    if (pick.region >= 0)
        answer.update({{"t", distance(pick.t)},
                       {"normal", has_surface(pick) ? to_json(pick.normal) : Json()},
                       {"thickness", thickness_of(model, pick)}});
    Json partitions = Json::array(), overlaps = Json::array();
    for (const Partition& part : pick.along.partitions)
        partitions.push_back({{"region", part.region},
                              {"in", distance(part.in)},
                              {"out", distance(part.out)},
                              {"in_solid", to_json(model, part.in_solid)},
                              {"out_solid", to_json(model, part.out_solid)},
                              {"in_normal", to_json(part.in_normal)},
                              {"out_normal", to_json(part.out_normal)}});
    for (const Overlap& overlap : pick.along.overlaps)
        overlaps.push_back(
            {{"in", distance(overlap.in)}, {"out", distance(overlap.out)}, {"regions", overlap.regions}});
    answer.update({{"ray", {{"origin", to_json(pick.ray.origin)}, {"direction", to_json(pick.ray.direction)}}},
                   {"partitions", std::move(partitions)},
                   {"overlaps", std::move(overlaps)},
                   {"shoot", shoot_command(pick.ray)}});
    return answer;
}

std::string ViewSession::shoot_command(const Ray& ray) const {
    const auto& [o, d] = ray;
    std::string words;
    for (const double value : {o.x, o.y, o.z, d.x, d.y, d.z}) words += (words.empty() ? "" : " ") + shortest(value);
    return "printf '" + words + "\\n' | csgrt shoot " + options_.command + " --rays -";
}

std::string ViewSession::picture_command(const PageView& page) const {
    View written = page.view;
    written.every_partition = true;  // in a command, the file's type chooses whether to compute them
    return "csgrt " + options_.command + methods_ + drawing_options(written, page.looks);
}

Json ViewSession::command(const Request& request) const {
    return {{"command", picture_command(read_page_view(request)) + " -o view.png"}};
}

// The Renderer computes the slice, because it can be stopped.
void ViewSession::slice(const Request& request, const Client& client) {
    const Slice slice = read_slice(request);
    const Model model = model_with(read_page_view(request).looks).model;
    const AnswerMemory memory(
        *this, answers_, sizeof(std::int32_t) * static_cast<std::size_t>(slice.width) * slice.height, client.is_wanted);
    Array<std::int32_t> ids;
    if (!memory || !draw_with(quick_, model, client.is_wanted, [&](Renderer& by) { by.slice(slice, ids); })) return;
    client.send({{reinterpret_cast<const char*>(ids.data()), ids.size() * sizeof ids.data()[0]}}, 0);
}

void ViewSession::exr(const Request& request, const Client& client) {
    if (!options_.write_exr) throw Error(Status::usage, "this csgrt was built without OpenImageIO and writes no EXR");
    PageView page = read_page_view(request);
    page.view.every_partition = true;
    page.view.channels = channel::all;
    const std::size_t pixels = static_cast<std::size_t>(page.view.width) * static_cast<std::size_t>(page.view.height);
    const AnswerMemory memory(*this, exports_, export_bytes_of_pixel * pixels, client.is_wanted);
    const Model model = model_with(page.looks).model;
    Image image;
    double ms = 0;
    if (!memory || !draw_in_passes(model, page.view, client.is_wanted, image, ms) ||
        !draw_with(slow_, model, client.is_wanted, [&](Renderer& renderer) {
            renderer.name_pixels(image);
            renderer.name_overlaps(page.view, image);
        }))
        return;
    image.attributes["csgrt:command"] = picture_command(page);
    const PrivateFolder folder;
    const std::string path = folder / "view.exr";
    try {
        options_.write_exr(image, path, [&](double) { return client.is_wanted(); });
    } catch (const Error& error) {
        if (error.status() != Status::interrupted) throw;
        return;
    }
    image = {};
    client.send({}, std::filesystem::file_size(path));
    std::ifstream in(path, std::ios::binary);
    for (std::vector<char> block(1 << 18); in.read(block.data(), std::ssize(block)), in.gcount() > 0;)
        client.send_more({block.data(), static_cast<std::size_t>(in.gcount())});
}

void ViewSession::check(const Request& request, const Client& client) {
    const CheckRequest wanted{.min_depth = request.number("min_depth")};
    const Turns::Turn turn(checks_, client.is_wanted);
    if (!turn) return;
    const Model model = model_with({}).model;
    Settings own = settings_;
    own.threads = (thread_count(own.threads) + 1) / 2;  // frames have the others
    own.progress = [&client](double) { return client.is_wanted(); };
    const CheckResult result = Checker(model, own).check(wanted);
    if (!result.is_complete) return;
    Json answer = numbers_of(result);
    answer["overlaps"] = Json::array();
    for (const FoundOverlap& overlap : result.overlaps) {
        Json row = numbers_of(overlap);
        row.update({{"link", link_of(overlap, model)}, {"shoot", shoot_command(overlap.ray)}});
        answer["overlaps"].push_back(std::move(row));
    }
    client.send({answer.dump(-1, ' ', false, Json::error_handler_t::replace)}, 0);
}

void ViewSession::load_again() {
    try {
        const Model model = options_.load();
        const std::lock_guard lock(current_mutex_);
        current_ = {.base = model, .generation = current_.generation + 1};
    } catch (const std::bad_alloc&) {
        set_error("not enough memory to load the model again");
    } catch (const std::exception& failure) {
        set_error(failure.what());
    }
}

void ViewSession::set_error(const std::string& error) {
    const std::lock_guard lock(current_mutex_);
    current_.error = error;
}

}  // namespace csgrt
