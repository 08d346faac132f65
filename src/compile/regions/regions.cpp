#include "compile/regions/regions.hpp"

#include <algorithm>
#include <span>

#include "compile/linear.hpp"
#include "scene/instances.hpp"
#include "scene/vector.hpp"

namespace csgrt {

namespace {

constexpr std::uint32_t none = 0xffffffff;

}  // namespace

ObjectIndex::ObjectIndex(const Scene& scene, const Names& names, std::uint64_t max_instances)
    : scene_(scene),
      names_(names),
      // Groups of groups hold more references than solids, though not many times more.
      most_references_(8 * std::max({max_instances, Limits::instances, std::uint64_t{scene.objects.size()}})),
      solids_(scene.objects.size(), -1) {}

void ObjectIndex::check_references(std::uint64_t count) const {
    if (count > most_references_)
        throw Error(Status::scene,
                    "more than " + std::to_string(most_references_) + " references to combinations and solids");
}

void check_path_bytes(std::uint64_t bytes) {
    if (bytes > Limits::path_bytes)
        throw Error(Status::scene, "the paths of all regions have more than " + std::to_string(Limits::path_bytes) +
                                       " bytes together");
}

static std::uint32_t existing(std::uint32_t object, const std::string& name) {
    if (object == Names::none) throw Error(Status::scene, "there is no object '" + name + "'");
    return object;
}

std::uint32_t ObjectIndex::child(std::uint32_t object, std::size_t node) const {
    const std::uint32_t child = names_.child(object, node);
    if (child == Names::none) existing(child, std::get<Combination>(scene_.objects[object]).tree.nodes[node].object);
    return child;
}

double ObjectIndex::own_solids(std::uint32_t object) const {
    const auto* solid = std::get_if<Solid>(&scene_.objects[object]);
    return solid != nullptr ? static_cast<double>(instances_of(*solid)) : 0;
}

double ObjectIndex::solids_below(std::uint32_t object) {
    if (known_solids(object) >= 0) return known_solids(object);
    struct Frame {
        std::uint32_t object;
        std::size_t next;
        double solids;
    };
    std::vector<Frame> frames{{object, 0, own_solids(object)}};
    while (!frames.empty()) {
        Frame& frame = frames.back();
        const std::span<const std::uint32_t> children = names_.children(frame.object);
        if (frame.next == children.size()) {
            solids_[frame.object] = frame.solids;
            frames.pop_back();
            continue;
        }
        const std::size_t number = frame.next;
        if (children[number] != Names::operation && children[number] != Names::left_out) {
            const std::uint32_t child = this->child(frame.object, number);
            const double solids = known_solids(child);
            if (solids < 0) {
                frames.push_back({child, 0, own_solids(child)});
                continue;
            }
            frame.solids += solids;
        }
        ++frame.next;
    }
    return solids_[object];
}

RegionForest::RegionForest(const Scene& scene, ObjectIndex& index, const ObjectPath& object, bool air,
                           std::vector<std::string>& dropped)
    : scene_(scene), index_(index), air_(air) {
    visit(start_of(object), dropped);
    while (!frames_.empty()) {
        Frame& frame = frames_.back();
        const Above& above = above_[frame.above];
        const std::span<const std::uint32_t> children = index.children(above.object);
        if (frame.next == children.size()) {
            if (children.empty()) operands_.push_back(nothing);
            if (starts_.size() == frame.first_start) hollow_.emplace(above.object, operands_.back());
            frames_.pop_back();
            continue;
        }
        const std::uint32_t number = frame.next++;
        if (children[number] == Names::operation) {
            const TreeNode& node = std::get<Combination>(scene.objects[above.object]).tree.nodes[number];
            operate(node.op, node.arity);
        } else if (children[number] == Names::left_out) {
            operands_.push_back(nothing);
        } else {
            visit({index.child(above.object, number), frame.path, frame.above, number}, dropped);
        }
    }
    root_ = operands_.back();
}

RegionStart RegionForest::start_of(const ObjectPath& path) {
    RegionStart start{path.steps.front().object, none, none, 0};
    for (std::size_t i = 1; i < path.steps.size(); ++i) {
        above_.push_back({start.object, matrix_of(start), attributes_of(start)});
        const Names::Kind kind = index_.kind(start.object);
        const bool region = kind == Names::Kind::region || kind == Names::Kind::air_region;
        if (region && inside_ == nothing) inside_ = start.object;
        paths_.push_back({start.path, start.object});
        start = {path.steps[i].object, static_cast<std::uint32_t>(paths_.size() - 1),
                 static_cast<std::uint32_t>(above_.size() - 1), path.steps[i].node};
    }
    return start;
}

Matrix RegionForest::matrix_of(const RegionStart& start) const {
    if (start.above == none) return identity;
    const Above& above = above_[start.above];
    return compose(above.matrix, std::get<Combination>(scene_.objects[above.object]).tree.nodes[start.node].matrix);
}

Attributes RegionForest::attributes_of(const RegionStart& start) const {
    Attributes attributes;
    if (start.above != none) attributes = above_[start.above].attributes;
    if (inside_ != nothing) return attributes;  // below a region nothing sets them
    if (const auto* combination = std::get_if<Combination>(&scene_.objects[start.object]))
        attributes.apply(*combination);
    return attributes;
}

void RegionForest::visit(RegionStart start, std::vector<std::string>& dropped) {
    const std::uint32_t object = start.object;
    index_.check_references(paths_.size() + 1);
    if (const auto known = hollow_.find(object); known != hollow_.end()) {
        operands_.push_back(known->second);
        return;
    }
    const auto path = static_cast<std::uint32_t>(paths_.size());
    paths_.push_back({start.path, object});
    start.path = path;
    const Names::Kind kind = index_.kind(inside_ == nothing ? object : inside_);
    if (kind == Names::Kind::combination) {
        const auto above = static_cast<std::uint32_t>(above_.size());
        above_.push_back({object, matrix_of(start), attributes_of(start)});
        frames_.push_back({above, path, 0, starts_.size()});
        return;
    }
    if (kind == Names::Kind::left_out) {
        operands_.push_back(nothing);
        return;
    }
    if (kind == Names::Kind::air_region && !air_) {
        dropped.push_back(this->path(path));
        check_path_bytes(dropped_bytes_ += dropped.back().size());
        operands_.push_back(nothing);
        return;
    }
    starts_.push_back(start);
    operands_.push_back(add_node(Operator::leaf, static_cast<std::uint32_t>(starts_.size() - 1)));
}

void RegionForest::operate(Operator op, std::uint32_t arity) {
    const std::size_t first = operands_.size() - arity;
    std::uint32_t result = operands_[first];
    if (op == Operator::not_) result = complement(result);
    for (std::size_t i = first + 1; i < operands_.size(); ++i) result = combine(op, result, operands_[i]);
    operands_.resize(first);
    operands_.push_back(result);
}

std::uint32_t RegionForest::combine(Operator op, std::uint32_t left, std::uint32_t right) {
    switch (op) {
        case Operator::union_:
            if (left == nothing) return right;
            if (right == nothing) return left;
            if (left == everything || right == everything) return everything;
            break;
        case Operator::intersection:
            if (left == nothing || right == nothing) return nothing;
            if (left == everything) return right;
            if (right == everything) return left;
            break;
        case Operator::difference:
            if (left == nothing || right == everything) return nothing;
            if (right == nothing) return left;
            if (left == everything) return complement(right);
            break;
        default:  // xor
            if (left == nothing) return right;
            if (right == nothing) return left;
            if (left == everything) return complement(right);
            if (right == everything) return complement(left);
            break;
    }
    return add_node(op, left, right);
}

std::uint32_t RegionForest::complement(std::uint32_t operand) {
    if (operand == nothing) return everything;
    if (operand == everything) return nothing;
    return add_node(Operator::not_, operand);
}

std::uint32_t RegionForest::add_node(Operator op, std::uint32_t left, std::uint32_t right) {
    nodes_.push_back({op, left, right});
    return static_cast<std::uint32_t>(nodes_.size() - 1);
}

double RegionForest::solids_in_terms() const {
    if (root_ == nothing || root_ == everything) return 0;
    // Operands come before their operators.
    struct Count {
        double terms, solids_in_terms, solids;
    };
    std::vector<Count> counts;
    counts.reserve(nodes_.size());
    for (const Node& node : nodes_) {
        if (node.op == Operator::leaf) {
            const double solids = index_.solids_below(starts_[node.left].object);
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
    return counts[root_].solids_in_terms;
}

void RegionForest::for_each_term(const std::function<void(std::uint32_t)>& call) {
    if (root_ == nothing || root_ == everything) return;

    // What still has to be done to a term that is found further down, innermost first: a list that terms share.
    enum class Pending { subtract_right, intersect_right, intersect_left };
    struct Context {
        Pending pending;
        std::uint32_t operand, outer;
    };
    std::vector<Context> contexts;
    struct Task {
        std::uint32_t node, context;
    };
    std::vector<Task> tasks{{root_, none}};

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
        // A term: apply what is pending, until another operand must be taken apart first.
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
        if (term != none) call(term);
    }
}

const RegionStart& RegionForest::leftmost_start(std::uint32_t node) const {
    while (nodes_[node].op != Operator::leaf) node = nodes_[node].left;
    return starts_[nodes_[node].left];
}

std::string RegionForest::path(std::uint32_t number) const {
    std::vector<std::uint32_t> steps;
    for (; number != none; number = paths_[number].above) steps.push_back(paths_[number].object);
    std::string text;
    for (auto step = steps.rbegin(); step != steps.rend(); ++step) text += "/" + name_of(scene_.objects[*step]);
    return text;
}

}  // namespace csgrt
