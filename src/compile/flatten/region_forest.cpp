#include "compile/flatten/region_forest.hpp"

#include <algorithm>
#include <utility>

#include "compile/linear.hpp"
#include "scene/vector.hpp"

namespace csgrt {

// The limit: groups of groups make more references than solids, but not many times more.
ReferenceLimit::ReferenceLimit(const Scene& scene, std::uint64_t max_instances)
    : most_(8 * std::max({max_instances, Limits::instances, std::uint64_t{scene.objects.size()}})) {}

void ReferenceLimit::check(std::uint64_t count) const {
    if (count > most_)
        throw Error(Status::scene, "more than " + std::to_string(most_) + " references to combinations and solids");
}

void check_path_bytes(std::uint64_t bytes) {
    if (bytes > Limits::path_bytes)
        throw Error(Status::scene, "the paths of all regions have more than " + std::to_string(Limits::path_bytes) +
                                       " bytes together");
}

RegionForest::RegionForest(const Source& source, const ObjectPath& object, bool air) : source_(source), air_(air) {
    if (const std::optional<Level> level = visit(start_of(object)))
        Walk<Level>().below(source.names, object.object(), *level, *this);
    root_ = operands_.back();
}

RegionStart RegionForest::start_of(const ObjectPath& path) {
    RegionStart start{path.steps.front().object, none, none, 0};
    for (std::size_t i = 1; i < path.steps.size(); ++i) {
        above_.push_back({start.object, matrix_of(start), attributes_of(start), start});
        const Names::Kind kind = source_.names.kind(start.object);
        const bool region = kind == Names::Kind::region || kind == Names::Kind::air_region;
        if (region && inside_ == none) inside_ = start.object;
        paths_.push_back({start.path, start.object, start.node});
        start = {path.steps[i].object, static_cast<std::uint32_t>(paths_.size() - 1),
                 static_cast<std::uint32_t>(above_.size() - 1), path.steps[i].node};
    }
    return start;
}

Matrix RegionForest::matrix_of(const RegionStart& start) const {
    if (start.above == none) return source_.names.matrix(start.object, Names::none);
    const Above& above = above_[start.above];
    const std::map<MemberPath, Matrix>& alone = source_.names.moved().alone;
    const auto own = alone.empty() ? alone.end() : alone.find(members_to(start));
    return compose(above.matrix, own != alone.end() ? own->second : source_.names.matrix(above.object, start.node));
}

MemberPath RegionForest::members_to(RegionStart start) const {
    MemberPath members;
    for (; start.above != none; start = above_[start.above].start)
        members.emplace_back(above_[start.above].object, start.node);
    std::ranges::reverse(members);
    return members;
}

void RegionForest::place_again(const ChangedMembers& changed) {
    changed_users_.assign(source_.scene.objects.size(), false);
    for (const Member& member : changed.all) changed_users_[member.first] = true;
    for (const MemberPath& path : changed.alone) changed_users_[path.back().first] = true;
    changed_ = changed;
    for (Above& above : above_) {
        above.has_moved = has_moved(above.start);
        if (above.has_moved) above.matrix = matrix_of(above.start);
    }
}

bool RegionForest::has_moved(const RegionStart& start) const {
    const bool is_top = start.above == none;
    if (!is_top && above_[start.above].has_moved) return true;
    const Member member(is_top ? start.object : above_[start.above].object, is_top ? Names::none : start.node);
    return changed_users_[member.first] && (std::ranges::binary_search(changed_.all, member) ||
                                            std::ranges::any_of(changed_.alone, [&](const MemberPath& path) {
                                                return path.back() == member && path == members_to(start);
                                            }));
}

bool RegionForest::any_start(std::uint32_t node, const std::function<bool(const RegionStart&)>& is) const {
    if (nodes_[node].op == Operator::leaf) return is(starts_[nodes_[node].left]);
    std::vector<std::uint32_t> rest{node};
    while (!rest.empty()) {
        const Node next = nodes_[rest.back()];
        rest.pop_back();
        if (next.op == Operator::leaf) {
            if (is(starts_[next.left])) return true;
            continue;
        }
        rest.push_back(next.left);
        if (next.op != Operator::not_) rest.push_back(next.right);
    }
    return false;
}

Attributes RegionForest::attributes_of(const RegionStart& start) const {
    Attributes attributes;
    if (start.above != none) attributes = above_[start.above].attributes;
    if (inside_ != none) return attributes;  // combinations below a region do not set attributes
    if (const auto* combination = std::get_if<Combination>(&source_.scene.objects[start.object]))
        attributes.apply(*combination);
    return attributes;
}

std::optional<RegionForest::Level> RegionForest::visit(RegionStart start) {
    const std::uint32_t object = start.object;
    source_.references.check(paths_.size() + 1);
    if (const auto known = constants_.find(object); known != constants_.end()) {
        operands_.push_back({known->second, none});
        return {};
    }
    const auto path = static_cast<std::uint32_t>(paths_.size());
    paths_.push_back({start.path, object, start.node});
    start.path = path;
    const Names::Kind kind = source_.names.kind(inside_ == none ? object : inside_);
    if (kind == Names::Kind::combination) {
        above_.push_back({object, matrix_of(start), attributes_of(start), start});
        return Level{static_cast<std::uint32_t>(above_.size() - 1), path, starts_.size()};
    }
    if (kind == Names::Kind::left_out) {
        nothing();
    } else if (kind == Names::Kind::air_region && !air_) {
        air_regions_.push_back(this->path(path));
        check_path_bytes(air_path_bytes_ += air_regions_.back().size());
        nothing();
    } else {
        starts_.push_back(start);
        operands_.push_back({Value::tree, add_node(Operator::leaf, static_cast<std::uint32_t>(starts_.size() - 1))});
    }
    return {};
}

std::optional<RegionForest::Level> RegionForest::follow(const Open& parent, std::uint32_t node, std::uint32_t child) {
    return visit({child, parent.level.path, parent.level.above, node});
}

void RegionForest::leave(const Open& done) {
    if (starts_.size() == done.level.first_start) constants_.emplace(done.object, operands_.back().value);
}

void RegionForest::operate(const Open& parent, std::uint32_t node) {
    const TreeNode& operation = source_.names.node(parent.object, node);
    const auto first = operands_.end() - operation.arity;
    std::vector<Value> values;
    for (auto operand = first; operand != operands_.end(); ++operand) values.push_back(operand->value);
    const Folded folded = fold(operation.op, values);
    std::uint32_t result = none;
    if (folded.value == Value::tree) {
        for (auto operand = first; operand != operands_.end(); ++operand)
            if (operand->value == Value::tree)
                result = result == none ? operand->node : add_node(folded.op, result, operand->node);
        if (folded.complement) result = add_node(Operator::not_, result);
    }
    operands_.erase(first, operands_.end());
    operands_.push_back({folded.value, result});
}

std::uint32_t RegionForest::add_node(Operator op, std::uint32_t left, std::uint32_t right) {
    nodes_.push_back({op, left, right});
    return static_cast<std::uint32_t>(nodes_.size() - 1);
}

double RegionForest::solids_in_terms() const {
    if (root_.value != Value::tree) return 0;
    // Operands come before their operators.
    struct Count {
        double terms, solids_in_terms, solids;
    };
    std::vector<Count> counts;
    counts.reserve(nodes_.size());
    for (const Node& node : nodes_) {
        if (node.op == Operator::leaf) {
            const auto solids = static_cast<double>(source_.instances[starts_[node.left].object]);
            counts.push_back({1, solids, solids});
            continue;
        }
        const Count a = counts[node.left], b = node.op == Operator::not_ ? Count{0, 0, 0} : counts[node.right];
        Count c{1, a.solids + b.solids, a.solids + b.solids};
        if (node.op == Operator::union_) c = {a.terms + b.terms, a.solids_in_terms + b.solids_in_terms, c.solids};
        if (node.op == Operator::difference) c = {a.terms, a.solids_in_terms + a.terms * b.solids, c.solids};
        if (node.op == Operator::intersection)
            c = {a.terms * b.terms, a.solids_in_terms * b.terms + b.solids_in_terms * a.terms, c.solids};
        counts.push_back(c);
    }
    return counts[root_.node].solids_in_terms;
}

void RegionForest::for_each_term(const std::function<void(std::uint32_t)>& call) {
    if (root_.value != Value::tree) return;
    std::vector<bool> starts_with_terms(starts_.size());

    // The operators that still have to be applied to a term further down, innermost first. They are a linked list,
    // whose tail terms share.
    enum class Pending { subtract_right, intersect_right, intersect_left };
    struct Context {
        Pending pending;
        std::uint32_t operand, outer;
    };
    std::vector<Context> contexts;
    struct Task {
        std::uint32_t node, context;
    };
    std::vector<Task> tasks{{root_.node, none}};

    const auto push = [&](std::uint32_t node, Pending pending, std::uint32_t operand, std::uint32_t outer) {
        contexts.push_back({pending, operand, outer});
        tasks.push_back({node, static_cast<std::uint32_t>(contexts.size() - 1)});
    };
    while (!tasks.empty()) {
        auto [term, context] = tasks.back();
        tasks.pop_back();
        const Node node = nodes_[term];
        if (node.op == Operator::union_) {
            tasks.push_back({node.right, context});
            tasks.push_back({node.left, context});
            continue;
        }
        if (node.op == Operator::difference || node.op == Operator::intersection) {
            const bool subtract = node.op == Operator::difference;
            push(node.left, subtract ? Pending::subtract_right : Pending::intersect_right, node.right, context);
            continue;
        }
        // Applies the pending operators. If the operand of an intersection is still to be split into terms, the term
        // waits in a new task; else it is complete.
        while (context != none) {
            const Context c = contexts[context];
            context = c.outer;
            if (c.pending == Pending::subtract_right) {
                term = add_node(Operator::difference, term, c.operand);
            } else if (c.pending == Pending::intersect_left) {
                term = add_node(Operator::intersection, c.operand, term);
            } else {
                push(c.operand, Pending::intersect_left, term, c.outer);
                term = none;
                break;
            }
        }
        if (term == none) continue;
        std::vector<bool>::reference has_term = starts_with_terms[leftmost(term)];
        has_equal_paths_ = has_equal_paths_ || has_term;
        has_term = true;
        call(term);
    }
}

std::uint32_t RegionForest::leftmost(std::uint32_t node) const {
    while (nodes_[node].op != Operator::leaf) node = nodes_[node].left;
    return nodes_[node].left;
}

std::string RegionForest::path(std::uint32_t number) const {
    std::vector<const std::string*> steps;
    for (; number != none; number = paths_[number].above) {
        const PathStep& step = paths_[number];
        steps.push_back(step.above == none ? &name_of(source_.scene.objects[step.object])
                                           : &source_.names.member_name(paths_[step.above].object, step.node));
    }
    std::string text;
    for (auto step = steps.rbegin(); step != steps.rend(); ++step) text += "/" + **step;
    return text;
}

}  // namespace csgrt
