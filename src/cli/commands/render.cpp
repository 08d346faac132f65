// csgrt SCENE: one or more frames, written as pictures and figures.
#include <algorithm>
#include <utility>

#include <unistd.h>

#include <csgrt/image.hpp>
#include <csgrt/scene_io.hpp>

#include "base/clock.hpp"
#include "base/method_options.hpp"
#include "commands.hpp"
#include "cli/held_renderer.hpp"
#include "cli/interrupt.hpp"
#include "cli/output.hpp"
#include "cli/text/partitions.hpp"
#include "cli/progress.hpp"
#include "cli/text/scene.hpp"
#include "cli/text/statistics.hpp"

namespace csgrt::cli {

namespace {

#ifdef CSGRT_HAVE_IMAGE
bool names_format(const std::string& path) { return extension_of(path) == ".exr" || extension_of(path) == ".png"; }

/// Standard output, a device or a pipe: the name does not give the format.
bool has_no_format(const std::string& path) { return path == "-" || (!names_format(path) && target_of(path).direct); }
#endif

/// Refuses options that set one thing twice.
void check_view(const RenderArguments& arguments) {
    const std::pair<const char*, bool> given[] = {{"--azimuth", arguments.azimuth.has_value()},
                                                  {"--elevation", arguments.elevation.has_value()},
                                                  {"--center", arguments.center.has_value()},
                                                  {"--look-at", arguments.look_at.has_value()},
                                                  {"--view-size", arguments.view_size.has_value()},
                                                  {"--eye", arguments.eye.has_value()},
                                                  {"--up", arguments.up.has_value()}};
    for (const auto& [option, is_given] : given)
        if (is_given && !arguments.view.empty())
            refuse(option, "cannot be combined with --view", "the saved view has the eye and what it sees");
    if (arguments.eye && (arguments.azimuth || arguments.elevation))
        refuse("--eye", std::string("cannot be combined with ") + (arguments.azimuth ? "--azimuth" : "--elevation"),
               "the eye and what it looks at give the direction");
    if (arguments.look_at && arguments.center)
        refuse("--look-at", "cannot be combined with --center", "they are one point, the middle of the picture");
    if (arguments.eye && arguments.view_size && arguments.perspective.value_or(0) > 0)
        refuse("--view-size", "cannot be combined with --eye and --perspective", "these two give the size of the view");
}

/// Finds all mistakes that can be found before the work begins.
void check(const RenderArguments& arguments) {
    if (arguments.outputs.empty() && arguments.stats.empty())
        refuse("", "nothing to write",
               "name a picture with -o FILE.exr or -o FILE.png, or ask for figures with --stats -");
    std::vector<NamedFile> outputs;
    [[maybe_unused]] bool needs_format = false, to_standard_output = false;
    for (const std::string& path : arguments.outputs) {
        outputs.push_back({"--output", path});
        to_standard_output |= path == "-";
#ifdef CSGRT_HAVE_IMAGE
        needs_format |= has_no_format(path);
        if (!names_format(path) && !has_no_format(path))
            refuse("--output", "'" + path + "' is no picture's name",
                   "FILE.exr holds every channel, FILE.png the colours");
#else
        refuse("--output", "this csgrt was built without OpenImageIO and writes no pictures",
               "--stats works without it");
#endif
    }
    if (!arguments.format.empty() && !needs_format)
        refuse("--format", "has a meaning only with -o -, a device or a pipe", "a file's name says its format");
    if (to_standard_output && isatty(STDOUT_FILENO) == 1)
        refuse("--output", "a terminal cannot show a picture", "redirect standard output, or name a file with -o");
    if (!arguments.stats.empty()) outputs.push_back({"--stats", arguments.stats});
    check_view(arguments);
    check_outputs(outputs, {{"SCENE", arguments.scene}});
}

Camera camera_of(const Scene& scene, const RenderArguments& arguments) {
    Camera camera = arguments.view.empty() ? scene.camera : load_view(arguments.view);
    camera.perspective = arguments.perspective.value_or(camera.perspective);
    if (arguments.azimuth || arguments.elevation) {  // in place of the scene's eye, and upright
        camera.eye.reset();
        camera.up.reset();
    }
    camera.azimuth = arguments.azimuth.value_or(camera.azimuth);
    camera.elevation = arguments.elevation.value_or(camera.elevation);
    if (arguments.eye) {
        camera.eye = arguments.eye;
        camera.up.reset();
    }
    if (camera.eye && camera.perspective > 0) camera.view_size.reset();  // the scene's, or the saved view's
    if (arguments.center || arguments.look_at) {
        camera.center = arguments.center;
        camera.look_at = arguments.look_at;
    }
    if (arguments.view_size) camera.view_size = arguments.view_size;
    if (arguments.up) camera.up = arguments.up;
    return camera;
}

#ifdef CSGRT_HAVE_IMAGE
/// The command that draws this picture, with the options that its pixels depend on. It is the same on every machine.
std::string canonical_command(const RenderArguments& arguments, const Camera& camera, double tolerance) {
    std::string text = "csgrt " + model_text(arguments) + " --size " + std::to_string(arguments.width) + "x" +
                       std::to_string(arguments.height);
    auto option = [&text](const char* name, double value) {
        text += std::string(" ") + name + " ";
        append_shortest(text, value);
    };
    auto vector = [&text](const char* name, const std::optional<Vec3>& v) {
        if (!v) return;
        text += std::string(" ") + name + " ";
        append_shortest(text, v->x);
        append_shortest(text += ",", v->y);
        append_shortest(text += ",", v->z);
    };
    if (!camera.eye) {
        option("--azimuth", camera.azimuth);
        option("--elevation", camera.elevation);
    }
    option("--perspective", camera.perspective);
    vector("--eye", camera.eye);
    vector("--look-at", camera.look_at);
    vector("--center", camera.center);
    vector("--up", camera.up);
    if (camera.view_size) option("--view-size", *camera.view_size);
    option("--tolerance", tolerance);
    text += method_options(arguments.settings) + model_options(arguments);
    if (arguments.samples > 1) text += " --samples " + std::to_string(arguments.samples);
    for (const Plane& plane : arguments.clip) {
        vector("--clip", plane.normal);
        append_shortest(text += ":", plane.distance);
    }
    for (const Look& look : arguments.looks) {
        if (look.state) text += *look.state == State::hidden ? " --hide " : " --show ";
        if (look.color) text += " --color ";
        append_name(text, look.path);
        if (!look.color) continue;
        append_shortest(text += ":", look.color->x);
        append_shortest(text += ",", look.color->y);
        append_shortest(text += ",", look.color->z);
    }
    if (arguments.first_hit) text += " --first-hit";
    if (arguments.transparent) text += " --transparent";
    if (arguments.settings.display_shading) text += " --display-shading";
    return text;
}
#endif

/// Refuses a look of no region: the scene itself may have such looks, since regions come and go there.
void check_looks(const std::vector<Look>& looks, const std::vector<RegionInfo>& regions) {
    for (const Look& look : looks) {
        const bool is_there = std::ranges::any_of(regions, [&](const RegionInfo& region) {
            return region.path.starts_with(look.path) &&
                   (region.path.size() == look.path.size() || region.path[look.path.size()] == '/');
        });
        if (is_there) continue;
        std::vector<std::string_view> paths;
        for (const RegionInfo& region : regions) paths.push_back(region.path);
        const std::string near = suggestion(look.path, paths);
        refuse(look.color                     ? "--color"
               : *look.state == State::hidden ? "--hide"
                                              : "--show",
               "no region is at '" + look.path + "' or below it",
               near.empty() ? "'csgrt info --json' lists the regions' paths" : near);
    }
}

/// Whether the outputs are pictures with colours only, without figures: then first hits are enough.
bool only_colors(const RenderArguments& arguments) {
#ifdef CSGRT_HAVE_IMAGE
    return !arguments.outputs.empty() && arguments.stats.empty() &&
           std::all_of(arguments.outputs.begin(), arguments.outputs.end(), [&](const std::string& path) {
               return has_no_format(path) ? arguments.format == "png" : extension_of(path) == ".png";
           });
#else
    static_cast<void>(arguments);
    return false;
#endif
}

/// Returns the statistics; `image` is the last frame.
Statistics render_frames(Scene scene, const RenderArguments& arguments, const View& view, Image& image) {
    scene.looks.insert(scene.looks.end(), arguments.looks.begin(), arguments.looks.end());
    Framebuffer framebuffer;
    Progress progress;
    progress.stage("compiling");
    HeldRenderer renderer(Renderer(scene, arguments.objects, with_progress(arguments.settings, progress)));
    report(renderer.new_warnings());
    check_looks(arguments.looks, renderer->regions());
    check_interrupt();

    progress.stage("rendering");
    std::vector<Statistics> frames;
    for (int frame = 0; frame < arguments.repeat; ++frame) {
        progress.range(double(frame) / arguments.repeat, double(frame + 1) / arguments.repeat);
        renderer->render(view, framebuffer);
        frames.push_back(renderer->statistics());
        check_interrupt();
    }
    image = framebuffer.take();
    renderer->name_pixels(image);
    report(renderer.new_warnings());
    return median_of(frames);
}

}  // namespace

Status run(const RenderArguments& arguments) {
    check(arguments);
    auto begin = Clock::now();
    prepare_devices(arguments.settings);
    Scene scene = load_with_progress(arguments.scene, arguments.load);
    double load = milliseconds_since(begin);
    View view{arguments.width, arguments.height, camera_of(scene, arguments), !arguments.first_hit};
    view.transparent = arguments.transparent;
    view.clip = arguments.clip;
    view.samples = arguments.samples;
    if (only_colors(arguments)) {
        view.every_partition = false;
        view.channels = channel::color;
    }
    Image image;
    Statistics statistics = render_frames(scene, arguments, view, image);
    statistics.ms.load = load;
#ifdef CSGRT_HAVE_IMAGE
    image.attributes["csgrt:command"] = canonical_command(arguments, view.camera, statistics.tolerance);
    begin = Clock::now();
    for (const std::string& path : arguments.outputs) {
        write_image(image, path, arguments.format.empty() ? "exr" : arguments.format);
        check_interrupt();
    }
    statistics.ms.write = milliseconds_since(begin);
#endif
    if (!arguments.stats.empty()) {
        OutputFile out(arguments.stats);
        out.write(to_json(statistics));
        out.commit();
    }
    return Status::ok;
}

}  // namespace csgrt::cli
