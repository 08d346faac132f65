#include "device/buffer.hpp"

#include <stdexcept>

namespace csgrt {
namespace {

/// Maps memory, and waits until it is mapped.
void* map_memory(const Driver& cl, cl_command_queue queue, cl_mem memory, cl_map_flags access, std::size_t bytes,
                 const std::string& name) {
    cl.check_lost();
    cl_int code = CL_SUCCESS;
    cl_event mapped = nullptr;
    void* const data =
        cl.EnqueueMapBuffer(queue, memory, cl.patience == 0, access, 0, bytes, 0, nullptr, &mapped, &code);
    check(code, "clEnqueueMapBuffer (" + name + ")");
    const Event event(cl, mapped);
    if (cl.patience > 0) wait_for(event);
    return data;
}

/// Unmaps memory, and waits until it is unmapped.
void unmap_memory(const Driver& cl, cl_command_queue queue, cl_mem memory, void* data) noexcept {
    cl_event unmapped = nullptr;
    if (cl.is_lost || cl.EnqueueUnmapMemObject(queue, memory, data, 0, nullptr, &unmapped) != CL_SUCCESS) return;
    wait_until_done(Event(cl, unmapped));
}

}  // namespace

Buffer::Buffer(Device& device, std::string name, std::size_t bytes) : device_(&device), name_(std::move(name)) {
    reserve(bytes);
}

Buffer::Buffer(Buffer&& other) noexcept
    : device_(other.device_),
      name_(std::move(other.name_)),
      size_(std::exchange(other.size_, 0)),
      memory_(std::move(other.memory_)) {}

Buffer& Buffer::operator=(Buffer&& other) noexcept {
    std::swap(device_, other.device_);
    std::swap(name_, other.name_);
    std::swap(size_, other.size_);
    memory_ = std::move(other.memory_);
    return *this;
}

Buffer::~Buffer() { release(); }

void Buffer::release() noexcept {
    memory_ = {};
    if (size_) device_->release(name_, std::exchange(size_, 0));
}

void Buffer::reserve(std::size_t bytes) {
    if (bytes <= size_) return;
    release();
    device_->claim(name_, bytes);
    cl_int code = CL_SUCCESS;
    memory_ =
        Memory(device_->cl(), device_->cl().CreateBuffer(device_->context(), CL_MEM_READ_WRITE, bytes, nullptr, &code));
    if (code != CL_SUCCESS) device_->release(name_, bytes);
    check(code, "clCreateBuffer (" + name_ + ", " + std::to_string(bytes) + " bytes)");
    size_ = bytes;
}

void Buffer::check_range(std::size_t bytes, std::size_t offset) const {
    device_->cl().check_lost();
    if (offset > size_ || bytes > size_ - offset) {
        throw std::logic_error("buffer " + name_ + ": a transfer past its end");
    }
}

Event Buffer::transfer_in(const void* source, std::size_t bytes, std::size_t offset, bool wait) {
    check_range(bytes, offset);
    if (bytes == 0) return {};
    cl_event event = nullptr;
    check(device_->cl().EnqueueWriteBuffer(device_->queue(), get(), wait, offset, bytes, source, 0, nullptr, &event),
          "clEnqueueWriteBuffer (" + name_ + ")");
    return Event(device_->cl(), event);
}

// A blocking read takes one call less, but only the host's wait for an event has a time limit.
Event Buffer::transfer_out(cl_command_queue queue, void* target, std::size_t bytes, std::size_t offset,
                           bool wait) const {
    check_range(bytes, offset);
    if (bytes == 0) return {};
    cl_event queued = nullptr;
    check(device_->cl().EnqueueReadBuffer(queue, get(), wait && device_->cl().patience == 0, offset, bytes, target, 0,
                                          nullptr, &queued),
          "clEnqueueReadBuffer (" + name_ + ")");
    Event event(device_->cl(), queued);
    if (wait && device_->cl().patience > 0) wait_for(event);
    return event;
}

void Buffer::upload(const void* source, std::size_t bytes, std::size_t offset) {
    transfer_in(source, bytes, offset, true);
}

void Buffer::read(void* target, std::size_t bytes, std::size_t offset) const {
    transfer_out(device_->queue(), target, bytes, offset, true);
}

Buffer::Mapping Buffer::map(std::size_t bytes) const {
    check_range(bytes, 0);
    if (bytes == 0) return {*device_, nullptr, nullptr};
    return {*device_, get(), map_memory(device_->cl(), device_->queue(), get(), CL_MAP_READ, bytes, name_)};
}

Buffer::Mapping::~Mapping() {
    if (data_ && !cl_.is_lost) cl_.EnqueueUnmapMemObject(queue_, memory_, data_, 0, nullptr, nullptr);
}

Event Buffer::queue_upload(const void* source, std::size_t bytes, std::size_t offset) {
    return transfer_in(source, bytes, offset, false);
}

Event Buffer::queue_read(void* target, std::size_t bytes, std::size_t offset) const {
    return transfer_out(device_->queue(), target, bytes, offset, false);
}

Event Buffer::copy_read(void* target, std::size_t bytes, std::size_t offset) const {
    return transfer_out(device_->copy_queue(), target, bytes, offset, false);
}

Event Buffer::queue_fill(std::uint32_t value, std::size_t bytes, std::size_t offset) {
    check_range(bytes, offset);
    if (bytes == 0) return {};
    cl_event event = nullptr;
    check(device_->cl().EnqueueFillBuffer(device_->queue(), get(), &value, sizeof value, offset, bytes, 0, nullptr,
                                          &event),
          "clEnqueueFillBuffer (" + name_ + ")");
    return Event(device_->cl(), event);
}

HostRegistration::HostRegistration(const Device& device, void* data, std::size_t bytes) : driver_(device.driver()) {
    cl_int code = CL_SUCCESS;
    check(device.cl().RetainCommandQueue(device.queue()), "clRetainCommandQueue");
    queue_ = Queue(*driver_, device.queue());
    memory_ = Memory(*driver_, device.cl().CreateBuffer(device.context(), CL_MEM_READ_WRITE | CL_MEM_USE_HOST_PTR,
                                                        bytes, data, &code));
    check(code, "clCreateBuffer (picture, " + std::to_string(bytes) + " bytes of the host's)");
    data_ = map_memory(*driver_, queue_.get(), memory_.get(), CL_MAP_READ | CL_MAP_WRITE, bytes, "picture");
}

HostRegistration::~HostRegistration() {
    if (memory_ && data_) unmap_memory(*driver_, queue_.get(), memory_.get(), data_);
}

PinnedMemory::PinnedMemory(const Device& device, std::string name, std::size_t bytes) : device_(&device), size_(bytes) {
    if (bytes == 0) return;
    cl_int code = CL_SUCCESS;
    memory_ = Memory(device.cl(), device.cl().CreateBuffer(device.context(), CL_MEM_READ_WRITE | CL_MEM_ALLOC_HOST_PTR,
                                                           bytes, nullptr, &code));
    check(code, "clCreateBuffer (" + name + ", " + std::to_string(bytes) + " bytes on the host)");
    data_ = map_memory(device.cl(), device.queue(), memory_.get(), CL_MAP_READ | CL_MAP_WRITE, bytes, name);
}

PinnedMemory::~PinnedMemory() {
    if (data_) unmap_memory(device_->cl(), device_->queue(), memory_.get(), data_);
}

}  // namespace csgrt
