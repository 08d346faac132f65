#include "c/call.hpp"

#include "c/described.hpp"

using namespace csgrt;

namespace {

/// The last failure of a thread.
struct Failure {
    std::vector<Diagnostic> diagnostics = {};
    std::string text = {};
    const char* shown = "";  ///< `text`, or a constant if there is no memory for `text`
};
thread_local Failure last;

csgrt_status keep(csgrt_status status, std::vector<Diagnostic> diagnostics, const char* text) {
    last = {std::move(diagnostics), text};
    last.shown = last.text.c_str();
    return status;
}

csgrt_status keep_without_memory() noexcept {
    last.diagnostics.clear();
    last.shown = "there is not enough memory";
    return CSGRT_ERROR_OUT_OF_MEMORY;
}

csgrt_diagnostic diagnostic_at(const Place& place) {
    csgrt_diagnostic d CSGRT_DIAGNOSTIC;
    d.file = place.file.c_str();
    d.pointer = place.pointer.c_str();
    d.line = place.line;
    d.column = place.column;
    d.offset = place.offset;
    return d;
}

}  // namespace

namespace csgrt::c {

csgrt_status keep_failure() noexcept {
    try {
        throw;
    } catch (const Error& error) {
        try {
            return keep(static_cast<csgrt_status>(error.status()), error.diagnostics(), error.what());
        } catch (...) {
            return keep_without_memory();
        }
    } catch (const std::bad_alloc&) {
        return keep_without_memory();
    } catch (const std::exception& error) {
        try {
            return keep(CSGRT_ERROR_UNEXPECTED, {{.message = error.what()}}, error.what());
        } catch (...) {
            return keep_without_memory();
        }
    } catch (...) {
        last.diagnostics.clear();
        last.shown = "an exception that is none of csgrt's";
        return CSGRT_ERROR_UNEXPECTED;
    }
}

void refuse(const std::string& message, std::string suggestion) {
    throw Error(Status::usage, {{.message = message, .suggestion = std::move(suggestion)}});
}

std::vector<std::string> texts(const char* const* first, std::size_t count, const char* name) {
    std::vector<std::string> all;
    for (const char* text : needed(first, count, name)) all.emplace_back(&needed(text, name));
    return all;
}

Settings settings_of(const csgrt_settings* settings) {
    if (!settings) return {};
    return described<Settings>(read(settings, csgrt_settings CSGRT_SETTINGS, "settings"), "settings");
}

Camera camera_of(const csgrt_camera* camera) {
    return described<Camera>(read(camera, csgrt_camera CSGRT_CAMERA, "camera"), "camera");
}

Finish finish_of(const csgrt_finish* finish) {
    const csgrt_finish f = read(finish, csgrt_finish CSGRT_FINISH, "finish");
    Finish all{
        .shader = text_or_empty(f.shader),
        .specular = f.specular,
        .diffuse = f.diffuse,
        .ambient = f.ambient,
        .shine = f.shine,
        .transmit = f.transmit,
        .reflect = f.reflect,
    };
    if (f.shines) {
        all.light = {f.intensity,     f.fraction,      f.angle,        of(f.target),
                     of(f.direction), f.infinite != 0, f.visible != 0, f.shadows};
    }
    return all;
}

std::vector<Light> lights_of(const csgrt_light* lights, std::size_t count) {
    std::vector<Light> all;
    for (const csgrt_light& light : needed(lights, count, "lights")) {
        all.push_back({of(light.position), of(light.color), light.intensity, light.infinite != 0, light.angle,
                       of(light.direction)});
    }
    return all;
}

View view_of(const csgrt_view* view) { return described<View>(read(view, csgrt_view CSGRT_VIEW, "view"), "view"); }

Matrix matrix_of(const double* matrix) {
    Matrix all = identity;
    if (matrix) std::copy(matrix, matrix + all.size(), all.begin());
    return all;
}

csgrt_diagnostic diagnostic_of(const Warning& warning) {
    csgrt_diagnostic d = diagnostic_at(warning.place);
    if (!warning.object.empty()) d.pointer = warning.object.c_str();
    d.message = warning.reason.c_str();
    d.count = warning.count;
    d.appearance = warning.appearance;
    return d;
}

}  // namespace csgrt::c

const char* csgrt_version(void) { return version(); }

const char* csgrt_last_error(void) { return last.shown; }

size_t csgrt_last_diagnostic_count(void) { return last.diagnostics.size(); }

csgrt_status csgrt_last_diagnostic(size_t index, csgrt_diagnostic* diagnostic) {
    // A wrong index does not become the last error: the earlier error, which the caller asks about, stays.
    if (index >= last.diagnostics.size() || !diagnostic) return CSGRT_ERROR_USAGE;
    try {
        const Diagnostic& from = last.diagnostics[index];
        csgrt_diagnostic d = diagnostic_at(from.place);
        d.message = from.message.c_str();
        d.suggestion = from.suggestion.c_str();
        d.excerpt = from.excerpt.c_str();
        c::fill(diagnostic, d, "diagnostic");
        return CSGRT_OK;
    } catch (const Error&) {
        return CSGRT_ERROR_USAGE;
    }
}

#define CSGRT_INIT(type, defaults)  \
    void type##_init(type* given) { \
        const type usual defaults;  \
        if (given) *given = usual;  \
    }
CSGRT_INIT(csgrt_diagnostic, CSGRT_DIAGNOSTIC)
CSGRT_INIT(csgrt_settings, CSGRT_SETTINGS)
CSGRT_INIT(csgrt_device_info, CSGRT_DEVICE_INFO)
CSGRT_INIT(csgrt_load_options, CSGRT_LOAD_OPTIONS)
CSGRT_INIT(csgrt_finish, CSGRT_FINISH)
CSGRT_INIT(csgrt_combination, CSGRT_COMBINATION)
CSGRT_INIT(csgrt_camera, CSGRT_CAMERA)
CSGRT_INIT(csgrt_scene_info, CSGRT_SCENE_INFO)
CSGRT_INIT(csgrt_model_info, CSGRT_MODEL_INFO)
CSGRT_INIT(csgrt_region_info, CSGRT_REGION_INFO)
CSGRT_INIT(csgrt_solid_info, CSGRT_SOLID_INFO)
CSGRT_INIT(csgrt_child_info, CSGRT_CHILD_INFO)
CSGRT_INIT(csgrt_rays, CSGRT_RAYS)
CSGRT_INIT(csgrt_partition_arrays, CSGRT_PARTITION_ARRAYS)
CSGRT_INIT(csgrt_hits, CSGRT_HITS)
CSGRT_INIT(csgrt_statistics, CSGRT_STATISTICS)
CSGRT_INIT(csgrt_view, CSGRT_VIEW)
CSGRT_INIT(csgrt_image_info, CSGRT_IMAGE_INFO)
CSGRT_INIT(csgrt_pick, CSGRT_PICK)
CSGRT_INIT(csgrt_verification, CSGRT_VERIFICATION)
CSGRT_INIT(csgrt_measure_request, CSGRT_MEASURE_REQUEST)
CSGRT_INIT(csgrt_measured, CSGRT_MEASURED)
CSGRT_INIT(csgrt_measurement, CSGRT_MEASUREMENT)
CSGRT_INIT(csgrt_measured_grid, CSGRT_MEASURED_GRID)
CSGRT_INIT(csgrt_check_request, CSGRT_CHECK_REQUEST)
CSGRT_INIT(csgrt_check_result, CSGRT_CHECK_RESULT)
CSGRT_INIT(csgrt_found_overlap, CSGRT_FOUND_OVERLAP)
CSGRT_INIT(csgrt_unlisted_pair, CSGRT_UNLISTED_PAIR)
