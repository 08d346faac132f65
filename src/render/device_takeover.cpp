#include "render/device_takeover.hpp"

#include <chrono>
#include <system_error>
#include <utility>

#include "base/thread.hpp"
#include "device/driver_call.hpp"

namespace csgrt {

DeviceTakeover::DeviceTakeover(DevicePlan plan, SetUp set_up, Adapt adapt, bool waits)
    : plan_(std::move(plan)),
      set_up_(std::move(set_up)),
      adapt_(std::move(adapt)),
      waits_(waits),
      is_over_(!plan_.find_next),
      name_(plan_.next) {
    if (!is_over_) begin();
    if (waits_ && !is_over_) {
        job_.wait();
        collect();
    }
    if (!next_) first();
}

DeviceTakeover::~DeviceTakeover() {
    is_left_ = true;
    if (job_.valid()) job_.wait();
}

/// The job: finds and sets up the next devices, or compiles more kernels for devices. First hits of a few rays use the
/// kernels of every partition, so the job compiles these, too: no frame waits for them.
DeviceTakeover::Made DeviceTakeover::work(Made made) {
    if (is_left_) return made;  // without another thread, the waiting thread runs the job
    const DriverCall driver_call;
    if (!made.pipelines) {
        const std::vector<FoundDevice> devices = plan_.find_next();
        if (devices.empty() || is_left_) return {};
        {
            const std::lock_guard lock(name_mutex_);
            name_.clear();
            for (const FoundDevice& device : devices) name_ += (name_.empty() ? "" : " + ") + device.info.name;
        }
        made.pipelines = set_up_(devices);
    } else {
        adapt_(*made.pipelines);
    }
    const auto compile = [&](bool every_partition) {
        if (made.ready[every_partition] || is_left_) return;
        made.pipelines->prepare(every_partition);
        made.ready[every_partition] = true;
    };
    if (wanted_[true] || (wanted_[false] && !waits_)) compile(true);
    if (wanted_[false]) compile(false);
    return made;
}

void DeviceTakeover::begin() {
    Made made{std::move(next_), std::exchange(ready_, {})};
    const auto job = [this, made = std::make_shared<Made>(std::move(made))] { return work(std::move(*made)); };
    try {
        job_ = start_async(job, std::launch::async);
    } catch (const std::system_error&) {  // no thread is available: a call waits for the job
        job_ = start_async(job, std::launch::deferred);
    }
}

/// Takes the job's result; waits for the job if it has not ended.
void DeviceTakeover::collect() {
    try {
        Made made = job_.get();
        next_ = std::move(made.pipelines);
        ready_ = made.ready;
        is_over_ = !next_;
        if (ready_[false] && ready_[true]) first_ = nullptr;
    } catch (...) {
        fault_ = std::current_exception();
        is_over_ = true;
    }
}

bool DeviceTakeover::has_ended() const {
    return job_.valid() && job_.wait_for(std::chrono::seconds(0)) != std::future_status::timeout;
}

DeviceGroup& DeviceTakeover::drawer(bool every_partition, const CompiledScene& scene) {
    wanted_[every_partition] = true;
    if (has_ended()) collect();
    if (next_ && !next_->can_draw(scene)) ready_ = {};
    if (!is_over_ && !ready_[every_partition] && !job_.valid()) begin();
    if (waits_) await(every_partition);
    if (fault_ && !plan_.is_default) std::rethrow_exception(fault_);
    if (next_ && ready_[every_partition]) return *next_;
    first().prepare(every_partition);
    return *first_;
}

void DeviceTakeover::await(bool every_partition) {
    while (!is_over_ && !ready_[every_partition]) {
        if (!job_.valid()) begin();
        job_.wait();
        collect();
    }
}

DeviceGroup& DeviceTakeover::first() {
    if (!first_) first_ = set_up_(plan_.first);
    return *first_;
}

std::string DeviceTakeover::awaited() const {
    if (!job_.valid() || has_ended()) return {};
    const std::lock_guard lock(name_mutex_);
    return name_;
}

std::optional<std::string> DeviceTakeover::take_fault() {
    if (!fault_ || !plan_.is_default || std::exchange(is_told_, true)) return {};
    try {
        std::rethrow_exception(fault_);
    } catch (const std::exception& error) {
        const std::string why = error.what();
        const std::string first_line = why.substr(0, why.find('\n'));  // a compiler writes hundreds of lines
        return "the GPU cannot be used, the processor draws: " + first_line;
    }
}

}  // namespace csgrt
