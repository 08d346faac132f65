#include "live_scene.hpp"

#include <algorithm>

namespace csgrt::python {
namespace {

constexpr std::pair<const char*, State> state_names[] = {
    {"shown", State::shown}, {"ghost", State::ghost}, {"hidden", State::hidden}};
constexpr std::pair<const char*, Operator> operator_names[] = {{"union", Operator::union_},
                                                               {"intersection", Operator::intersection},
                                                               {"difference", Operator::difference},
                                                               {"xor", Operator::xor_}};

template <class Value, std::size_t count>
Value value_of(const std::pair<const char*, Value> (&names)[count], const std::string& what, const std::string& given) {
    std::string known;
    for (const auto& [name, value] : names) {
        if (given == name) return value;
        known += std::string(known.empty() ? "" : ", ") + name;
    }
    throw Error(Status::usage, what + " is one of " + known + ", not " + given);
}

/// Ctrl-C ends a call: the handler of the signal throws, and the call ends with it.
bool go_on(double done) {
    if (done <= 0 || done >= 1) return true;  // short calls do not wait for the GIL
    nb::gil_scoped_acquire locked;
    return PyErr_Occurred() == nullptr && PyErr_CheckSignals() == 0;
}

Matrix matrix_of(const Matrices& given) {
    Matrix matrix;
    std::copy_n(given.data(), 16, matrix.begin());
    return matrix;
}

RayRanges ranges_of(const RayRange& range, const std::optional<Doubles>& ranges) {
    RayRanges all{.all = range};
    if (ranges) all.each = list_of<RayRange>(*ranges);
    return all;
}

/// The first object of a kind in a source that Python made for one edit.
template <class Kind>
const Kind& first(const Scene& source) {
    for (const Object& object : source.objects)
        if (const auto* found = std::get_if<Kind>(&object)) return *found;
    throw Error(Status::usage, "the source has no such object");
}

}  // namespace

LiveScene::LiveScene(Scene& source, std::vector<std::string> objects, const Settings& settings)
    : settings_(settings),
      objects_(std::move(objects)),
      units_(source.units),
      title_(source.title),
      camera_(source.camera) {
    settings_.progress = go_on;
    nb::gil_scoped_release unlocked;
    renderer_.emplace(std::move(source), objects_, settings_);
}

void LiveScene::require_own_process() const {
    if (getpid() != process_)
        throw Error(Status::usage, "the scene was loaded before this process was forked: load it again");
}

template <class Call>
void LiveScene::run(const Call& call) {
    require_own_process();
    if (computes_ == std::this_thread::get_id())
        throw Error(Status::usage, "a signal handler asks the scene whose call it interrupts");
    {
        nb::gil_scoped_release unlocked;
        const std::lock_guard lock(computing_);
        struct Mark {
            std::atomic<std::thread::id>& mark;
            ~Mark() { mark = std::thread::id(); }
        } mark{computes_};
        computes_ = std::this_thread::get_id();
        call(*renderer_);
    }
    if (PyErr_Occurred()) throw nb::python_error();
}

template <class Call>
void LiveScene::edit(const Call& call) {
    require_own_process();
    nb::gil_scoped_release unlocked;
    const std::lock_guard lock(editing_);
    if (!edit_) edit_.emplace(renderer_->model());
    call(*edit_);
}

// ---- What is known ----

nb::list LiveScene::region_rows() const {
    nb::list rows;
    const Model model = this->model();
    for (const RegionInfo& r : model.regions()) {
        const char* state = "";
        for (const auto& [name, value] : state_names)
            if (value == r.state) state = name;
        rows.append(
            nb::make_tuple(rows.size(), r.path, r.material_id, r.bounds, r.color, state, r.region_id, r.air, r.los));
    }
    return rows;
}

nb::list LiveScene::solid_rows() const {
    nb::list rows;
    const Model model = this->model();
    for (const SolidInfo& s : model.solids()) rows.append(nb::make_tuple(s.name, s.type, s.piece));
    return rows;
}

nb::list LiveScene::warning_rows() {
    std::vector<Warning> warnings;
    run([&](Renderer& renderer) { warnings = renderer.warnings(); });
    nb::list rows;
    for (const Warning& w : warnings)
        rows.append(nb::make_tuple(w.object, place_row(w.place), w.reason, w.count, w.appearance, format(w)));
    return rows;
}

// ---- Rays and points ----

nb::dict LiveScene::partitions(const Doubles& rays, RayRange range, const std::optional<Doubles>& ranges,
                               Fields fields) {
    // What keeps the answer gives its memory back to the scene, if there is one yet.
    struct Held {
        std::weak_ptr<Spare> scene;
        std::unique_ptr<Partitions> answer;
        ~Held() {
            const auto spare = scene.lock();
            if (!spare) return;
            const std::lock_guard lock(spare->mutex);
            if (!spare->answer) spare->answer = std::move(answer);
        }
    };
    std::unique_ptr<Held> held(new Held{spare_, spare_->take()});
    Partitions& p = *held->answer;
    run([&](Renderer& renderer) { renderer.partitions(list_of<Ray>(rays), p, fields, ranges_of(range, ranges)); });
    const nb::capsule kept = keeper(held);
    nb::dict arrays;
    arrays["ray_splits"] = array(p.ray_splits, kept);
    arrays["region_ids"] = array(p.region_ids, kept);
    arrays["t_in"] = array(p.t_in, kept);
    arrays["t_out"] = array(p.t_out, kept);
    if (fields.solids) {
        arrays["in_solids"] = array(p.in_solids, kept);
        arrays["out_solids"] = array(p.out_solids, kept);
    }
    if (fields.normals) {
        arrays["in_normals"] = array(p.in_normals, kept);
        arrays["out_normals"] = array(p.out_normals, kept);
    }
    if (fields.overlaps) {
        arrays["overlap_splits"] = array(p.overlap_splits, kept);
        arrays["overlap_t_in"] = array(p.overlap_t_in, kept);
        arrays["overlap_t_out"] = array(p.overlap_t_out, kept);
        arrays["overlap_region_splits"] = array(p.overlap_region_splits, kept);
        arrays["overlap_region_ids"] = array(p.overlap_region_ids, kept);
    }
    return arrays;
}

nb::dict LiveScene::cast_rays(const Doubles& rays, RayRange range, const std::optional<Doubles>& ranges,
                              Fields fields) {
    auto answer = std::make_unique<Hits>();
    run([&](Renderer& renderer) { renderer.cast_rays(list_of<Ray>(rays), *answer, fields, ranges_of(range, ranges)); });
    Hits& hits = *answer;
    const nb::capsule kept = keeper(answer);
    const Shape shape = leading(rays);
    nb::dict arrays;
    arrays["t_hit"] = array(hits.t_hit.data(), shape, kept);
    arrays["region_ids"] = array(hits.region_ids.data(), shape, kept);
    if (fields.solids) arrays["solid_ids"] = array(hits.solid_ids.data(), shape, kept);
    if (fields.normals) arrays["normals"] = array(hits.normals.data(), shape, kept);
    return arrays;
}

nb::object LiveScene::occluded(const Doubles& rays, RayRange range, const std::optional<Doubles>& ranges) {
    auto answer = std::make_unique<Array<std::uint8_t>>();
    run([&](Renderer& renderer) { renderer.occluded(list_of<Ray>(rays), *answer, ranges_of(range, ranges)); });
    auto* const data = reinterpret_cast<bool*>(answer->data());  // 0 and 1, as bool has them
    return array(data, leading(rays), keeper(answer));
}

nb::object LiveScene::region_at(const Doubles& points) {
    auto answer = std::make_unique<Array<std::int32_t>>();
    run([&](Renderer& renderer) { renderer.region_at(list_of<Vec3>(points), *answer); });
    std::int32_t* const data = answer->data();
    return array(data, leading(points), keeper(answer));
}

nb::object LiveScene::slice(const Vec3& normal, double offset, std::pair<int, int> pixels, bool hidden) {
    auto answer = std::make_unique<Array<std::int32_t>>();
    csgrt::Slice cut;
    run([&](Renderer& renderer) {
        cut = slice_of(renderer.bounds(), normal, offset, pixels.first, pixels.second);
        cut.hidden = hidden;
        renderer.slice(cut, *answer);
    });
    std::int32_t* const data = answer->data();
    return array(data, {std::size_t(cut.height), std::size_t(cut.width)}, keeper(answer));
}

// ---- Views ----

nb::tuple LiveScene::render(const View& view) {
    auto image = std::make_unique<Image>();
    run([&](Renderer& renderer) { *image = renderer.render(view); });
    nb::list names;
    for (const std::string& name : image->names) names.append(name);
    float* const data = image->channels[0].data();  // all channels are one piece of memory
    const Shape shape = {image->channels.size(), std::size_t(image->height), std::size_t(image->width)};
    return nb::make_tuple(array(data, shape, keeper(image)), names);
}

nb::tuple LiveScene::pick(const View& view, int column, int row) {
    Pick found;
    run([&](Renderer& renderer) { found = renderer.model().pick(view, column, row); });
    nb::list along;
    for (const Partition& p : found.along.partitions) along.append(nb::make_tuple(p.region, p.in, p.out));
    return nb::make_tuple(found.region, found.solid, found.t, found.point, found.normal,
                          nb::make_tuple(found.ray.origin, found.ray.direction), along);
}

nb::object LiveScene::rays_of(const View& view) {
    auto rays = std::make_unique<std::vector<Ray>>();
    run([&](Renderer& renderer) { *rays = renderer.rays_of(view); });
    Ray* const data = rays->data();
    return array(data, {std::size_t(view.height), std::size_t(view.width)}, keeper(rays));
}

nb::dict LiveScene::verify(std::size_t rays, std::uint64_t seed) {
    Verification result;
    run([&](Renderer& renderer) {
        Verifier verifier(renderer.model().scene(), objects_, settings_);
        verifier.shoot(verifier.sample(camera_, rays, seed));
        result = verifier.result();
    });
    nb::dict figures;
    figures["passed"] = result.passed();
    figures["device"] = result.device;
    figures["rays"] = result.rays;
    figures["hits"] = result.hits;
    figures["decided"] = result.decided;
    figures["ties"] = result.ties;
    figures["wrong"] = result.wrong;
    figures["bit_differences"] = result.bit_differences;
    figures["ends"] = result.ends;
    figures["farthest_mm"] = result.farthest.millimetres;
    figures["worst_ulps"] = result.worst.ulps;
    return figures;
}

// ---- Edits ----

void LiveScene::set_color(const std::string& path, const Vec3& color) {
    edit([&](Edit& e) { e.set_color(path, color); });
}
void LiveScene::set_finish(const std::string& path, const Scene& source) {
    edit([&](Edit& e) { e.set_finish(path, first<Combination>(source).finish.value_or(Finish{})); });
}
void LiveScene::set_state(const std::string& path, const std::string& state) {
    edit([&](Edit& e) { e.set_state(path, value_of(state_names, "a state", state)); });
}
void LiveScene::set_matrix(const std::string& path, const Matrices& matrix, bool all) {
    edit([&](Edit& e) { e.set_matrix(path, matrix_of(matrix), all ? Edit::Share::all : Edit::Share::alone); });
}
void LiveScene::replace(const std::string& solid, const Scene& source) {
    edit([&](Edit& e) { e.replace(solid, first<Solid>(source).shape); });
}
void LiveScene::add(const Scene& source, const std::string& top) {
    edit([&](Edit& e) {
        // The last is the one whose name the caller chose: if that is taken, nothing is added.
        for (std::size_t i = source.objects.size(); i-- > 0;)
            e.add(source.objects[i], name_of(source.objects[i]) == top);
    });
}
void LiveScene::add_leg(const std::string& combination, const std::string& op, const std::string& object,
                        const Matrices& matrix) {
    edit([&](Edit& e) { e.add(combination, value_of(operator_names, "an operator", op), object, matrix_of(matrix)); });
}
void LiveScene::remove(const std::string& path) {
    edit([&](Edit& e) { e.remove(path); });
}

void LiveScene::commit() {
    edit([&](Edit& e) {
        renderer_->set_model(e.commit());
        edit_.reset();
    });
}

void LiveScene::discard() {
    edit([&](Edit&) { edit_.reset(); });
}

void LiveScene::save(const std::string& path) {
    const Model model = this->model();
    nb::gil_scoped_release unlocked;
    save_scene(model.scene(), path);
}

void bind_scene(nb::module_& module) {
    using namespace nb::literals;
    const auto range = [](double near, double far) { return RayRange{near, far}; };
    nb::class_<LiveScene>(module, "Scene", "What csgrt.Scene is made of.")
        .def(nb::init<Scene&, std::vector<std::string>, const Settings&>(), "source"_a, "objects"_a, "settings"_a)
        .def("region_rows", &LiveScene::region_rows)
        .def("solid_rows", &LiveScene::solid_rows)
        .def("warning_rows", &LiveScene::warning_rows)
        .def_prop_ro("box", &LiveScene::bounds)
        .def_prop_ro("tolerance", &LiveScene::tolerance, "Millimetres: ends of segments closer than this are one")
        .def_prop_ro("units", &LiveScene::units, "The unit of the file. All values here are millimetres")
        .def_prop_ro("title", &LiveScene::title, "The file's title")
        .def_prop_ro("camera", &LiveScene::camera, nb::rv_policy::copy, "A copy of the scene's own camera")
        .def("partition_arrays",
             [range](LiveScene& scene, const Doubles& rays, double near, double far, std::optional<Doubles> ranges,
                     bool solids, bool normals, bool overlaps, bool hidden) {
                 return scene.partitions(rays, range(near, far), ranges, {solids, normals, overlaps, hidden});
             })
        .def("hit_arrays",
             [range](LiveScene& scene, const Doubles& rays, double near, double far, std::optional<Doubles> ranges,
                     bool solids, bool normals) {
                 return scene.cast_rays(rays, range(near, far), ranges, {.solids = solids, .normals = normals});
             })
        .def("occluded",
             [range](LiveScene& scene, const Doubles& rays, double near, double far, std::optional<Doubles> ranges) {
                 return scene.occluded(rays, range(near, far), ranges);
             })
        .def("regions_at", &LiveScene::region_at)
        .def("slice", &LiveScene::slice, "normal"_a, "offset"_a, "pixels"_a = std::pair(512, 512), "hidden"_a = true,
             "Which region holds each pixel of a cut by the plane n . p = offset (n: the normal's unit vector).\n\n"
             "pixels: (width, height), square, over the whole model. hidden=False leaves out what pictures do not show."
             "\nReturns (height, width) int32: ids in regions; -1 nothing, -2 several that overlap. Seen from the side "
             "to which the normal points, z up, or y up where the normal is z.\nRaises csgrt.Error (usage).")
        .def("planes", &LiveScene::render)
        .def("pick_row", &LiveScene::pick)
        .def("view_rays", &LiveScene::rays_of)
        .def("verify", &LiveScene::verify, "rays"_a = 10'000, "seed"_a = 1,
             "Judges a sample of rays, on the device and on the reference, by 113-bit arithmetic.\n\n"
             "Returns a dict: passed (no decided ray is wrong, no bit differs), rays, hits, decided, ties, wrong, "
             "bit_differences, ends,\nfarthest_mm, worst_ulps (errors of distances), device. Raises csgrt.Error.")
        .def("set_color", &LiveScene::set_color)
        .def("set_finish", &LiveScene::set_finish)
        .def("set_state", &LiveScene::set_state)
        .def("set_matrix", &LiveScene::set_matrix)
        .def("replace_shape", &LiveScene::replace)
        .def("add_objects", &LiveScene::add)
        .def("join", &LiveScene::add_leg)
        .def("remove", &LiveScene::remove, "path"_a,
             "Removes the last leg of a path, for all that share the combination. Takes effect with commit().")
        .def("commit_edits", &LiveScene::commit)
        .def("discard", &LiveScene::discard, "Forgets the edits since the last commit().")
        .def("save_json", &LiveScene::save);
}

}  // namespace csgrt::python
