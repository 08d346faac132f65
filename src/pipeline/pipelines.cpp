#include "pipeline/pipelines.hpp"

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <optional>

#include "device/choice.hpp"
#include "parallel.hpp"

namespace csgrt {
namespace {

// Parts of a device's share of the rays. Near the end they become smaller, so that one that is slower, or has more to see, keeps the
// others waiting little; and of first hits the first ones are, so that their pixels are soon on their way while others are drawn. Of
// those, launches soon cost as much as rays; of every partition, what the host waits for in each (bench/NOTES.md).
constexpr std::uint64_t parts_of_first_hits = 8, parts_of_partitions = 6;

// Each device takes one after another.
class Parts {
public:
    Parts(std::uint64_t rays, std::size_t devices, std::uint64_t parts, bool begin_small)
        : rays_(rays), devices_(devices), parts_(parts), begin_small_(begin_small) {}

    /// The next one; empty if there is none.
    RayRange take() {
        const std::uint64_t least = devices_ > 1 ? 1 << 16 : 1 << 20;  // rays that are worth launches of their own
        const std::uint64_t share = rays_ / devices_;
        const std::uint64_t most = devices_ > 1 ? share / parts_ : std::max(std::min(share, least), share / parts_);
        const std::uint64_t begin = begin_small_ ? most >> (taken_ < devices_ ? 2 : taken_ < 2 * devices_ ? 1 : 0) : most;
        const std::uint64_t end = (rays_ - next_) / devices_ / 2;
        const std::uint64_t size = std::clamp(std::min(begin, end), std::max(most / 4, std::min(most, least)), most);
        const std::uint64_t blocks = std::max<std::uint64_t>(1, (size + block_rays - 1) / block_rays);
        const RayRange part{next_, std::min(rays_, next_ + blocks * block_rays)};
        next_ = part.end;
        ++taken_;
        return part;
    }
    void stop() { next_ = rays_; }

private:
    std::uint64_t rays_, devices_, parts_, next_ = 0, taken_ = 0;
    bool begin_small_;
};

constexpr const char* known_name = "picture of the host's";
// Of device memory, the scene's and all else but other pictures: a small one is soon enough put by the host.
constexpr std::uint64_t most_bytes_a_pixel = 64;

}  // namespace

Pipelines::Pipelines(const CompiledScene& scene, const HostKernels& kernels, const Settings& settings, Readback readback) {
    const std::vector<FoundDevice> found = find_devices();
    for (const std::size_t number : choose_devices(infos_of(found), settings.device)) {
        devices_.push_back(std::make_unique<Device>(found[number], settings.max_memory));
        pipelines_.push_back(std::make_unique<Pipeline>(*devices_.back(), scene, kernels, settings, readback));
    }
}

// One device alone takes all rays as tiles of its own, unless it copies the first ones' pixels while it draws others.
std::uint64_t Pipelines::parts_of(bool every_partition) const {
    const bool is_alone = pipelines_.size() == 1 && (every_partition || !pipelines_.front()->copies_beside());
    return is_alone ? 1 : every_partition ? parts_of_partitions : parts_of_first_hits;
}

// A thread for each device. What the foremost part threw is thrown, once all threads have stopped.
void Pipelines::share(std::uint64_t rays, bool every_partition, const Progress& progress, PipelineCounts& counts,
                      const Work& work) {
    const std::uint64_t parts_each = parts_of(every_partition);
    Parts parts(rays, pipelines_.size(), parts_each, !every_partition);
    if (parts_each == 1 || rays <= block_rays) {
        work(*pipelines_.front(), {0, rays}, [] { return RayRange{}; }, progress, counts);
        if (rays == 0 && progress && !progress(1)) throw Error(Status::interrupted, "interrupted");  // no tile has asked
        return;
    }
    std::atomic<std::size_t> joined{0};
    std::mutex mutex;
    std::uint64_t done = 0, thrown_by = rays;
    std::exception_ptr thrown;
    const auto next = [&] {
        const std::lock_guard lock(mutex);
        return parts.take();
    };
    on_threads(static_cast<unsigned>(pipelines_.size()), [&] {
        Pipeline& pipeline = *pipelines_[joined++];
        PipelineCounts own;
        std::optional<RayRange> ahead;
        const auto peek = [&] {
            if (!ahead) ahead = next();
            return *ahead;
        };
        const auto take = [&] {
            const RayRange part = peek();
            ahead.reset();
            return part;
        };
        for (RayRange part = take(); part.first < part.end; part = take()) {
            const Progress told = [&](double fraction) {
                const std::lock_guard lock(mutex);
                const double here = fraction * static_cast<double>(part.end - part.first);
                return !progress || progress((static_cast<double>(done) + here) / static_cast<double>(rays));
            };
            try {
                work(pipeline, part, peek, told, own);
            } catch (...) {
                const std::lock_guard lock(mutex);
                parts.stop();
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

void Pipelines::forget() {
    std::erase_if(claims_, [](const Claim& claim) {
        if (!claim.picture.expired()) return false;
        claim.device->release(known_name, claim.bytes);
        return true;
    });
}

std::shared_ptr<KnownPicture> Pipelines::make_known(std::span<const ChannelPlane> planes, std::size_t pixels) {
    forget();
    const auto known = std::make_shared<KnownPicture>();
    const std::uint64_t bytes = planes.size() * pixels * sizeof(float);
    for (const auto& device : devices_) {  // in turn: drivers may touch what they are told of
        std::uint64_t others = 0;  // what is claimed for other pictures
        for (const Claim& claim : claims_) others += claim.device == device.get() ? claim.bytes : 0;
        const std::uint64_t most = std::min(device->available() / 2, device->max_buffer());
        const bool is_small = device->allocated() - others + bytes <= most_bytes_a_pixel * pixels;
        if (device->info().type == "cpu" || bytes == 0 || bytes > most || !is_small) continue;
        if (!known->add(*device, planes, pixels)) continue;
        device->claim(known_name, bytes);
        claims_.push_back({known, device.get(), bytes});
    }
    return known;
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
    share(prepared.rays, prepared.frame.every_partition, progress, counts,
          [&](Pipeline& pipeline, RayRange part, const Next& next, const Progress& told, PipelineCounts& own) {
              pipeline.render(prepared, part, next, shared, told, own);
          });
    clear_around(prepared.frame, target);  // while the last tiles' pixels are on their way
    for (const auto& pipeline : pipelines_) pipeline->finish();
}

std::vector<RayPartitions> Pipelines::shoot(const PreparedFrame& prepared, const std::vector<Ray>& rays,
                                            const Progress& progress, PipelineCounts& counts) {
    forget();
    std::vector<RayPartitions> answers(rays.size());
    share(rays.size(), true, progress, counts,
          [&](Pipeline& pipeline, RayRange part, const Next&, const Progress& told, PipelineCounts& own) {
              pipeline.shoot(prepared, std::span(rays).subspan(part.first, part.end - part.first), answers.data() + part.first, told,
                             own);
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
