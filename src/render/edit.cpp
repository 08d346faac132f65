#include <csgrt/edit.hpp>

#include <algorithm>
#include <unordered_map>
#include <utility>

#include "compile/repaint.hpp"
#include "render/model_impl.hpp"
#include "scene/edit_scene.hpp"
#include "scene/faults/finding_list.hpp"
#include "scene/faults/objects.hpp"
#include "scene/object_path.hpp"
#include "scene/vector.hpp"

namespace csgrt {

struct Edit::Impl {
    std::shared_ptr<const Model::Impl> before;
    ModelSource source;                 ///< with all edits except appearances
    std::shared_ptr<Scene> scene = {};  ///< replaces the source's scene, if an edit changes it
    std::vector<Look> looks = {};       ///< in addition to the source's appearances
    mutable bool is_given = false;      ///< a Model has the scene, too

    Scene& changed() {
        if (!scene) {
            scene = std::make_shared<Scene>(changed_scene(*source.scene, source.changes, source.objects));
            source.changes = {};
            if (source.objects.empty()) scene->top = top_objects(*scene);  // so that no edit changes them
        }
        if (std::exchange(is_given, false)) scene = std::make_shared<Scene>(*scene);
        return *scene;
    }
    /// Calls change(names, rendered, changes), which adds to the changes beside the scene and returns whether that
    /// suffices. `names`: of the scene without the changes. False: the scene has to be copied.
    template <class Change>
    bool beside(const Change& change);
    std::vector<std::string>& rendered() { return source.objects.empty() ? changed().top : source.objects; }
    /// The number of a path among them, or -1. Throws if it is all that is rendered.
    std::ptrdiff_t root(const std::string& path);
    void add(Look look);
    bool changes_tables_alone() const;
    std::optional<CompiledScene> compiled_in_part() const;
    ModelSource next() const;
};

namespace {

/// Joins lists of appearances: first the earlier entries, without those that later entries replace completely, then the
/// later entries. So the list does not grow when the same paths are edited again.
std::vector<Look> joined(std::vector<Look> all, const std::vector<Look>& later) {
    all.insert(all.end(), later.begin(), later.end());
    struct Last {
        std::size_t color = SIZE_MAX, finish = SIZE_MAX, state = SIZE_MAX;
    };
    std::unordered_map<std::string, Last> last;
    for (std::size_t i = 0; i < all.size(); ++i) {
        Last& of = last[all[i].path];
        if (all[i].color) of.color = i;
        if (all[i].finish) of.finish = i;
        if (all[i].state) of.state = i;
    }
    std::vector<Look> kept;
    for (std::size_t i = 0; i < all.size(); ++i) {
        const Last& of = last[all[i].path];
        if (of.color != i) all[i].color = {};
        if (of.finish != i) all[i].finish = {};
        if (of.state != i) all[i].state = {};
        if (all[i].color || all[i].finish || all[i].state) kept.push_back(std::move(all[i]));
    }
    return kept;
}

/// Throws Error (scene) for colours and other values that a scene must not have.
void check_values(const Scene& values) {
    FindingList findings;
    check_settings(values, [&](const Place& place, const std::string& message, const std::string& suggestion) {
        findings.add({place, message, suggestion, {}});
    });
    if (!findings.empty()) throw Error(Status::scene, findings.take());
}

}  // namespace

template <class Change>
bool Edit::Impl::beside(const Change& change) {
    const std::unique_lock lock(source.kept->mutex, std::try_to_lock);
    if (scene || !lock || !source.kept->take(source.scene)) return false;
    const Compilation* const compilation = source.kept->of.get();
    return change(compilation->names(), source.objects.empty() ? compilation->roots() : source.objects, source.changes);
}

Edit::Edit(Model model) : impl_(new Impl{.before = model.impl_, .source = model.impl_->source}) {}
Edit::~Edit() = default;
Edit::Edit(Edit&&) noexcept = default;
Edit& Edit::operator=(Edit&&) noexcept = default;

void Edit::Impl::add(Look look) {
    look.path = normal_path(look.path);
    check_values({.looks = {look}});
    looks.push_back(std::move(look));
}

std::ptrdiff_t Edit::Impl::root(const std::string& path) {
    const std::size_t number = position(rendered(), path), count = rendered().size();
    if (number == count) return -1;
    if (count == 1) throw Error(Status::usage, "'" + path + "' is all that is rendered");
    return static_cast<std::ptrdiff_t>(number);
}

Edit& Edit::set_color(const std::string& path, const Vec3& color) {
    impl_->add({.path = path, .color = color});
    return *this;
}

Edit& Edit::set_finish(const std::string& path, const Finish& finish) {
    impl_->add({.path = path, .finish = finish});
    return *this;
}

Edit& Edit::set_state(const std::string& path, State state) {
    impl_->add({.path = path, .state = state});
    return *this;
}

Edit& Edit::set_lights(std::vector<Light> lights) {
    impl_->source.lights = std::move(lights);
    return *this;
}

Edit& Edit::set_ambient(double intensity) {
    impl_->source.ambient = intensity;
    return *this;
}

Edit& Edit::set_background(const Vec3& color) {
    impl_->source.background = color;
    return *this;
}

Edit& Edit::set_matrix(const std::string& path, const Matrix& matrix, Share share) {
    const FloatingPoint own;
    const auto beside = [&](const Names& names, const std::vector<std::string>& rendered, SceneChanges& changes) {
        return place_beside(names, rendered, path, matrix, share == Share::alone, changes);
    };
    if (impl_->beside(beside)) return *this;
    place_object(impl_->changed(), impl_->rendered(), path, matrix, share == Share::alone);
    return *this;
}

Edit& Edit::move(const std::string& path, const Matrix& matrix, Share share) {
    const FloatingPoint own;
    const auto beside = [&](const Names& names, const std::vector<std::string>& rendered, SceneChanges& changes) {
        return move_beside(names, rendered, path, matrix, share == Share::alone, changes);
    };
    if (impl_->beside(beside)) return *this;
    Scene& scene = impl_->changed();
    if (normal_path(path) != "/") {
        move_object(scene, impl_->rendered(), path, matrix, share == Share::alone);
    } else if (impl_->source.objects.empty()) {
        scene.top_matrices.resize(scene.top.size(), identity);
        for (Matrix& place : scene.top_matrices) place = compose(matrix, place);
    } else {
        for (const std::string& root : impl_->source.objects)
            move_object(scene, impl_->source.objects, root, matrix, share == Share::alone);
    }
    return *this;
}

Edit& Edit::replace(const std::string& solid, Shape shape, const Matrix& matrix) {
    const FloatingPoint own;
    replace_shape(impl_->changed(), solid, std::move(shape), matrix);
    return *this;
}

Edit& Edit::add(Object object, bool top) {
    Scene& scene = impl_->changed();
    const std::string name = name_of(object);
    if (scene.find(name) != nullptr)
        throw Error(Status::usage, {Diagnostic{.message = "the scene has an object '" + name + "' already",
                                               .suggestion = "add_top() renders it, replace() gives a solid another "
                                                             "shape, erase() deletes it; or take another name"}});
    scene.objects.push_back(std::move(object));
    if (top) add_top(name);
    return *this;
}

Edit& Edit::add_top(const std::string& object, const Matrix& matrix) {
    const FloatingPoint own;
    Scene& scene = impl_->changed();
    std::vector<std::string>& rendered = impl_->rendered();
    if (scene.find(object) == nullptr)
        throw Error(Status::usage, {Diagnostic{.message = "the scene has no object '" + object + "'",
                                               .suggestion = did_you_mean_object(scene, object)}});
    if (position(rendered, object) < rendered.size())
        throw Error(Status::usage, {Diagnostic{.message = "'" + object + "' is rendered already",
                                               .suggestion = "set_matrix() gives it another place"}});
    if (&rendered == &impl_->source.objects) rendered.push_back(object);
    if (&rendered == &scene.top || matrix != identity) csgrt::add_top(scene, object, matrix);
    return *this;
}

Edit& Edit::add(const std::string& combination, Operator op, const std::string& object, const Matrix& matrix) {
    const FloatingPoint own;
    add_member(impl_->changed(), combination, op, object, matrix);
    return *this;
}

Edit& Edit::remove(const std::string& path) {
    const FloatingPoint own;
    const auto beside = [&](const Names& names, const std::vector<std::string>& rendered, SceneChanges& changes) {
        return remove_beside(names, rendered, path, changes);
    };
    if (impl_->beside(beside)) return *this;
    const std::ptrdiff_t root = impl_->root(path);
    if (root < 0) {
        remove_member(impl_->changed(), path);
    } else if (impl_->source.objects.empty()) {
        remove_top(impl_->changed(), path);
    } else {
        impl_->source.objects.erase(impl_->source.objects.begin() + root);
    }
    return *this;
}

Edit& Edit::erase(const std::string& path) {
    const FloatingPoint own;
    std::vector<std::string>& objects = impl_->source.objects;
    const std::ptrdiff_t root = impl_->root(path);
    erase_object(impl_->changed(), impl_->rendered(), path);
    if (root >= 0 && !objects.empty()) objects.erase(objects.begin() + root);
    return *this;
}

/// Whether only tables of regions change, apart from the changes beside the scene. They do not suffice if a region
/// begins or ceases to emit light, since its number may change.
bool Edit::Impl::changes_tables_alone() const {
    if (scene || source.objects != before->source.objects) return false;
    return std::ranges::none_of(looks, [&](const Look& look) {
        return look.finish &&
               (look.finish->light || std::ranges::any_of(before->scene.region_lights, [&](const RegionLight& light) {
                    return is_at_or_below(before->scene.region_info[light.region].path, look.path);
                }));
    });
}

/// The compiled scene with the changes beside the scene. Nothing: the scene has to be compiled anew.
std::optional<CompiledScene> Edit::Impl::compiled_in_part() const {
    if (source.changes == before->source.changes) return before->scene;
    const std::unique_lock lock(source.kept->mutex, std::try_to_lock);
    if (!lock || !source.kept->take(source.scene)) return {};
    std::unique_ptr<Compilation> of = std::move(source.kept->of);
    std::optional<CompiledScene> made = of->with(source.changes, before->scene, before->source.changes);
    if (!of->is_spent()) source.kept->of = std::move(of);
    return made;
}

ModelSource Edit::Impl::next() const {
    ModelSource made = source;
    made.looks = joined(made.looks, looks);
    return made;
}

Model Edit::commit() const {
    const FloatingPoint own;
    const Impl& edit = *impl_;
    const AllowedThreads allowed(edit.source.settings.threads);
    ModelSource source = edit.next();
    // Looks were checked when they were set.
    check_values({.lights = source.lights, .ambient = source.ambient, .background = source.background});
    std::shared_ptr<const Model::Impl> made;
    std::optional<CompiledScene> placed;
    if (edit.changes_tables_alone()) placed = edit.compiled_in_part();
    if (placed) {
        CompiledScene painted = repainted(*placed, edit.looks, {source.lights, source.ambient, source.background});
        made = std::make_shared<Model::Impl>(std::move(source), std::move(painted), *edit.before);
    } else {
        std::shared_ptr<Scene> whole = edit.scene;
        if (!whole) whole = std::make_shared<Scene>(changed_scene(*source.scene, source.changes, source.objects));
        if (edit.scene && std::exchange(edit.is_given, true)) whole = std::make_shared<Scene>(*whole);
        source.changes = {};
        source.put_appearance(*whole);
        source.scene = std::move(whole);
        made = std::make_shared<Model::Impl>(std::move(source));
        for (const Look& look : edit.looks) regions_at(made->scene, look.path);
    }
    return Model(std::move(made));
}

}  // namespace csgrt
