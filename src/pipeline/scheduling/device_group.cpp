#include "pipeline/scheduling/device_group.hpp"

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <utility>

#include "base/clock.hpp"
#include "base/parallel.hpp"
#include "base/process.hpp"

namespace csgrt {
namespace {

// Parts of a device's share of what the rays cost. Of first hits, launches soon cost as much as rays; of every
// partition, what the host waits for in each (docs/experiments/gpu-frames.md).
constexpr std::uint64_t parts_of_first_hits = 8, parts_of_partitions = 5;

constexpr const char* registered_name = "registered memory";

}  // namespace

static std::atomic<std::uint64_t> next_number{1};

DeviceGroup::DeviceGroup(const std::vector<FoundDevice>& devices, const CompiledScene& scene,
                         const HostKernels& kernels, const Settings& settings, Readback readback)
    : number_(next_number++) {
    const auto start = Clock::now();
    for (const FoundDevice& device : devices) {
        devices_.push_back(
            std::make_unique<Device>(device, settings.max_memory, settings.threads, settings.device_timeout));
        pipelines_.push_back(std::make_unique<Pipeline>(*devices_.back(), scene, kernels, settings, readback));
    }
    setup_ms_ = milliseconds_since(start);
}

// One device alone takes all rays as batches of its own, unless it copies the first ones' pixels while it draws others;
// of every partition it has large ones.
std::uint64_t DeviceGroup::parts_of(const RayCosts& costs, bool every_partition) const {
    constexpr std::uint64_t large = RayCosts::of_shown << 22;
    const bool is_alone = pipelines_.size() == 1;
    if (is_alone && !pipelines_.front()->is_asynchronous()) return 1;
    return !every_partition ? parts_of_first_hits : is_alone ? 1 + costs.total() / large : parts_of_partitions;
}

// A thread for each device. What the first of the devices threw is thrown, once all threads have stopped.
void DeviceGroup::share(const RayCosts& costs, bool every_partition, Watch* watch, PipelineCounts& counts,
                        const Work& work) {
    const std::uint64_t rays = costs.rays(), parts_each = parts_of(costs, every_partition);
    const bool is_one = parts_each == 1 || rays <= tile_rays;
    const std::size_t devices = is_one ? 1 : pipelines_.size();
    Parts parts(costs, pipelines_.size(), parts_each, !every_partition);
    std::mutex mutex;
    bool is_taken = false;
    std::vector<std::exception_ptr> thrown(devices);
    const TakeRays take = [&] {
        const std::lock_guard lock(mutex);
        if (!is_one) return parts.take();
        return std::exchange(is_taken, true) ? RayRange{} : RayRange{0, rays};
    };
    if (watch) watch->begin(rays);
    const Told told = [&](std::uint64_t more) {
        if (watch) watch->add(more);
    };
    struct Following {
        Following(DeviceGroup& g, const std::atomic<bool>* stop) : group(g) { set(stop); }
        ~Following() { set(nullptr); }
        void set(const std::atomic<bool>* stop) {
            for (const auto& device : group.devices_) device->end_by(stop);
        }
        DeviceGroup& group;
    } following(*this, watch ? watch->stop() : nullptr);
    std::atomic<std::size_t> joined{0};
    on_threads(static_cast<unsigned>(devices), [&] {
        const std::size_t own_number = joined++;
        PipelineCounts own;
        try {
            work(*pipelines_[own_number], take, told, own);
        } catch (...) {
            const std::lock_guard lock(mutex);
            parts.stop();
            thrown[own_number] = std::current_exception();
        }
        own.kernels = covered_time(std::move(own.spans));
        const std::lock_guard lock(mutex);
        counts += own;
    });
    for (const std::exception_ptr& error : thrown)
        if (error) std::rethrow_exception(error);
}

void DeviceGroup::prepare(bool every_partition) {
    start_call();
    for_chunks(pipelines_.size(), 1, static_cast<unsigned>(pipelines_.size()),
               [&](std::size_t i, std::size_t, std::size_t) { pipelines_[i]->prepare(every_partition); });
}

void DeviceGroup::start_call() {
    for (const auto& device : devices_) device->cl().check_lost();
    drop_claims();
}

void DeviceGroup::drop_claims() {
    std::erase_if(claims_, [](const Claim& claim) {
        if (!claim.registered.expired()) return false;
        claim.device->release(registered_name, claim.bytes);
        return true;
    });
}

std::shared_ptr<RegisteredMemory> DeviceGroup::register_memory(std::span<const ChannelMemory> channels,
                                                               std::size_t pixels) {
    start_call();
    const std::size_t bytes = channels.size() * pixels * sizeof(float);
    if (bytes == 0) return nullptr;
    const std::shared_ptr<RegisteredMemory> registered(new RegisteredMemory(channels.front().pixels, bytes),
                                                       DeleteOwn());
    for (std::size_t i = 0; i < devices_.size(); ++i) {
        Device& device = *devices_[i];
        if (!pipelines_[i]->is_asynchronous() || bytes > std::min(device.available() / 2, device.max_buffer()))
            continue;
        registered->add(device);
        if (!registered->has(device)) continue;
        device.claim(registered_name, bytes);
        claims_.push_back({registered, &device, bytes});
    }
    return registered;
}

void DeviceGroup::render(const PreparedFrame& prepared, const RenderTarget& target, Watch* watch,
                         PipelineCounts& counts) {
    start_call();
    RenderTarget shared = target;  // until nothing more comes into it
    shared.threads = std::max(1u, thread_count(0) / static_cast<unsigned>(pipelines_.size()));
    struct Abandon {
        std::vector<std::unique_ptr<Pipeline>>& pipelines;
        bool is_finished = false;
        ~Abandon() {
            if (is_finished) return;
            for (const auto& pipeline : pipelines) pipeline->abandon();
        }
    } if_thrown{pipelines_};
    share(RayCosts(prepared.frame, target), prepared.frame.every_partition, watch, counts,
          [&](Pipeline& pipeline, const TakeRays& take, const Told& told, PipelineCounts& own) {
              pipeline.render(prepared, take, shared, told, own);
          });
    clear_around(prepared.frame, target);  // while the last batches' pixels are on their way
    for (const auto& pipeline : pipelines_) pipeline->finish();
    if_thrown.is_finished = true;
}

std::vector<RayPartitions> DeviceGroup::shoot(const PreparedFrame& prepared, const std::vector<Ray>& rays, Watch* watch,
                                              PipelineCounts& counts) {
    start_call();
    std::vector<RayPartitions> answers(rays.size());
    share(RayCosts(rays.size()), true, watch, counts,
          [&](Pipeline& pipeline, const TakeRays& take, const Told& told, PipelineCounts& own) {
              pipeline.shoot(prepared, rays, take, answers.data(), told, own);
          });
    return answers;
}

std::string DeviceGroup::name() const {
    std::string all;
    for (const auto& device : devices_) all += (all.empty() ? "" : " + ") + device->info().name;
    return all;
}

std::uint64_t DeviceGroup::device_bytes() const {
    std::uint64_t sum = 0;
    for (const auto& device : devices_) sum += device->allocated();
    return sum;
}

double DeviceGroup::build_ms() const {
    double longest = 0;
    for (const auto& pipeline : pipelines_) longest = std::max(longest, pipeline->build_ms());
    return setup_ms_ + longest;
}

}  // namespace csgrt
