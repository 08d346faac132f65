#include "pipeline/readback/registered_memory.hpp"

#include <csgrt/error.hpp>

namespace csgrt {

void KnownPicture::make_known(const Device& device) {
    try {
        known_.try_emplace(device.context(), device, data_, bytes_);
    } catch (const Error&) {  // the driver refused
    }
}

}  // namespace csgrt
