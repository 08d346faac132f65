#include "compile/records/converter.hpp"

#include "base/laboratory.hpp"

namespace csgrt {

std::unique_ptr<RecordConverter> make_converter(const CompiledScene& scene, const Settings& settings) {
    if (settings.precision != Precision::single) return make_double_converter(scene);
    return laboratory(settings).single_world ? make_single_world_converter(scene) : make_single_converter(scene);
}

}  // namespace csgrt
