#include "device/buffer.hpp"

#include <stdexcept>

namespace csgrt {

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

Event Buffer::transfer_out(cl_command_queue queue, void* target, std::size_t bytes, std::size_t offset,
                           bool wait) const {
    check_range(bytes, offset);
    if (bytes == 0) return {};
    cl_event event = nullptr;
    check(device_->cl().EnqueueReadBuffer(queue, get(), wait, offset, bytes, target, 0, nullptr, &event),
          "clEnqueueReadBuffer (" + name_ + ")");
    return Event(device_->cl(), event);
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
    cl_int code = CL_SUCCESS;
    void* data = device_->cl().EnqueueMapBuffer(device_->queue(), get(), CL_TRUE, CL_MAP_READ, 0, bytes, 0, nullptr,
                                                nullptr, &code);
    check(code, "clEnqueueMapBuffer (" + name_ + ")");
    return {*device_, get(), data};
}

Buffer::Mapping::~Mapping() {
    if (data_) cl_.EnqueueUnmapMemObject(queue_, memory_, data_, 0, nullptr, nullptr);
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

HostRegistration::HostRegistration(const Device& device, void* data, std::size_t bytes) {
    cl_int code = CL_SUCCESS;
    check(device.cl().RetainCommandQueue(device.queue()), "clRetainCommandQueue");
    queue_ = Queue(device.cl(), device.queue());
    memory_ = Memory(device.cl(), device.cl().CreateBuffer(device.context(), CL_MEM_READ_WRITE | CL_MEM_USE_HOST_PTR,
                                                           bytes, data, &code));
    check(code, "clCreateBuffer (picture, " + std::to_string(bytes) + " bytes of the host's)");
    data_ = device.cl().EnqueueMapBuffer(queue_.get(), memory_.get(), CL_TRUE, CL_MAP_READ | CL_MAP_WRITE, 0, bytes, 0,
                                         nullptr, nullptr, &code);
    check(code, "clEnqueueMapBuffer (picture)");
}

HostRegistration::~HostRegistration() {
    if (!memory_ || !data_) return;
    queue_.cl().EnqueueUnmapMemObject(queue_.get(), memory_.get(), data_, 0, nullptr, nullptr);
    queue_.cl().Finish(queue_.get());
}

PinnedMemory::PinnedMemory(const Device& device, std::string name, std::size_t bytes) : device_(&device), size_(bytes) {
    if (bytes == 0) return;
    cl_int code = CL_SUCCESS;
    memory_ = Memory(device.cl(), device.cl().CreateBuffer(device.context(), CL_MEM_READ_WRITE | CL_MEM_ALLOC_HOST_PTR,
                                                           bytes, nullptr, &code));
    check(code, "clCreateBuffer (" + name + ", " + std::to_string(bytes) + " bytes on the host)");
    data_ = device.cl().EnqueueMapBuffer(device.queue(), memory_.get(), CL_TRUE, CL_MAP_READ | CL_MAP_WRITE, 0, bytes,
                                         0, nullptr, nullptr, &code);
    check(code, "clEnqueueMapBuffer (" + name + ")");
}

PinnedMemory::~PinnedMemory() {
    if (!data_) return;
    device_->cl().EnqueueUnmapMemObject(device_->queue(), memory_.get(), data_, 0, nullptr, nullptr);
    device_->cl().Finish(device_->queue());
}

}  // namespace csgrt
