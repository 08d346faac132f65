// Validation: one walk over all objects that the rendered objects use. It visits each object once, and sums the number
// of solids below the object on the way back, so neither depth nor sharing costs time.
#include <algorithm>
#include <cstdint>
#include <iterator>
#include <span>
#include <string_view>
#include <unordered_map>
#include <utility>

#include "base/parallel.hpp"
#include "scene/excerpt.hpp"
#include "scene/faults/finding_list.hpp"
#include "scene/instances.hpp"
#include "scene/nearest.hpp"
#include "scene/faults/objects.hpp"
#include "scene/object_path.hpp"
#include "scene/faults/solids.hpp"
#include "scene/faults/unsupported.hpp"
#include "scene/faults/validate.hpp"
#include "scene/walk.hpp"

namespace csgrt {

namespace {

constexpr std::uint64_t far_too_many = UINT64_MAX;

std::uint64_t saturating_sum(std::uint64_t a, std::uint64_t b) { return a > far_too_many - b ? far_too_many : a + b; }

/// Validates the objects below the rendered ones, depth first. In a lenient scene it marks faulty objects as left out;
/// in a strict one it reports them.
class Validation {
public:
    Validation(const Scene& scene, Names& names, bool skip_unsupported, std::uint64_t max_instances)
        : scene_(scene),
          names_(names),
          skip_unsupported_(skip_unsupported || scene.lenient),
          instance_limit_(scene, max_instances),
          objects_(scene.objects.size()) {}

    Validated run(const std::vector<std::string>& named, std::vector<Warning>& warnings) {
        for (const std::uint32_t object : names_.taken())
            add(place_of(scene_.objects[object]),
                "there are two objects named '" + name_of(scene_.objects[object]) + "'", "rename one of them");
        find_sound();
        check_settings(scene_, report_);
        const std::vector<std::uint32_t> roots = find_roots(named);
        std::uint64_t solids = 0;
        for (const std::uint32_t root : roots) {
            walk(root);
            solids = saturating_sum(solids, objects_[root].solids);
        }
        report_unsupported();
        if (scene_.lenient) report_empty();
        if (found_.empty() && solids == 0 && warnings_.empty()) {
            add(roots.empty() ? Place{} : place_of(scene_.objects[roots.front()]),
                "there is nothing to render: the objects hold no solids", "name objects that do, or add solids");
        }
        if (!instance_limit_.allows(static_cast<double>(solids))) report_too_many({}, "the scene", solids);
        take_warnings(warnings);
        Validated result{finish(), {}};
        result.instances.reserve(objects_.size());
        for (const Reached& object : objects_) result.instances.push_back(object.solids);
        return result;
    }

private:
    enum class Visit : std::uint8_t { unseen, open, done };
    struct Reached {
        std::uint64_t solids = 0;  ///< number of solid instances below a combination, or that a solid counts for
        std::uint32_t height = 0;  ///< number of combinations on the longest path downward, this object included
        std::uint32_t users = 0;   ///< number of members that name the object
        std::uint32_t first_user = 0;
        Visit visit = Visit::unseen;
        bool sound = false;  ///< the object has no fault of its own
    };
    struct Level {};
    friend class Walk<Level>;
    using Open = Walk<Level>::Open;

    void add(const Place& place, std::string message, std::string suggestion = {}) {
        found_.add({place, std::move(message), std::move(suggestion), {}});
    }

    /// Marks the objects without a fault of their own, which nearly all are, so that the walk need not check them.
    void find_sound() {
        constexpr std::size_t chunk = 2048;
        for_chunks(objects_.size(), chunk, 0, [this](std::size_t first, std::size_t last, std::size_t) {
            bool sound = true;
            const Report note = [&](const Place&, const std::string&, const std::string&) { sound = false; };
            for (std::size_t i = first; i < last; ++i) {
                sound = true;
                if (const auto* solid = std::get_if<Solid>(&scene_.objects[i])) {
                    sound = solid_faults(solid->shape).empty();
                    objects_[i].solids = instances_of(*solid);
                } else {
                    check_combination(std::get<Combination>(scene_.objects[i]), note);
                }
                objects_[i].sound = sound;
            }
        });
    }

    std::vector<std::uint32_t> find_roots(const std::vector<std::string>& named) {
        std::vector<std::uint32_t> roots;
        for (const std::string& name : named.empty() ? names_.top_objects() : named) {
            ObjectPath path = find_path(scene_, names_, name);
            if (path.steps.empty()) {
                add({}, std::move(path.fault), std::move(path.suggestion));
                continue;
            }
            roots.push_back(path.object());
            if (named.empty() && !scene_.top_matrices.empty() && names_.find(name) == Names::none)
                add({}, "the top object '" + name + "' is a path, and there are places",
                    "give each top object by its name, or leave Scene::top_matrices empty");
            for (std::size_t i = 1; i < path.steps.size(); ++i)
                check_matrix(names_.node(path.steps[i - 1].object, path.steps[i].node), report_);
        }
        if (roots.empty() && named.empty() && scene_.top.empty()) {
            // Every object is used by another one, so there is a cycle. A walk from all objects finds it.
            for (std::uint32_t i = 0; i < scene_.objects.size(); ++i) roots.push_back(i);
        }
        return roots;
    }

    void walk(std::uint32_t root) {
        if (objects_[root].visit != Visit::unseen) return;
        if (enter(root)) {
            walk_.below(names_, root, {}, *this);
        } else {
            close(root);
        }
    }

    /// Begins the visit of an object, and reports its faults. True: the object is a combination, and the caller walks
    /// its tree.
    bool enter(std::uint32_t object) {
        objects_[object].visit = Visit::open;
        const bool is_solid = names_.is_solid(object);
        if (objects_[object].sound) return !is_solid;
        if (const auto* solid = std::get_if<Solid>(&scene_.objects[object])) {
            std::string all;
            for (const std::string& fault : solid_faults(solid->shape)) {
                if (!scene_.lenient) add(solid->place, "solid '" + solid->name + "': " + fault);
                all += (all.empty() ? "" : "; ") + fault;
            }
            if (scene_.lenient) leave_out(object, solid->place, all);
        } else if (scene_.lenient) {
            return leave_out_parts(object);
        } else {
            check_combination(std::get<Combination>(scene_.objects[object]), report_);
        }
        return !is_solid;
    }

    void tolerate(const std::string& object, const Place& place, std::string reason) {
        warnings_.push_back({object, place, std::move(reason), 1});
    }

    /// Leaves an object out. The warning's count, the number of members that name the object, is known only after the
    /// walk.
    void leave_out(std::uint32_t object, const Place& place, const std::string& reason) {
        names_.leave_out(object);
        counted_.emplace_back(warnings_.size(), object);
        tolerate(name_of(scene_.objects[object]), place, "left out: " + reason);
    }

    /// Leaves out the faulty parts of a combination. Returns whether its tree can be walked.
    bool leave_out_parts(std::uint32_t object) {
        const Combination& combination = std::get<Combination>(scene_.objects[object]);
        check_attributes(combination, [&](const Place& place, const std::string& message, const std::string&) {
            tolerate(combination.name, place, message + "; taken as it is");
        });
        bool sound = true;
        check_tree(combination, [&](const Place& place, const std::string& message, const std::string&) {
            if (sound) leave_out(object, place, message);
            sound = false;
        });
        if (!sound) return false;
        for (std::size_t i = 0; i < combination.tree.nodes.size(); ++i) {
            if (combination.tree.nodes[i].op != Operator::leaf) continue;
            check_matrix(combination.tree.nodes[i],
                         [&](const Place& place, const std::string& message, const std::string&) {
                             names_.leave_out(object, i);
                             tolerate(combination.name, place, message + "; the leg is left out");
                         });
        }
        return true;
    }

    /// Adds one warning for all members that name the same missing object.
    void leave_out_missing(std::uint32_t parent, std::size_t node, const TreeNode& member) {
        names_.leave_out(parent, node);
        const auto [known, is_new] = missing_.try_emplace(member.object, warnings_.size());
        if (!is_new) {
            ++warnings_[known->second].count;
            return;
        }
        tolerate(member.object, member.place,
                 "left out: there is no such object; used by '" + name_of(scene_.objects[parent]) + "'");
    }

    // The class Walk calls the functions below.

    /// Goes from a combination to a member. The numbers of a child that is already done are added to the combination
    /// here; the numbers of a new child are added when the walk leaves it.
    std::optional<Level> follow(const Open& parent, std::uint32_t node, std::uint32_t object) {
        if (object == Names::none) {
            follow_missing(parent.object, node);
            return {};
        }
        Reached& child = objects_[object];
        if (child.users++ == 0) child.first_user = parent.object;
        if (child.visit == Visit::open) {
            report_cycle(parent.object, node, object);
        } else if (child.visit == Visit::done) {
            add_below(parent.object, child);
        } else if (child.sound && names_.is_solid(object)) {
            child.visit = Visit::done;  // has the same effect as enter() and close()
            add_below(parent.object, child);
        } else if (enter(object)) {
            return Level{};
        } else {
            close(object);
            add_below(parent.object, child);
        }
        return {};
    }
    void operate(const Open&, std::uint32_t) {}
    void nothing() {}
    void leave(const Open& done) {
        close(done.object);
        if (!walk_.open().empty()) add_below(walk_.open().back().object, objects_[done.object]);
    }

    void follow_missing(std::uint32_t parent, std::size_t node) {
        const TreeNode& missing = names_.node(parent, node);
        if (scene_.lenient) return leave_out_missing(parent, node, missing);
        add(missing.place,
            "'" + name_of(scene_.objects[parent]) + "' uses '" + missing.object + "', which does not exist",
            found_.full() ? std::string() : did_you_mean_object(scene_, missing.object));
    }

    /// Ends the visit of an object, whose members are all done.
    void close(std::uint32_t object) {
        Reached& reached = objects_[object];
        reached.visit = Visit::done;
        const auto name = [&] { return "'" + name_of(scene_.objects[object]) + "'"; };
        const auto place = [&]() -> const Place& { return place_of(scene_.objects[object]); };
        if (names_.kind(object) == Names::Kind::left_out) {
            reached.solids = 0;
        } else if (!names_.is_solid(object) && ++reached.height == Limits::nesting + 1) {
            add(place(),
                "below " + name() + ", combinations are nested more than " + std::to_string(Limits::nesting) + " deep",
                "join some of the combinations on the way");
        }
        if (!instance_limit_.allows(static_cast<double>(reached.solids)))
            report_too_many(place(), name(), reached.solids);
    }

    void add_below(std::uint32_t parent, const Reached& child) {
        objects_[parent].solids = saturating_sum(objects_[parent].solids, child.solids);
        objects_[parent].height = std::max(objects_[parent].height, child.height);
    }

    /// Reports too many instances, only for the first such object.
    void report_too_many(const Place& place, const std::string& what, std::uint64_t count) {
        if (!too_many_reported_) found_.add(instance_limit_.fault(place, what, static_cast<double>(count)));
        too_many_reported_ = true;
    }

    /// Reports a cycle. Of a long cycle only the end is shown: a scene may have as many cycles as objects.
    void report_cycle(std::uint32_t parent, std::size_t node, std::uint32_t object) {
        if (!scene_.lenient && found_.full()) return found_.leave_out();
        const TreeNode& back = names_.node(parent, node);
        const std::vector<Open>& path = walk_.open();
        constexpr std::size_t most = 20;
        std::size_t first = path.size(), shown = 0;
        while (shown++ < most && path[--first].object != object) continue;
        std::string cycle = path[first].object == object ? "" : back.object + "/.../";
        for (; first < path.size(); ++first) cycle += name_of(scene_.objects[path[first].object]) + "/";
        if (scene_.lenient) {
            names_.leave_out(parent, node);
            tolerate(back.object, back.place, "contains itself: " + cycle + back.object + "; that leg is left out");
            return;
        }
        add(back.place, "'" + back.object + "' contains itself: " + cycle + back.object, "take one of these legs out");
    }

    /// Reports combinations without a tree, which BRL-CAD's objects without volume become, too. Flattening reports
    /// regions.
    void report_empty() {
        for (std::uint32_t i = 0; i < objects_.size(); ++i) {
            if (objects_[i].visit == Visit::unseen || objects_[i].users == 0) continue;
            if (names_.kind(i) != Names::Kind::combination || !names_.children(i).empty()) continue;
            leave_out(i, place_of(scene_.objects[i]), "there is nothing in it");
        }
    }

    void take_warnings(std::vector<Warning>& to) {
        for (const auto& [warning, object] : counted_) {
            warnings_[warning].count = std::max<std::uint64_t>(objects_[object].users, 1);
            warnings_[warning].reason += first_user(object);
        }
        std::stable_sort(warnings_.begin(), warnings_.end(),
                         [](const Warning& a, const Warning& b) { return comes_before(a.place, b.place); });
        std::move(warnings_.begin(), warnings_.end(), std::back_inserter(to));
    }

    void report_unsupported() {
        for (std::uint32_t i = 0; i < objects_.size(); ++i) {
            if (names_.kind(i) != Names::Kind::unsupported || objects_[i].visit == Visit::unseen) continue;
            const auto* solid = std::get_if<Solid>(&scene_.objects[i]);
            const auto* shape = std::get_if<Unsupported>(&solid->shape);
            if (skip_unsupported_) {
                leave_out(i, solid->place, why_left_out(*shape));
                continue;
            }
            std::string message = "'" + solid->name + "' is a solid of type '" + shape->type + "', which ";
            message += shape->reason.empty() ? "csgrt does not support" : "is not complete: " + shape->reason;
            message += first_user(i);
            if (objects_[i].users > 0) {
                if (const std::uint32_t others = objects_[i].users - 1; others > 0) {
                    message += " and on " + std::to_string(others) + (others == 1 ? " other leg" : " other legs");
                }
            }
            add(solid->place, std::move(message),
                std::string(shape->reason.empty() ? "" : "add what it lacks, ") +
                    "render objects that do not use it, replace it, or leave it out with --skip-unsupported");
        }
    }

    std::string first_user(std::uint32_t object) const {
        if (objects_[object].users == 0) return {};
        return "; used by '" + name_of(scene_.objects[objects_[object].first_user]) + "'";
    }

    std::vector<Diagnostic> finish() {
        found_.sort_by_place();
        for (Diagnostic& diagnostic : found_.shown()) diagnostic.excerpt = excerpt(diagnostic.place);
        return found_.take();
    }

    const Scene& scene_;
    Names& names_;
    const bool skip_unsupported_;
    InstanceLimit instance_limit_;
    std::vector<Reached> objects_;
    Walk<Level> walk_;
    FindingList found_;
    std::vector<Warning> warnings_;
    std::vector<std::pair<std::size_t, std::uint32_t>> counted_;  ///< a warning's index, and the object that it counts
    std::unordered_map<std::string, std::size_t> missing_;        ///< for each missing name: its warning's index
    const Report report_ = [this](const Place& place, std::string message, std::string suggestion) {
        add(place, std::move(message), std::move(suggestion));
    };
    bool too_many_reported_ = false;
};

}  // namespace

Validated validate(const Scene& scene, Names& names, const std::vector<std::string>& objects, bool skip_unsupported,
                   std::vector<Warning>& warnings, std::uint64_t max_instances) {
    return Validation(scene, names, skip_unsupported, max_instances).run(objects, warnings);
}

std::vector<Diagnostic> validate(const Scene& scene, const std::vector<std::string>& objects, bool skip_unsupported,
                                 std::vector<Warning>* warnings, std::uint64_t max_instances) {
    const FloatingPoint own;
    Names names(scene);
    std::vector<Warning> passed_over;
    return validate(scene, names, objects, skip_unsupported, warnings != nullptr ? *warnings : passed_over,
                    max_instances)
        .findings;
}

}  // namespace csgrt
