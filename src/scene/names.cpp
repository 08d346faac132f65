#include "scene/names.hpp"

#include <bit>
#include <functional>
#include <utility>

#include "parallel.hpp"

namespace csgrt {

namespace {
constexpr std::size_t chunk = 8192;  // objects that a thread takes at once
}

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

Names::Names(const Scene& scene)
    : scene_(scene),
      slots_(std::bit_ceil(2 * scene.objects.size() + 2), Slot{0, none}),
      first_child_(scene.objects.size() + 1),
      is_solid_(scene.objects.size()) {
    const std::size_t count = scene.objects.size();
    std::vector<std::uint32_t> hashes(count);
    for_chunks(count, chunk, 0, [&](std::size_t first, std::size_t last, std::size_t) {
        for (std::size_t i = first; i < last; ++i) {
            hashes[i] = hash_of(name_of(scene.objects[i]));
            const auto* combination = std::get_if<Combination>(&scene.objects[i]);
            first_child_[i] = combination == nullptr ? 0 : combination->tree.nodes.size();
            is_solid_[i] = combination == nullptr;
        }
    });
    std::uint64_t children = 0;
    for (std::size_t object = 0; object < count; ++object) {
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
    for_chunks(count, chunk, 0, [&](std::size_t first, std::size_t last, std::size_t) {
        for (std::size_t i = first; i < last; ++i) {
            const auto* combination = std::get_if<Combination>(&scene.objects[i]);
            if (combination == nullptr) continue;
            const std::vector<TreeNode>& nodes = combination->tree.nodes;
            for (std::size_t k = 0; k < nodes.size(); ++k)
                children_[first_child_[i] + k] = nodes[k].op == Operator::leaf ? find(nodes[k].object) : operation;
        }
    });
}

std::vector<std::string> Names::top_objects() const {
    if (!scene_.top.empty()) return scene_.top;
    std::vector<bool> used(scene_.objects.size());
    for (const std::uint32_t child : children_)
        if (child < operation) used[child] = true;
    for (const std::uint32_t object : taken_) used[object] = used[find(name_of(scene_.objects[object]))];
    std::vector<std::string> top;
    for (std::size_t i = 0; i < scene_.objects.size(); ++i)
        if (!used[i]) top.push_back(name_of(scene_.objects[i]));
    return top;
}

}  // namespace csgrt
