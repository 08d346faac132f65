#include "pipeline/pipelines.hpp"

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <utility>

#include "base/clock.hpp"
#include "base/parallel.hpp"

namespace csgrt {
namespace {

// Parts of a device's share of what the rays cost. Of first hits, launches soon cost as much as rays; of every partition, what the host
// waits for in each (docs/experiments/gpu-frames.md).
constexpr std::uint64_t parts_of_first_hits = 8, parts_of_partitions = 5;

constexpr const char* known_name = "picture of the host's";
// Of device memory, the scene's and all else but other pictures; and less of it where not all of a picture becomes known, for tiles
// grow yet.
constexpr std::uint64_t most_bytes_a_pixel = 64, bytes_a_pixel = 60;

/// Of a picture's, how many planes a device has room for. `own`: what it holds besides.
std::size_t planes_fitting(const Device& device, std::uint64_t own, std::size_t planes, std::uint64_t pixels) {
    const std::uint64_t plane = std::max<std::uint64_t>(1, pixels * sizeof(float));
    const auto fitting = [&](std::uint64_t all) -> std::uint64_t {
        return std::min({device.available() / 2, device.max_buffer(), all - std::min(all, own)}) / plane;
    };
    return fitting(most_bytes_a_pixel * pixels) >= planes ? planes : std::min<std::uint64_t>(planes, fitting(bytes_a_pixel * pixels));
}

}  // namespace

static std::atomic<std::uint64_t> next_number{1};

Pipelines::Pipelines(const std::vector<FoundDevice>& devices, const CompiledScene& scene, const HostKernels& kernels,
                     const Settings& settings, Readback readback)
    : number_(next_number++) {
    const auto start = Clock::now();
    for (const FoundDevice& device : devices) {
        devices_.push_back(std::make_unique<Device>(device, settings.max_memory, settings.threads));
        pipelines_.push_back(std::make_unique<Pipeline>(*devices_.back(), scene, kernels, settings, readback));
    }
    setup_ms_ = milliseconds_since(start);
}

// One device alone takes all rays as tiles of its own, unless it copies the first ones' pixels while it draws others; of every
// partition it has large ones.
std::uint64_t Pipelines::parts_of(const RayCosts& costs, bool every_partition) const {
    constexpr std::uint64_t large = RayCosts::of_shown << 22;
    const bool is_alone = pipelines_.size() == 1;
    if (is_alone && !pipelines_.front()->copies_beside()) return 1;
    return !every_partition ? parts_of_first_hits : is_alone ? 1 + costs.total() / large : parts_of_partitions;
}

// A thread for each device. What the first of the devices threw is thrown, once all threads have stopped.
void Pipelines::share(const RayCosts& costs, bool every_partition, const Progress& progress, PipelineCounts& counts, const Work& work) {
    const std::uint64_t rays = costs.rays(), parts_each = parts_of(costs, every_partition);
    const bool is_one = parts_each == 1 || rays <= block_rays;
    const std::size_t devices = is_one ? 1 : pipelines_.size();
    Parts parts(costs, pipelines_.size(), parts_each, !every_partition);
    std::mutex mutex;
    std::uint64_t done = 0;
    bool is_taken = false;
    std::vector<std::exception_ptr> thrown(devices);
    const TakeRays take = [&] {
        const std::lock_guard lock(mutex);
        if (!is_one) return parts.take();
        return std::exchange(is_taken, true) ? RayRange{} : RayRange{0, rays};
    };
    const auto tell = [&] {
        if (progress && !progress(rays == 0 ? 1.0 : static_cast<double>(done) / static_cast<double>(rays)))
            throw Error(Status::interrupted, "interrupted");
    };
    const Pipeline::Told told = [&](std::uint64_t more) {
        const std::lock_guard lock(mutex);
        done += more;
        tell();
    };
    if (rays == 0) tell();
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
        const std::lock_guard lock(mutex);
        counts += own;
    });
    for (const std::exception_ptr& error : thrown)
        if (error) std::rethrow_exception(error);
}

void Pipelines::prepare(bool every_partition) {
    for_chunks(pipelines_.size(), 1, static_cast<unsigned>(pipelines_.size()),
               [&](std::size_t i, std::size_t, std::size_t) { pipelines_[i]->prepare(every_partition); });
}

void Pipelines::forget() {
    std::erase_if(claims_, [](const Claim& claim) {
        if (!claim.picture.expired()) return false;
        claim.device->release(known_name, claim.bytes);
        return true;
    });
}

std::shared_ptr<KnownPicture> Pipelines::make_known(std::span<const ChannelPlane> planes, std::size_t pixels) {
    forget();
    const auto known = std::make_shared<KnownPicture>(planes.empty() ? nullptr : planes.front().pixels, pixels);
    std::vector<KnownPicture::Wanted> wanted;
    for (std::size_t i = 0; i < devices_.size(); ++i) {
        const Device& device = *devices_[i];
        if (pipelines_[i]->copies_beside())
            wanted.push_back({&device, planes_fitting(device, device.allocated() - claimed_of(device), planes.size(), pixels)});
    }
    known->make_known(wanted);
    for (const auto& device : devices_) {
        const std::uint64_t bytes = known->planes_known_to(*device) * pixels * sizeof(float);
        if (bytes == 0) continue;
        device->claim(known_name, bytes);
        claims_.push_back({known, device.get(), bytes});
    }
    return known;
}

/// Bytes that the device's driver holds of pictures.
std::uint64_t Pipelines::claimed_of(const Device& device) const {
    std::uint64_t sum = 0;
    for (const Claim& claim : claims_) sum += claim.device == &device ? claim.bytes : 0;
    return sum;
}

void Pipelines::keep_small(KnownPicture& known) {
    const std::uint64_t plane = known.pixels() * sizeof(float), most = most_bytes_a_pixel * known.pixels();
    const auto is_its = [&](const Claim& claim) { return claim.picture.lock().get() == &known; };
    std::vector<KnownPicture::Wanted> wanted;
    bool are_fewer = false;
    for (const Claim& claim : claims_) {
        if (!is_its(claim)) continue;
        const std::uint64_t held = claim.device->allocated() - (claimed_of(*claim.device) - claim.bytes);
        const std::uint64_t surplus = held - std::min(held, most);
        wanted.push_back({claim.device, (claim.bytes - std::min(claim.bytes, surplus)) / plane});
        are_fewer = are_fewer || wanted.back().planes < known.planes_known_to(*claim.device);
    }
    if (!are_fewer) return;
    known.make_known(wanted);
    for (Claim& claim : claims_) {
        if (!is_its(claim)) continue;
        const std::uint64_t left = known.planes_known_to(*claim.device) * plane;
        claim.device->release(known_name, claim.bytes - left);
        claim.bytes = left;
    }
}

void Pipelines::render(const PreparedFrame& prepared, const RenderTarget& target, const Progress& progress,
                       PipelineCounts& counts) {
    forget();
    RenderTarget shared = target;  // until nothing more comes into it
    shared.threads = std::max(1u, thread_count(0) / static_cast<unsigned>(pipelines_.size()));
    struct Abandon {
        std::vector<std::unique_ptr<Pipeline>>& pipelines;
        ~Abandon() {
            for (const auto& pipeline : pipelines) pipeline->abandon();
        }
    } if_thrown{pipelines_};
    share(RayCosts(prepared.frame, target), prepared.frame.every_partition, progress, counts,
          [&](Pipeline& pipeline, const TakeRays& take, const Pipeline::Told& told, PipelineCounts& own) {
              pipeline.render(prepared, take, shared, told, own);
          });
    clear_around(prepared.frame, target);  // while the last tiles' pixels are on their way
    for (const auto& pipeline : pipelines_) pipeline->finish();
}

std::vector<RayPartitions> Pipelines::shoot(const PreparedFrame& prepared, const std::vector<Ray>& rays,
                                            const Progress& progress, PipelineCounts& counts) {
    forget();
    std::vector<RayPartitions> answers(rays.size());
    share(RayCosts(rays.size()), true, progress, counts,
          [&](Pipeline& pipeline, const TakeRays& take, const Pipeline::Told& told, PipelineCounts& own) {
              pipeline.shoot(prepared, rays, take, answers.data(), told, own);
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
    return setup_ms_ + longest;
}

}  // namespace csgrt
