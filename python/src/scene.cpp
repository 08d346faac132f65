// A scene in Python: a Renderer with its Model, and the edits that wait for commit().
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <mutex>
#include <optional>
#include <thread>

#include <form/measure.hpp>
#include <form/written_back.hpp>

#include "values.hpp"

namespace csgrt::python {
namespace {

const auto joining = std::span(operator_names).subspan(1, 4);  ///< operators that join an object to a tree

Error usage(const std::string& text) { return {Status::usage, text}; }

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

/// A pool of one answer: memory whose arrays are gone, for the next call. New memory takes a twentieth of a call.
struct AnswerPool {
    std::mutex mutex = {};
    std::unique_ptr<Partitions> answer = {};
    std::unique_ptr<Partitions> take() {
        const std::lock_guard lock(mutex);
        return answer ? std::move(answer) : std::make_unique<Partitions>();
    }
};

/// Calls of several threads wait for each other, and none of them holds the GIL meanwhile.
class LiveScene {
public:
    /// Takes what is in `source`.
    LiveScene(Scene& source, std::vector<std::string> objects, const Settings& settings)
        : settings_(settings),
          objects_(std::move(objects)),
          units_(source.units),
          title_(source.title),
          camera_(source.camera) {
        settings_.progress = go_on;
        nb::gil_scoped_release unlocked;
        renderer_.emplace(std::move(source), objects_, settings_);
    }
    /// Draws the same model, which both share. What waits and what can be undone stays with the other.
    explicit LiveScene(const LiveScene& other)
        : settings_(other.settings_),
          objects_(other.objects_),
          units_(other.units_),
          title_(other.title_),
          camera_(other.camera_) {
        const Model model = other.model();
        nb::gil_scoped_release unlocked;
        renderer_.emplace(model, settings_);
    }

    const std::string& units() const { return units_; }
    const std::string& title() const { return title_; }
    const Camera& camera() const { return camera_; }
    const Settings& settings() const { return settings_; }
    const std::shared_ptr<AnswerPool>& answer_pool() const { return answer_pool_; }

    /// The paths of what is rendered, if the caller has named some objects.
    std::vector<std::string> rendered() const {
        std::vector<std::string> paths;
        if (!objects_.empty())
            for (const ChildInfo& child : model().children()) paths.push_back(child.path);
        return paths;
    }

    /// A Model is shared and never changes.
    Model model() const {
        require_own_process();
        return renderer_->model();
    }

    /// Runs what computes. An exception that a signal has left is Python's to see.
    template <class Call>
    void run(const Call& call) {
        require_own_process();
        if (computes_ == std::this_thread::get_id()) throw own_call();
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

    /// Runs what answers `count` rays or points, by a Renderer or a Model. A Model answers few of them in a tenth of
    /// the time, on this thread: no other has to look for Ctrl-C. The bits are the same.
    template <class Call>
    void trace(std::size_t count, const Call& call) {
        constexpr std::size_t few = 64;
        const bool has_model_s_bits = settings_.precision == Settings().precision && settings_.check == 0;
        if (count > few || !has_model_s_bits || settings_.reference) return run(call);
        const Model few_rays = model();
        nb::gil_scoped_release unlocked;
        call(few_rays);
    }

    template <class Call>
    void edit(const Call& call) {
        require_own_process();
        nb::gil_scoped_release unlocked;
        const std::lock_guard lock(editing_);
        const bool is_first = !edit_;
        if (is_first) edit_.emplace(renderer_->model());
        try {
            call(*edit_);
        } catch (...) {
            if (is_first) edit_.reset();  // nothing waits
            throw;
        }
    }
    void commit() {
        require_own_process();
        const auto no_measure = end_of_measure();
        nb::gil_scoped_release unlocked;
        const std::lock_guard lock(editing_);
        if (!edit_) return;
        Model next = edit_->commit();
        edit_.reset();
        undone_.clear();
        done_.push_back(renderer_->model());
        if (done_.size() > most_done) done_.erase(done_.begin());
        renderer_->set_model(std::move(next));
    }
    void discard() {
        const std::lock_guard lock(editing_);
        edit_.reset();
    }
    /// Goes one commit back, or forward again.
    /// Goes back or forth by so many commits, or by all.
    void step(bool back, std::optional<std::size_t> steps) {
        require_own_process();
        const auto no_measure = end_of_measure();
        nb::gil_scoped_release unlocked;
        const std::lock_guard lock(editing_);
        if (edit_) throw usage("edits wait: commit() or discard() them first");
        std::vector<Model>&from = back ? done_ : undone_, &to = back ? undone_ : done_;
        const std::string verb = back ? "undo" : "redo";
        if (from.empty()) throw usage("there is no commit to " + verb);
        const std::size_t count = steps.value_or(from.size());
        if (from.size() < count) throw usage("there are only " + std::to_string(from.size()) + " commits to " + verb);
        for (std::size_t i = 0; i < count; ++i) {
            to.push_back(renderer_->model());
            renderer_->set_model(std::move(from.back()));
            from.pop_back();
        }
    }

    Verification verify(std::size_t rays, std::uint64_t seed) {
        Verification result;
        run([&](Renderer& renderer) {
            Verifier verifier(renderer.model().scene(), rendered(), settings_);
            verifier.shoot(verifier.sample(camera_, rays, seed));
            result = verifier.result();
        });
        return result;
    }

    Measurement measure(const MeasureRequest& request) {
        Measurement result;
        run([&](Renderer& renderer) {
            const std::lock_guard lock(measuring_);
            Measurer measurer(renderer, settings_.threads);
            is_measure_ = true;
            struct End {
                bool& mark;
                ~End() { mark = false; }
            } end{is_measure_};
            result = measurer.measure(request);
        });
        return result;
    }

private:
    /// Waits for the end of a measure, whose many calls need one model, and lets none begin.
    std::unique_lock<std::mutex> end_of_measure() {
        if (computes_ == std::this_thread::get_id() && is_measure_) throw own_call();
        nb::gil_scoped_release unlocked;
        return std::unique_lock(measuring_);
    }
    static Error own_call() { return usage("a signal handler asks the scene whose call it interrupts"); }
    void require_own_process() const {
        if (getpid() != process_)
            throw Error(Status::usage, "the scene was loaded before this process was forked: load it again");
    }

    Settings settings_;
    std::vector<std::string> objects_;
    std::string units_, title_;
    Camera camera_;
    std::optional<Renderer> renderer_;
    std::optional<Edit> edit_;
    static constexpr std::size_t most_done = 100;
    std::vector<Model> done_, undone_;            ///< before and behind the scene's Model, the nearest last
    std::mutex computing_, measuring_, editing_;  ///< in the order in which they are locked
    bool is_measure_ = false;                     ///< whether the call of `computes_` is one
    std::shared_ptr<AnswerPool> answer_pool_ = std::make_shared<AnswerPool>();
    std::atomic<std::thread::id> computes_ = {};  ///< the thread that holds `computing_`
    pid_t process_ = getpid();
};

// ---- What is known ----

Rows region_rows(const LiveScene& scene) {
    Rows rows;
    const Model model = scene.model();
    for (const RegionInfo& r : model.regions()) rows.append(row_of(r, rows.size()));
    return rows;
}

Rows solid_rows(const LiveScene& scene) {
    Rows rows;
    const Model model = scene.model();
    for (const SolidInfo& s : model.solids()) rows.append(row_of(s));
    return rows;
}

Rows child_rows(const LiveScene& scene, const std::string& path) {
    Rows rows;
    for (const ChildInfo& child : scene.model().children(path)) rows.append(row_of(child));
    return rows;
}

/// A (4, 4) array.
Numpy<double> array_of(const Matrix& matrix) {
    auto held = std::make_unique<Matrix>(matrix);
    double* const data = held->data();
    return array(data, {4, 4}, keeper(held));
}

Rows warning_rows(LiveScene& scene) {
    std::vector<Warning> warnings;
    scene.run([&](Renderer& renderer) {
        warnings = renderer.model().warnings();
        warnings.insert(warnings.end(), renderer.device_warnings().begin(), renderer.device_warnings().end());
    });
    Rows rows;
    for (const Warning& w : warnings)
        rows.append(nb::make_tuple(w.object, place_row(w.place), w.reason, w.count, w.appearance, format(w)));
    return rows;
}

// ---- Rays and points ----

/// Dicts whose types are in csgrt/_values.py.
class PartitionArrays : public nb::dict {
    NB_OBJECT_DEFAULT(PartitionArrays, nb::dict, "csgrt._values.Partitions", PyDict_Check)
};
class HitArrays : public nb::dict {
    NB_OBJECT_DEFAULT(HitArrays, nb::dict, "csgrt._values.Hits", PyDict_Check)
};
class Figures : public nb::dict {
    NB_OBJECT_DEFAULT(Figures, nb::dict, "csgrt._values.Verification", PyDict_Check)
};

PartitionArrays partitions(LiveScene& scene, const Doubles& rays, RayRange range, const std::optional<Doubles>& ranges,
                           Fields fields) {
    // Arrays of an answer keep it alive. Afterwards its memory goes back to the scene, if the scene still exists.
    struct Held {
        std::weak_ptr<AnswerPool> giver;
        std::unique_ptr<Partitions> answer;
        ~Held() {
            const auto answer_pool = giver.lock();
            if (!answer_pool) return;
            const std::lock_guard lock(answer_pool->mutex);
            if (!answer_pool->answer) answer_pool->answer = std::move(answer);
        }
    };
    std::unique_ptr<Held> held(new Held{scene.answer_pool(), scene.answer_pool()->take()});
    Partitions& p = *held->answer;
    const auto list = list_of<Ray>(rays);
    scene.trace(list.size(), [&](auto& tracer) { tracer.partitions(list, p, fields, ranges_of(range, ranges)); });
    const nb::capsule kept = keeper(held);
    PartitionArrays arrays;
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

HitArrays cast_rays(LiveScene& scene, const Doubles& rays, RayRange range, const std::optional<Doubles>& ranges,
                    Fields fields) {
    auto answer = std::make_unique<Hits>();
    const auto list = list_of<Ray>(rays);
    scene.trace(list.size(), [&](auto& tracer) { tracer.cast_rays(list, *answer, fields, ranges_of(range, ranges)); });
    Hits& hits = *answer;
    const nb::capsule kept = keeper(answer);
    const Shape shape = leading(rays);
    HitArrays arrays;
    arrays["t_hit"] = array(hits.t_hit.data(), shape, kept);
    arrays["region_ids"] = array(hits.region_ids.data(), shape, kept);
    if (fields.solids) arrays["solid_ids"] = array(hits.solid_ids.data(), shape, kept);
    if (fields.normals) arrays["normals"] = array(hits.normals.data(), shape, kept);
    return arrays;
}

Numpy<bool> occluded(LiveScene& scene, const Doubles& rays, RayRange range, const std::optional<Doubles>& ranges) {
    auto answer = std::make_unique<Array<std::uint8_t>>();
    const auto list = list_of<Ray>(rays);
    scene.trace(list.size(), [&](auto& tracer) { tracer.occluded(list, *answer, ranges_of(range, ranges)); });
    auto* const data = reinterpret_cast<bool*>(answer->data());  // 0 and 1, as bool has them
    return array(data, leading(rays), keeper(answer));
}

Numpy<std::int32_t> region_at(LiveScene& scene, const Doubles& points) {
    auto answer = std::make_unique<Array<std::int32_t>>();
    const auto list = list_of<Vec3>(points);
    scene.trace(list.size(), [&](auto& tracer) { tracer.region_at(list, *answer); });
    std::int32_t* const data = answer->data();
    return array(data, leading(points), keeper(answer));
}

Numpy<std::int32_t> slice(LiveScene& scene, const Vec3& normal, double offset, std::pair<int, int> pixels,
                          bool hidden) {
    auto answer = std::make_unique<Array<std::int32_t>>();
    csgrt::Slice cut;
    scene.run([&](Renderer& renderer) {
        cut = slice_of(renderer.model().bounds(), normal, offset, pixels.first, pixels.second);
        cut.hidden = hidden;
        renderer.slice(cut, *answer);
    });
    std::int32_t* const data = answer->data();
    return array(data, {std::size_t(cut.height), std::size_t(cut.width)}, keeper(answer));
}

// ---- Views ----

std::pair<Numpy<float>, std::vector<std::string>> render(LiveScene& scene, const View& view) {
    auto image = std::make_unique<Image>();
    scene.run([&](Renderer& renderer) { *image = renderer.render(view); });
    std::vector<std::string> names = image->names;
    float* const data = image->channels[0].data();  // all channels are one piece of memory
    const Shape shape = {image->channels.size(), std::size_t(image->height), std::size_t(image->width)};
    return {array(data, shape, keeper(image)), std::move(names)};
}

Row pick(LiveScene& scene, const View& view, int column, int row) {
    Pick found;
    scene.run([&](Renderer& renderer) { found = renderer.model().pick(view, column, row); });
    nb::list along;
    for (const Partition& p : found.along.partitions) along.append(nb::make_tuple(p.region, p.in, p.out));
    return nb::make_tuple(found.region, found.solid, found.t, found.point, found.normal,
                          nb::make_tuple(found.ray.origin, found.ray.direction), along);
}

Numpy<double> rays_of(LiveScene& scene, const View& view) {
    auto rays = std::make_unique<std::vector<Ray>>();
    scene.run([&](Renderer& renderer) { *rays = renderer.model().grid_of(view).rays(); });
    Ray* const data = rays->data();
    return array(data, {std::size_t(view.height), std::size_t(view.width)}, keeper(rays));
}

Figures verify(LiveScene& scene, std::size_t rays, std::uint64_t seed) {
    if (rays == 0) throw usage("verify() needs a ray at least");
    const Verification result = scene.verify(rays, seed);
    Figures figures;
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

nb::object wall_row(const Wall& wall) {
    if (wall.thickness == 0) return nb::none();
    return nb::make_tuple(wall.thickness, wall.from, wall.to, wall.is_tapered);
}

/// The members of csgrt.MeasuredGrid.
nb::object grid_row(MeasuredGrid grid) {
    if (grid.sides[0] == 0) return nb::none();
    auto held = std::make_unique<MeasuredGrid>(std::move(grid));
    MeasuredGrid& all = *held;
    const nb::capsule kept = keeper(held);
    const auto arrays = [&kept](CellVolumes& v) {
        const std::size_t count = v.ids.size();
        return nb::make_tuple(array(reinterpret_cast<std::int32_t*>(v.cells.data()), {count, 3}, kept),
                              array(v.ids.data(), {count}, kept), array(v.volumes.data(), {count}, kept),
                              array(v.half_widths.data(), {count}, kept));
    };
    return nb::make_tuple(nb::tuple(nb::cast(all.sides)), all.box, arrays(all.regions), arrays(all.materials));
}

/// The members of csgrt.Measurement, with a row for each part.
Row measurement(LiveScene& scene, const MeasureRequest& request) {
    Measurement result = scene.measure(request);
    const auto pairs = [](const auto& estimates) {
        Rows rows;
        for (const Estimate& e : estimates) rows.append(nb::make_tuple(e.value, e.half_width));
        return rows;
    };
    Rows parts;
    for (const Measured& m : result.parts)
        parts.append(nb::make_tuple(std::string(name_of(measured_kind_names, m.kind)), m.name, m.id,
                                    pairs(std::array{m.volume, m.claimed, m.area, m.mass}),
                                    nb::make_tuple(pairs(m.centroid), pairs(m.origin), pairs(m.central)), m.box,
                                    m.regions, m.reached, m.unmet, m.weightless, m.unmet_bound, m.thin,
                                    wall_row(m.wall)));
    return nb::make_tuple(parts, grid_row(std::move(result.grid)), result.has_densities, result.reached, result.rays,
                          result.seconds);
}

/// The overlaps with the paths of their regions and their links, the other lists of csgrt.CheckResult, and its numbers.
Row checked(LiveScene& scene, const CheckRequest& request) {
    const Model model = scene.model();
    CheckResult result;
    scene.run([&](Renderer&) { result = Checker(model, scene.settings()).check(request); });
    const auto path = [&](std::uint32_t region) { return model.regions()[region].path; };
    const auto row = [&](const auto& pair, const auto&... more) {
        return row_of(pair, nb::make_tuple(path(pair.regions[0]), path(pair.regions[1])), more...);
    };
    Rows overlaps, unlisted;
    nb::list unused, unbounded;
    for (const FoundOverlap& o : result.overlaps) overlaps.append(row(o, link_of(o, model)));
    for (const UnlistedPair& pair : result.unlisted) unlisted.append(row(pair));
    for (const AllowedOverlap& rule : result.unused) unused.append(nb::make_tuple(rule.first, rule.second));
    for (const std::uint32_t region : result.unbounded) unbounded.append(path(region));
    nb::dict numbers;
    form::for_members(form::of<CheckResult>, [&](const auto& member) {
        if constexpr (!std::is_same_v<std::remove_cvref_t<decltype(member.kind)>, form::Listed>)
            numbers[std::string(member.key.member).c_str()] = result.*member.at;
    });
    return nb::make_tuple(overlaps, unlisted, unused, unbounded, numbers);
}

}  // namespace

void bind_scene(nb::module_& module) {
    using namespace nb::literals;
    module.attr("State") = literal(state_names);
    module.attr("Fastgen") = literal(fastgen_names);
    module.attr("Operator") = literal(joining);
    nb::class_<LiveScene>(module, "Scene", "What csgrt.Scene is made of.")
        .def(nb::init<Scene&, std::vector<std::string>, const Settings&>(), "source"_a, "objects"_a, "settings"_a)
        .def(nb::init<const LiveScene&>(), "other"_a)
        .def("_rendered", &LiveScene::rendered)
        .def("_region_rows", &region_rows)
        .def("_solid_rows", &solid_rows)
        .def("_child_rows", &child_rows)
        .def("_solid_text",
             [](const LiveScene& s, long long solid) -> std::optional<std::string> {
                 const Model model = s.model();
                 if (solid < 0 || static_cast<std::size_t>(solid) >= model.solids().size())
                     throw nb::index_error(("there is no solid " + std::to_string(solid)).c_str());
                 const std::optional<csgrt::Shape> shape = model.solid(static_cast<std::size_t>(solid));
                 if (!shape) return {};
                 return json_text(*shape);
             })
        .def("_matrix_of",
             [](const LiveScene& scene, const std::string& path) { return array_of(scene.model().matrix_of(path)); })
        .def("_placement_of",
             [](const LiveScene& scene, const std::string& path) { return array_of(scene.model().placement_of(path)); })
        .def("_warning_rows", &warning_rows)
        .def_prop_ro("_box", [](const LiveScene& scene) { return scene.model().bounds(); })
        .def_prop_ro(
            "tolerance", [](const LiveScene& scene) { return scene.model().tolerance(); },
            "Millimetres: ends of segments closer than this are one")
        .def_prop_ro("units", &LiveScene::units, "The unit of the file. All values here are millimetres")
        .def_prop_ro("title", &LiveScene::title, "The file's title")
        .def_prop_ro("camera", &LiveScene::camera, nb::rv_policy::copy, "A copy of the scene's own camera")
        .def("_partition_arrays",
             [](LiveScene& scene, const Doubles& rays, double near, double far, std::optional<Doubles> ranges,
                bool solids, bool normals, bool overlaps, bool hidden) {
                 return partitions(scene, rays, {near, far}, ranges, {solids, normals, overlaps, hidden});
             })
        .def("_hit_arrays",
             [](LiveScene& scene, const Doubles& rays, double near, double far, std::optional<Doubles> ranges,
                bool solids, bool normals) {
                 return cast_rays(scene, rays, {near, far}, ranges, {.solids = solids, .normals = normals});
             })
        .def("_occluded",
             [](LiveScene& scene, const Doubles& rays, double near, double far, std::optional<Doubles> ranges) {
                 return occluded(scene, rays, {near, far}, ranges);
             })
        .def("_regions_at", &region_at)
        .def("slice", &slice, "normal"_a, "offset"_a, "pixels"_a = std::pair(1024, 1024), "hidden"_a = true,
             "Which region holds each pixel of a cut by the plane n . p = offset (n: the normal's unit vector).\n\n"
             "pixels: (width, height), square, over the whole model. hidden=False leaves out what pictures do not show."
             "\nReturns (height, width) int32: ids in regions; -1 nothing, -2 several that overlap. Seen from the side "
             "to which the normal points, z up, or y up where the normal is z.\nRaises csgrt.Error (usage).")
        .def("_planes", &render)
        .def("_pick_row", &pick)
        .def("_view_rays", &rays_of)
        .def("verify", &verify, "rays"_a = 10'000, "seed"_a = 1,
             "Judges a sample of rays, on the device and on the reference, by 113-bit arithmetic.\n\n"
             "Returns a dict: passed (no decided ray is wrong, no bit differs), rays, hits, decided, ties, wrong, "
             "bit_differences, ends,\nfarthest_mm, worst_ulps (errors of distances), device. Raises csgrt.Error.")
        .def("_measurement", &measurement)
        .def("_checked", &checked)
        .def("_set_color", [](LiveScene& scene, const std::string& path,
                              const Vec3& color) { scene.edit([&](Edit& e) { e.set_color(path, color); }); })
        .def("_set_finish",
             [](LiveScene& scene, const std::string& path, const Scene& source) {
                 scene.edit([&](Edit& e) { e.set_finish(path, first<Combination>(source).finish.value_or(Finish{})); });
             })
        .def("_set_state",
             [](LiveScene& scene, const std::string& path, const std::string& state) {
                 scene.edit([&](Edit& e) { e.set_state(path, value_of(state_names, "a state", state, usage)); });
             })
        .def("_set_matrix",
             [](LiveScene& scene, const std::string& path, const Matrices& matrix) {
                 scene.edit([&](Edit& e) { e.set_matrix(path, matrix_of(matrix)); });
             })
        .def("_move",
             [](LiveScene& scene, const std::string& path, const Matrices& matrix, bool shared) {
                 scene.edit(
                     [&](Edit& e) { e.move(path, matrix_of(matrix), shared ? Edit::Share::all : Edit::Share::alone); });
             })
        .def("_replace_shape",
             [](LiveScene& scene, const std::string& solid, const Scene& source) {
                 const Tree& placed = first<Combination>(source).tree;  // of a single leaf
                 scene.edit([&](Edit& e) { e.replace(solid, first<Solid>(source).shape, placed.nodes.at(0).matrix); });
             })
        .def("_add_objects",
             [](LiveScene& scene, const Scene& source, const std::string& top) {
                 scene.edit([&](Edit& e) {
                     // The last is the one whose name the caller chose: if that is taken, nothing is added.
                     for (std::size_t i = source.objects.size(); i-- > 0;)
                         e.add(source.objects[i], name_of(source.objects[i]) == top);
                 });
             })
        .def("_join",
             [](LiveScene& scene, const std::string& combination, const std::string& op, const std::string& object,
                const Matrices& matrix) {
                 scene.edit([&](Edit& e) {
                     e.add(combination, value_of(joining, "an operator", op, usage), object, matrix_of(matrix));
                 });
             })
        .def(
            "remove", [](LiveScene& scene, const std::string& path) { scene.edit([&](Edit& e) { e.remove(path); }); },
            "path"_a, "Removes the last leg of a path, for all that share the combination. Takes effect with commit().")
        .def(
            "erase", [](LiveScene& scene, const std::string& path) { scene.edit([&](Edit& e) { e.erase(path); }); },
            "path"_a,
            "Removes it, and deletes its object and what nothing else uses below it, so that the names are free."
            "\nTakes effect with commit(). Raises csgrt.Error if the object has other uses.")
        .def("_add_top",
             [](LiveScene& scene, const std::string& object, const Matrices& matrix) {
                 scene.edit([&](Edit& e) { e.add_top(object, matrix_of(matrix)); });
             })
        .def("_commit_edits", &LiveScene::commit)
        .def("_step", &LiveScene::step)
        .def("discard", &LiveScene::discard, "Forgets the edits since the last commit().")
        .def("_save_json", [](const LiveScene& scene, const std::string& path) {
            const Model model = scene.model();
            nb::gil_scoped_release unlocked;
            save_scene(model.scene(), path);
        });
}

}  // namespace csgrt::python
