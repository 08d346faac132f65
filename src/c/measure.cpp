#include <algorithm>

#include "c/described.hpp"

using namespace csgrt;
using namespace csgrt::c;

struct csgrt_measurer {
    Measurer measurer;
    Measurement result = {};  ///< the last one
    std::vector<Density> densities = {};
};

namespace {

template <std::size_t count>
void copy(const std::array<Estimate, count>& from, csgrt_estimate (&to)[count]) {
    std::transform(from.begin(), from.end(), to, [](const Estimate& e) { return ::of(e); });
}

csgrt_cell_volumes of(const CellVolumes& v) {
    const auto* const cells = reinterpret_cast<const std::int32_t*>(v.cells.data());
    return {v.ids.size(), cells, v.ids.data(), v.volumes.data(), v.half_widths.data()};
}

}  // namespace

csgrt_status csgrt_measurer_create(const csgrt_model* model, const csgrt_settings* settings,
                                   csgrt_measurer** measurer) {
    return make(measurer, [&] { return Measurer(CSGRT_NEED(model).model, settings_of(settings)); });
}

void csgrt_measurer_free(csgrt_measurer* measurer) { delete measurer; }

csgrt_status csgrt_measurer_measure(csgrt_measurer* measurer, const csgrt_measure_request* request,
                                    csgrt_measurement* result) {
    return call([&] {
        csgrt_measurer& m = CSGRT_NEED(measurer);
        auto wanted = request_of<MeasureRequest>(request, csgrt_measure_request CSGRT_MEASURE_REQUEST);
        if (wanted.densities.empty()) wanted.densities = m.densities;
        m.result = m.measurer.measure(wanted);
        fill(result,
             {0, m.result.has_densities, m.result.reached, m.result.rays, m.result.seconds, m.result.parts.size()},
             "result");
    });
}

csgrt_status csgrt_measurer_part(const csgrt_measurer* measurer, size_t index, csgrt_measured* part) {
    return call([&] {
        const Measured& m = item(CSGRT_NEED(measurer).result.parts, index);
        csgrt_measured all CSGRT_MEASURED;
        all.kind = static_cast<int>(m.kind);
        all.name = m.name.c_str();
        all.id = m.id;
        all.volume = ::of(m.volume);
        all.claimed = ::of(m.claimed);
        all.area = ::of(m.area);
        all.mass = ::of(m.mass);
        copy(m.centroid, all.centroid);
        copy(m.origin, all.origin);
        copy(m.central, all.central);
        all.box = csgrt::c::of(m.box);
        all.regions = m.regions;
        all.reached = m.reached;
        all.unmet = m.unmet;
        all.weightless = m.weightless;
        all.unmet_bound = m.unmet_bound;
        all.thin = m.thin;
        all.wall = m.wall.thickness;
        all.wall_from = csgrt::c::of(m.wall.from);
        all.wall_to = csgrt::c::of(m.wall.to);
        all.is_tapered = m.wall.is_tapered;
        std::copy(m.wall.shares.begin(), m.wall.shares.end(), all.wall_shares);
        fill(part, all, "part");
    });
}

csgrt_status csgrt_measurer_grid(const csgrt_measurer* measurer, csgrt_measured_grid* grid) {
    return call([&] {
        const MeasuredGrid& of = CSGRT_NEED(measurer).result.grid;
        csgrt_measured_grid all CSGRT_MEASURED_GRID;
        std::copy(of.sides.begin(), of.sides.end(), all.sides);
        all.box = csgrt::c::of(of.box);
        all.regions = ::of(of.regions);
        all.materials = ::of(of.materials);
        fill(grid, all, "grid");
    });
}

csgrt_status csgrt_measurer_load_densities(csgrt_measurer* measurer, const char* path) {
    return call([&] { CSGRT_NEED(measurer).densities = load_densities(&CSGRT_NEED(path)); });
}
