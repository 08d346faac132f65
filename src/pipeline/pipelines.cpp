#include "pipeline/pipelines.hpp"

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>

#include "device/choice.hpp"
#include "parallel.hpp"

namespace csgrt {
namespace {

// Parts a device, so that one that is slower, or has more to see, keeps the others waiting little.
constexpr std::uint64_t parts_each = 8;

std::uint64_t part_size(std::uint64_t rays, std::size_t devices) {
    if (devices == 1) return rays;
    const std::uint64_t parts = parts_each * devices;
    const std::uint64_t size = (rays + parts - 1) / parts;
    return (size + block_rays - 1) / block_rays * block_rays;
}

}  // namespace

Pipelines::Pipelines(const CompiledScene& scene, const HostKernels& kernels, const Settings& settings) {
    const std::vector<FoundDevice> found = find_devices();
    for (const std::size_t number : choose_devices(infos_of(found), settings.device)) {
        devices_.push_back(std::make_unique<Device>(found[number], settings.max_memory));
        pipelines_.push_back(std::make_unique<Pipeline>(*devices_.back(), scene, kernels, settings));
    }
}

// A thread for each device. What the foremost part threw is thrown, once all threads have stopped.
void Pipelines::share(std::uint64_t rays, const Progress& progress, PipelineCounts& counts, const Work& work) {
    const std::uint64_t size = part_size(rays, pipelines_.size());
    if (pipelines_.size() == 1 || size >= rays) {
        work(*pipelines_.front(), {0, rays}, progress, counts);
        return;
    }
    std::atomic<std::uint64_t> next{0};
    std::atomic<std::size_t> joined{0};
    std::mutex mutex;
    std::uint64_t done = 0, thrown_by = rays;
    std::exception_ptr thrown;
    on_threads(static_cast<unsigned>(pipelines_.size()), [&] {
        Pipeline& pipeline = *pipelines_[joined++];
        PipelineCounts own;
        for (std::uint64_t first; (first = next.fetch_add(size)) < rays;) {
            const RayRange part{first, std::min(rays, first + size)};
            const Progress told = [&](double fraction) {
                const std::lock_guard lock(mutex);
                const double here = fraction * static_cast<double>(part.end - part.first);
                return !progress || progress((static_cast<double>(done) + here) / static_cast<double>(rays));
            };
            try {
                work(pipeline, part, told, own);
            } catch (...) {
                const std::lock_guard lock(mutex);
                next = rays;
                if (part.first < thrown_by) {
                    thrown_by = part.first;
                    thrown = std::current_exception();
                }
                break;
            }
            const std::lock_guard lock(mutex);
            done += part.end - part.first;
        }
        const std::lock_guard lock(mutex);
        counts += own;
    });
    if (thrown) std::rethrow_exception(thrown);
}

void Pipelines::prepare(bool every_partition) {
    for_chunks(pipelines_.size(), 1, static_cast<unsigned>(pipelines_.size()),
               [&](std::size_t i, std::size_t, std::size_t) { pipelines_[i]->prepare(every_partition); });
}

void Pipelines::render(const PreparedFrame& prepared, const RenderTarget& target, const Progress& progress,
                       PipelineCounts& counts) {
    RenderTarget shared = target;  // until nothing more comes into it
    shared.threads = std::max(1u, thread_count(0) / static_cast<unsigned>(pipelines_.size()));
    struct Abandon {
        std::vector<std::unique_ptr<Pipeline>>& pipelines;
        ~Abandon() {
            for (const auto& pipeline : pipelines) pipeline->abandon();
        }
    } if_thrown{pipelines_};
    share(prepared.rays, progress, counts, [&](Pipeline& pipeline, RayRange part, const Progress& told, PipelineCounts& own) {
        pipeline.render(prepared, part, shared, told, own);
    });
    for (const auto& pipeline : pipelines_) pipeline->finish();
}

std::vector<RayPartitions> Pipelines::shoot(const PreparedFrame& prepared, const std::vector<Ray>& rays,
                                            const Progress& progress, PipelineCounts& counts) {
    std::vector<RayPartitions> answers(rays.size());
    share(rays.size(), progress, counts, [&](Pipeline& pipeline, RayRange part, const Progress& told, PipelineCounts& own) {
        pipeline.shoot(prepared, std::span(rays).subspan(part.first, part.end - part.first), answers.data() + part.first, told, own);
    });
    return answers;
}

std::string Pipelines::name() const {
    std::string all;
    for (const auto& device : devices_) all += (all.empty() ? "" : " + ") + device->info().name;
    return all;
}

std::uint64_t Pipelines::device_bytes() const {
    std::uint64_t sum = 0;
    for (const auto& device : devices_) sum += device->allocated();
    return sum;
}

double Pipelines::build_ms() const {
    double longest = 0;
    for (const auto& pipeline : pipelines_) longest = std::max(longest, pipeline->build_ms());
    return longest;
}

}  // namespace csgrt
