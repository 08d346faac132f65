#include "scene/names.hpp"

#include <algorithm>
#include <atomic>
#include <bit>
#include <functional>
#include <iterator>
#include <mutex>
#include <unordered_map>
#include <unordered_set>
#include <utility>

#include "base/prefetch.hpp"
#include "base/parallel.hpp"
#include "scene/solids/arb_form.hpp"

namespace csgrt {

namespace {

constexpr std::size_t chunk = 8192;  // number of objects that a thread takes at a time

Names::Kind kind_of(const Object& object) {
    using Kind = Names::Kind;
    if (const auto* combination = std::get_if<Combination>(&object))
        return !combination->region ? Kind::combination : combination->air == 0 ? Kind::region : Kind::air_region;
    const Shape& shape = std::get<Solid>(object).shape;
    if (std::holds_alternative<Unsupported>(shape)) return Kind::unsupported;
    if (const auto* arb = std::get_if<Arb>(&shape)) return is_concave(*arb) ? Kind::composite : Kind::solid;
    return std::holds_alternative<Pipe>(shape) || std::holds_alternative<Cline>(shape) ? Kind::composite : Kind::solid;
}

}  // namespace

std::uint32_t Names::hash_of(std::string_view name) {
    const std::uint64_t hash = std::hash<std::string_view>{}(name);
    return static_cast<std::uint32_t>(hash ^ hash >> 32);
}

std::uint32_t Names::find(std::string_view name, std::uint32_t hash) const {
    for (std::size_t i = hash & (slots_.size() - 1);; i = (i + 1) & (slots_.size() - 1)) {
        const Slot& slot = slots_[i];
        if (slot.object == none) return none;
        if (slot.hash == hash && name_of(scene_.objects[slot.object]) == name) return slot.object;
    }
}

/// Finds members whose names in paths differ from their objects' names; most trees have none. `sorted`: memory that
/// calls reuse.
void Names::name_members(std::uint32_t object, const std::vector<TreeNode>& nodes, std::vector<std::uint32_t>& sorted,
                         MemberNames& found) const {
    const std::uint32_t* const own = children_.data() + first_child_[object];
    bool is_simple = true;
    sorted.clear();
    for (std::size_t k = 0; k < nodes.size(); ++k) {
        if (nodes[k].op != Operator::leaf) continue;
        is_simple = is_simple && nodes[k].name.empty() && own[k] != none;
        sorted.push_back(own[k]);
    }
    if (!std::is_sorted(sorted.begin(), sorted.end())) std::sort(sorted.begin(), sorted.end());
    if (is_simple && std::adjacent_find(sorted.begin(), sorted.end()) == sorted.end()) return;
    const bool are_plain = !has_ambiguous_names_ &&
                           std::ranges::all_of(nodes, [](const TreeNode& node) { return node.name.empty(); }) &&
                           (sorted.empty() || sorted.back() != none);
    if (are_plain) {  // no other name looks like a number
        std::unordered_map<std::uint32_t, std::uint32_t> uses;
        for (std::uint32_t k = 0; k < nodes.size(); ++k)
            if (nodes[k].op == Operator::leaf)
                if (const std::uint32_t number = ++uses[own[k]]; number > 1)
                    found.emplace_back(Member(object, k), numbered(nodes[k].object, number));
        return;
    }
    std::unordered_set<std::string> taken;
    for (const TreeNode& node : nodes)
        if (!node.name.empty()) taken.insert(node.name);
    std::unordered_set<std::string> given;
    std::unordered_map<std::string_view, std::uint32_t> times;
    for (std::uint32_t k = 0; k < nodes.size(); ++k) {
        if (nodes[k].op != Operator::leaf) continue;
        std::string name = nodes[k].name;
        if (name.empty() || !given.insert(name).second) {
            const std::string& base = name.empty() ? nodes[k].object : nodes[k].name;
            std::uint32_t& number = times[base];
            do {
                name = numbered(base, ++number);
            } while (!taken.insert(name).second);
        }
        if (name != nodes[k].object) found.emplace_back(Member(object, k), std::move(name));
    }
}

std::string numbered(std::string name, std::uint32_t number) {
    return number < 2 ? std::move(name) : std::move(name) + "@" + std::to_string(number);
}

Names::Names(const Scene& scene) : scene_(scene), first_child_(scene.objects.size() + 1), kinds_(scene.objects.size()) {
    const std::size_t count = scene.objects.size(), slots = std::bit_ceil(2 * count + 2);
    reserve_cleared(slots_, slots);
    slots_.assign(slots, Slot{0, none});
    std::vector<std::uint32_t> hashes(count);
    std::atomic<bool> is_ambiguous = false;
    for_chunks(count, chunk, 0, [&](std::size_t first, std::size_t last, std::size_t) {
        for (std::size_t i = first; i < last; ++i) {
            if (name_of(scene.objects[i]).find_first_of("/@") != std::string::npos) is_ambiguous = true;
            hashes[i] = hash_of(name_of(scene.objects[i]));
            const auto* combination = std::get_if<Combination>(&scene.objects[i]);
            first_child_[i] = combination == nullptr ? 0 : combination->tree.nodes.size();
            kinds_[i] = kind_of(scene.objects[i]);
        }
    });
    has_ambiguous_names_ = is_ambiguous;
    std::uint64_t children = 0;
    for (std::size_t object = 0; object < count; ++object) {
        constexpr std::size_t soon = 16;
        if (object + soon < count) prefetch_line(&slots_[hashes[object + soon] & (slots - 1)]);
        std::size_t i = hashes[object] & (slots_.size() - 1);
        for (; slots_[i].object != none; i = (i + 1) & (slots_.size() - 1)) {
            if (slots_[i].hash == hashes[object] &&
                name_of(scene.objects[slots_[i].object]) == name_of(scene.objects[object]))
                break;
        }
        if (slots_[i].object == none) {
            slots_[i] = {hashes[object], static_cast<std::uint32_t>(object)};
        } else {
            taken_.push_back(static_cast<std::uint32_t>(object));
        }
        children += std::exchange(first_child_[object], children);
    }
    first_child_[count] = children;
    children_.resize(children);
    for (std::uint32_t i = 0; i < std::min(scene.top.size(), scene.top_matrices.size()); ++i)
        top_.emplace(find(scene.top[i]), i);
    std::mutex mutex;
    for_chunks(count, chunk, 0, [&](std::size_t first, std::size_t last, std::size_t) {
        std::vector<std::uint32_t> sorted;
        MemberNames members;
        for (std::size_t i = first; i < last; ++i) {
            if (kinds_[i] >= Kind::solid) continue;
            const std::vector<TreeNode>& nodes = std::get<Combination>(scene.objects[i]).tree.nodes;
            // All hashes are computed first, while the table's memory is prefetched.
            std::uint32_t* const own = children_.data() + first_child_[i];
            for (std::size_t k = 0; k < nodes.size(); ++k) {
                if (nodes[k].op != Operator::leaf) continue;
                own[k] = hash_of(nodes[k].object);
                prefetch_line(&slots_[own[k] & (slots - 1)]);
            }
            for (std::size_t k = 0; k < nodes.size(); ++k) {
                if (nodes[k].op != Operator::leaf) continue;
                if (const Slot& slot = slots_[own[k] & (slots - 1)]; slot.object != none)
                    prefetch_whole(scene.objects[slot.object]);
            }
            for (std::size_t k = 0; k < nodes.size(); ++k)
                own[k] = nodes[k].op == Operator::leaf ? find(nodes[k].object, own[k]) : operation;
            name_members(static_cast<std::uint32_t>(i), nodes, sorted, members);
        }
        const std::lock_guard lock(mutex);
        std::ranges::move(members, std::back_inserter(member_names_));
    });
    const auto before = [](const auto& a, const auto& b) { return a.first < b.first; };
    if (!std::ranges::is_sorted(member_names_, before)) std::ranges::sort(member_names_, before);
    for (const auto& [member, name] : member_names_)
        if (!node(member.first, member.second).name.empty()) is_ambiguous = true;
    has_ambiguous_names_ = is_ambiguous;
}

std::uint32_t Names::member(std::uint32_t object, std::string_view name) const {
    for (auto entry = first_name({object, 0}); entry != member_names_.end() && entry->first.first == object; ++entry)
        if (entry->second == name) return entry->first.second;
    const std::uint32_t named = find(name);
    const std::span<const std::uint32_t> all = children(object);
    for (std::uint32_t k = 0; k < all.size(); ++k) {
        const bool may_be = all[k] == named || all[k] == none || all[k] == left_out;
        if (may_be && all[k] != operation && member_name(object, k) == name) return k;
    }
    return none;
}

std::vector<std::string> Names::top_objects() const {
    if (!scene_.top.empty()) return scene_.top;
    std::vector<bool> used(scene_.objects.size());
    for (const std::uint32_t child : children_)
        if (child < left_out) used[child] = true;
    for (const std::uint32_t object : taken_) used[object] = used[find(name_of(scene_.objects[object]))];
    std::vector<std::string> top;
    for (std::size_t i = 0; i < scene_.objects.size(); ++i)
        if (!used[i]) top.push_back(name_of(scene_.objects[i]));
    return top;
}

}  // namespace csgrt
