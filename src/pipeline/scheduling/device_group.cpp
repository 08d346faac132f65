#include "pipeline/scheduling/device_group.hpp"

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <utility>

#include "base/clock.hpp"
#include "base/parallel.hpp"
#include "device/driver_call.hpp"

namespace csgrt {
namespace {

constexpr const char* registered_name = "registered memory";

}  // namespace

static std::atomic<std::uint64_t> next_number{1};

DeviceGroup::DeviceGroup(const std::vector<FoundDevice>& devices, const CompiledScene& scene,
                         const RecordConverter& records, const Settings& settings, Readback readback)
    : number_(next_number++) {
    const auto start = Clock::now();
    for (const FoundDevice& device : devices) {
        devices_.push_back(std::make_unique<Device>(device, settings.max_memory, settings.device_timeout));
        pipelines_.push_back(std::make_unique<Pipeline>(*devices_.back(), scene, records, settings, readback));
    }
    setup_ms_ = milliseconds_since(start);
}

// The parts of a frame. A device's share of first hits is divided into 8 parts; in smaller parts launches would cost as
// much as rays. A share of every partition is divided into 5 parts, since the host waits in each part
// (docs/experiments.md). A single device gets all rays at once, unless it copies the first pixels while it draws
// others.
Parts DeviceGroup::parts_of(std::uint64_t rays, std::uint64_t row, std::size_t devices, bool every_partition) const {
    if (devices == 1 && (every_partition || !pipelines_.front()->is_asynchronous()))
        return Parts(rays, row, 1, rays, rays);
    const std::uint64_t worth_launches = devices == 1 ? 1 << 20 : 1 << 16;
    const std::uint64_t most =
        std::max(rays / devices / (every_partition ? 5 : 8), devices == 1 ? worth_launches : row);
    return Parts(rays, row, devices, std::min(worth_launches, most), most);
}

// Each device has a thread. If devices throw, the exception of the first device in order is rethrown once all threads
// have stopped. `row`: rays of a row of a picture's tiles.
void DeviceGroup::share(std::uint64_t rays, std::uint64_t row, bool every_partition, Watch* watch,
                        PipelineCounts& counts, const Work& work) {
    const std::size_t devices = rays <= tile_rays ? 1 : pipelines_.size();
    Parts parts = parts_of(rays, row, devices, every_partition);
    std::mutex mutex;
    std::vector<std::exception_ptr> thrown(devices);
    const TakeRays take = [&] {
        const std::lock_guard lock(mutex);
        return parts.take();
    };
    if (watch) watch->begin(rays);
    const ReportDone report_done = [&](std::uint64_t more) {
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
    const auto draw = [&] {
        const std::size_t own_number = joined++;
        PipelineCounts own;
        try {
            work(*pipelines_[own_number], take, report_done, own);
        } catch (...) {
            const std::lock_guard lock(mutex);
            parts.stop();
            thrown[own_number] = std::current_exception();
        }
        own.kernels += covered_time(std::move(own.spans));
        const std::lock_guard lock(mutex);
        counts += own;
    };
    {
        JoinedThreads others;  // these threads mostly wait for devices, so the pool's threads are not used
        while (others.size() + 1 < devices && others.add(draw)) {
        }
        draw();
    }
    for (const std::exception_ptr& error : thrown)
        if (error) std::rethrow_exception(error);
}

void DeviceGroup::set_scene(const CompiledScene& scene, const RecordConverter& records,
                            std::shared_ptr<const void> owner) {
    start_call();
    for (const auto& pipeline : pipelines_) pipeline->set_scene(scene, records);
    owner_ = std::move(owner);
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
    const auto first = std::ranges::find_if(channels, &ChannelMemory::has_memory);
    const auto count = static_cast<std::size_t>(std::ranges::count_if(channels, &ChannelMemory::has_memory));
    const std::size_t bytes = count * pixels * sizeof(float);
    if (bytes == 0) return nullptr;
    const std::shared_ptr<RegisteredMemory> registered(new RegisteredMemory(first->pixels, bytes), DeleteInCall());
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
    struct Abandon {
        std::vector<std::unique_ptr<Pipeline>>& pipelines;
        bool is_finished = false;
        ~Abandon() {
            if (is_finished) return;
            for (const auto& pipeline : pipelines) pipeline->abandon();
        }
    } if_thrown{pipelines_};
    const std::uint64_t row = std::max(1u, kernel::tiles_across(prepared.frame.screen)) * std::uint64_t{tile_rays};
    const bool is_whole = prepared.frame.every_partition || prepared.edges;  // on one device
    share(prepared.rays, row, is_whole, watch, counts,
          [&](Pipeline& pipeline, const TakeRays& take, const ReportDone& report_done, PipelineCounts& own) {
              pipeline.render(prepared, take, target, report_done, own);
          });
    clear_around(prepared.frame, target);  // while the last batches' pixels are copied
    for (const auto& pipeline : pipelines_) pipeline->finish();
    if_thrown.is_finished = true;
}

void DeviceGroup::trace_list(const kernel::Frame& frame, const RayList& rays, RowReceiver& receiver, Watch* watch,
                             PipelineCounts& counts) {
    start_call();
    share(rays.size(), 1, true, watch, counts,
          [&](Pipeline& pipeline, const TakeRays& take, const ReportDone& report_done, PipelineCounts& own) {
              receiver.guard([&] { pipeline.trace_list(frame, rays, take, receiver, report_done, own); });
          });
}

bool DeviceGroup::can_draw(const CompiledScene& scene) const {
    return std::ranges::all_of(pipelines_, [&](const auto& pipeline) { return pipeline->can_draw(scene); });
}

bool DeviceGroup::uses_driver() const {
    return !std::ranges::all_of(devices_, [](const auto& device) { return is_native(device->info()); });
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
