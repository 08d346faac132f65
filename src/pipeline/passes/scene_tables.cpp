#include "pipeline/passes/scene_tables.hpp"

#include <algorithm>
#include <cstring>
#include <span>

namespace csgrt {
namespace {

/// Calls call(first, end) for the runs of blocks in which differs(first, end) is true.
template <class Differs, class Call>
void for_runs(std::size_t count, std::size_t block, const Differs& differs, const Call& call) {
    for (std::size_t first = 0, end = 0; first < count; first = end) {
        end = std::min(count, first + block);
        if (!differs(first, end)) continue;
        for (; end < count && differs(end, std::min(count, end + block)); end = std::min(count, end + block)) {
        }
        call(first, end);
    }
}

/// Copies what differs of a table. `bytes`: the elements of `now` in the device's precision.
template <class T>
void replace(Buffer& buffer, const SharedVector<T>& before, const SharedVector<T>& now,
             std::span<const std::byte> bytes) {
    if (now.shares(before)) return;
    if (now.empty()) return buffer.release();
    buffer.reserve(bytes.size());
    constexpr std::size_t block = 64;
    const auto differs = [&](std::size_t first, std::size_t end) {
        return before.size() != now.size() ||
               std::memcmp(before.data() + first, now.data() + first, (end - first) * sizeof(T)) != 0;
    };
    const std::size_t size = bytes.size() / now.size();
    for_runs(now.size(), block, differs, [&](std::size_t first, std::size_t end) {
        buffer.upload(bytes.data() + first * size, (end - first) * size, first * size);
    });
}

}  // namespace

SceneTables::SceneTables(Device& device, const CompiledScene& scene, const RecordConverter::Tables& tables)
    : scene_(scene),
      solids_(device, "solids", tables.solids),
      reals_(device, "solids' parameters", tables.reals),
      planes_(device, "planes", tables.planes),
      words_(device, "solids' parts", scene.words.get()),
      inner_nodes_(device, "bounding volumes of solids' parts", tables.inner_nodes),
      nodes_(device, "bounding volumes", tables.nodes),
      starts_(device, "solids' terms", scene.starts.get()),
      trees_(device, "trees", scene.trees.get()),
      materials_(device, "materials", std::vector<kernel::MaterialRecord>(scene.materials)),
      lights_(device, "lights"),
      display_(device, "bytes of a display", scene.display.get()),
      starting_(device, "nodes that start terms", scene.starting.get()),
      ends_(device, "ends of tiles") {}

bool SceneTables::takes(const CompiledScene& scene) const {
    return scene.reals.shares(scene_.reals) && scene.planes.shares(scene_.planes) && scene.words.shares(scene_.words) &&
           scene.inner_nodes.shares(scene_.inner_nodes) && scene.nodes.shares(scene_.nodes) &&
           scene.trees.shares(scene_.trees);
}

void SceneTables::take(const CompiledScene& scene, const RecordConverter::Tables& tables) {
    replace(solids_, scene_.solids, scene.solids, tables.solids);
    replace(starts_, scene_.starts, scene.starts, std::as_bytes(std::span(scene.starts.get())));
    replace(starting_, scene_.starting, scene.starting, std::as_bytes(std::span(scene.starting.get())));
    replace(display_, scene_.display, scene.display, std::as_bytes(std::span(scene.display.get())));
    using Materials = SharedList<kernel::MaterialRecord>;
    const Materials &before = scene_.materials, &now = scene.materials;
    constexpr std::size_t size = Materials::chunk_size, bytes = sizeof(kernel::MaterialRecord);
    materials_.reserve(now.size() * bytes);
    const auto differs = [&](std::size_t first, std::size_t) {
        return before.size() != now.size() || before.chunk(first / size).data() != now.chunk(first / size).data();
    };
    for_runs(now.size(), size, differs, [&](std::size_t first, std::size_t end) {
        const std::vector<kernel::MaterialRecord> run(now.begin() + static_cast<std::ptrdiff_t>(first),
                                                      now.begin() + static_cast<std::ptrdiff_t>(end));
        materials_.upload(run.data(), run.size() * bytes, first * bytes);
    });
    scene_ = scene;
}

void SceneTables::set_ends(const std::vector<float>& ends) {
    if (ends.empty()) return ends_.release();  // kernels get a null pointer
    ends_.reserve(ends.size() * sizeof(float));
    ends_.upload(ends);
}

void SceneTables::set_lights(const std::vector<std::byte>& lights) {
    lights_.reserve(lights.size());
    if (!lights.empty()) lights_.upload(lights);
}

}  // namespace csgrt
