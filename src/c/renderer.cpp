#include <bit>

#include "c/described.hpp"

using namespace csgrt;
using namespace csgrt::c;

struct csgrt_verifier {
    Verifier verifier;
};

namespace {

thread_local std::vector<DeviceInfo> last_devices;  // the result of the last csgrt_devices()

}  // namespace

csgrt_status csgrt_devices(size_t* count) {
    return call([&] {
        std::size_t& number = CSGRT_NEED(count);
        last_devices = devices();
        number = last_devices.size();
    });
}

csgrt_status csgrt_device(size_t index, csgrt_device_info* info) {
    return call([&] { fill(info, shown<csgrt_device_info>(item(last_devices, index)), "info"); });
}

csgrt_status csgrt_prepare_devices(const csgrt_settings* settings) {
    return call([&] { prepare_devices(settings_of(settings)); });
}

// ---- Renderers ----

csgrt_status csgrt_renderer_create(const csgrt_model* model, const csgrt_settings* settings,
                                   csgrt_renderer** renderer) {
    return make(renderer, [&] { return Renderer(CSGRT_NEED(model).model, settings_of(settings)); });
}

void csgrt_renderer_free(csgrt_renderer* renderer) { delete renderer; }

csgrt_status csgrt_renderer_model(const csgrt_renderer* renderer, csgrt_model** model) {
    return make(model, [&] { return CSGRT_NEED(renderer).renderer.model(); });
}

csgrt_status csgrt_renderer_set_model(csgrt_renderer* renderer, const csgrt_model* model) {
    return call([&] { CSGRT_NEED(renderer).renderer.set_model(CSGRT_NEED(model).model); });
}

csgrt_status csgrt_renderer_statistics(const csgrt_renderer* renderer, csgrt_statistics* statistics) {
    return call(
        [&] { fill(statistics, shown<csgrt_statistics>(CSGRT_NEED(renderer).renderer.statistics()), "statistics"); });
}

csgrt_status csgrt_renderer_device_warning_count(const csgrt_renderer* renderer, size_t* count) {
    return call([&] { CSGRT_NEED(count) = CSGRT_NEED(renderer).renderer.device_warnings().size(); });
}

csgrt_status csgrt_renderer_device_warning(const csgrt_renderer* renderer, size_t index, csgrt_diagnostic* warning) {
    return call(
        [&] { fill(warning, diagnostic_of(item(CSGRT_NEED(renderer).renderer.device_warnings(), index)), "warning"); });
}

// ---- Pictures ----

csgrt_status csgrt_image_create(csgrt_image** image) {
    return make(image, [] { return Framebuffer{}; });
}

void csgrt_image_free(csgrt_image* image) { delete image; }

csgrt_status csgrt_renderer_render(csgrt_renderer* renderer, const csgrt_view* view, csgrt_image* image) {
    return call([&] { CSGRT_NEED(renderer).renderer.render(view_of(view), CSGRT_NEED(image).frame); });
}

csgrt_status csgrt_image_get_info(const csgrt_image* image, csgrt_image_info* info) {
    return call([&] {
        const Image& i = CSGRT_NEED(image).frame.image();
        fill(info, {0, i.width, i.height, i.names.size(), i.display_values}, "info");
    });
}

csgrt_status csgrt_image_channel_name(const csgrt_image* image, size_t index, const char** name, int* holds_ids) {
    return call([&] {
        const Image& i = CSGRT_NEED(image).frame.image();
        const char* found_name = item(i.names, index).c_str();
        if (name) *name = found_name;
        if (holds_ids) *holds_ids = i.holds_ids(index);
    });
}

csgrt_status csgrt_image_channel(const csgrt_image* image, const char* name, const float** values, size_t* count) {
    return call([&] {
        const std::span<const float> channel = CSGRT_NEED(image).frame.image().channel(&CSGRT_NEED(name));
        CSGRT_NEED(count) = channel.size();
        CSGRT_NEED(values) = channel.data();
    });
}

csgrt_status csgrt_image_ids(const csgrt_image* image, const char* name, const uint32_t** ids, size_t* count) {
    return call([&] {
        const std::span<const std::uint32_t> channel = CSGRT_NEED(image).frame.image().ids(&CSGRT_NEED(name));
        CSGRT_NEED(count) = channel.size();
        CSGRT_NEED(ids) = channel.data();
    });
}

namespace {

void expect_values(std::size_t count, const Image& image, std::size_t values) {
    const std::size_t expected = std::size_t(image.width) * std::size_t(image.height) * values;
    if (count != expected) {
        refuse("the count is " + std::to_string(count) + ", expected " + std::to_string(expected) + ": " +
               std::to_string(image.width) + " x " + std::to_string(image.height) + " x " + std::to_string(values));
    }
}

}  // namespace

csgrt_status csgrt_image_copy(const csgrt_image* image, const char* const* names, size_t name_count, float* values,
                              size_t count) {
    return call([&] {
        const Image& i = CSGRT_NEED(image).frame.image();
        std::vector<std::span<const float>> channels;
        for (const std::string& name : texts(names, name_count, "names")) channels.push_back(i.channel(name));
        expect_values(count, i, name_count);
        needed(values, count, "values");
        for (std::size_t c = 0; c < name_count; ++c)
            for (std::size_t pixel = 0; pixel < channels[c].size(); ++pixel)
                values[pixel * name_count + c] = channels[c][pixel];
    });
}

csgrt_status csgrt_image_display_pixels(const csgrt_image* image, unsigned char* bytes, size_t count) {
    return call([&] {
        const Image& i = CSGRT_NEED(image).frame.image();
        expect_values(count, i, 4);
        needed(bytes, count, "bytes");
        static_assert(std::endian::native == std::endian::little);  // RGBA8 has R in the lowest byte
        if (i.has_channel("RGBA8")) {
            std::memcpy(bytes, i.ids("RGBA8").data(), count);
        } else {
            const std::vector<unsigned char> made = display_pixels(i);
            std::copy(made.begin(), made.end(), bytes);
        }
    });
}

// ---- Verification ----

csgrt_status csgrt_verifier_create(const csgrt_scene* scene, const char* const* objects, size_t object_count,
                                   const csgrt_settings* settings, csgrt_verifier** verifier) {
    return make(verifier, [&] {
        return Verifier(CSGRT_NEED(scene).scene, texts(objects, object_count, "objects"), settings_of(settings));
    });
}

void csgrt_verifier_free(csgrt_verifier* verifier) { delete verifier; }

csgrt_status csgrt_verifier_sample(const csgrt_verifier* verifier, const csgrt_camera* camera, uint64_t seed,
                                   csgrt_ray* rays, size_t count) {
    return call([&] {
        const auto place = needed(rays, count, "rays");
        const std::vector<Ray> made =
            CSGRT_NEED(verifier).verifier.sample(camera ? camera_of(camera) : Camera{}, count, seed);
        for (std::size_t i = 0; i < made.size(); ++i) place[i] = of(made[i]);
    });
}

csgrt_status csgrt_verifier_shoot(csgrt_verifier* verifier, const csgrt_ray* rays, size_t count) {
    return call([&] {
        const auto list = needed(same_layout<const Ray>(rays), count, "rays");
        CSGRT_NEED(verifier).verifier.shoot({list.begin(), list.end()});
    });
}

csgrt_status csgrt_verifier_result(const csgrt_verifier* verifier, csgrt_verification* result) {
    return call([&] {
        const Verification& v = CSGRT_NEED(verifier).verifier.result();
        csgrt_verification all{0,
                               v.device.c_str(),
                               v.rays,
                               v.hits,
                               v.decided,
                               v.ties,
                               v.wrong,
                               v.bit_differences,
                               v.ends,
                               v.leaping_ends,
                               v.farthest.millimetres,
                               v.worst.ulps,
                               0,
                               {}};
        if (!v.wrong_rays.empty()) {
            all.first_wrong = v.wrong_rays[0].index;
            all.wrong_ray = of(v.wrong_rays[0].ray);
        }
        fill(result, all, "result");
        if (!v.passed()) {
            throw Error(Status::differs, std::to_string(v.wrong) + " of " + std::to_string(v.decided) +
                                             " decided rays are wrong, " + std::to_string(v.bit_differences) +
                                             " differ in bits from the reference");
        }
    });
}
