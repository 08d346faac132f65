#include "pipeline/readback/registered_memory.hpp"

#include <csgrt/error.hpp>

namespace csgrt {

void RegisteredMemory::add(const Device& device) {
    try {
        registered_.try_emplace(device.context(), device, data_, bytes_);
    } catch (const Error&) {  // the driver refuses the memory
    }
}

}  // namespace csgrt
