// csgrt SCENE: renders one or more frames, and writes pictures and statistics.
#include <algorithm>
#include <filesystem>
#include <utility>

#include <unistd.h>

#include <csgrt/image.hpp>
#include <csgrt/scene_io.hpp>

#include "base/clock.hpp"
#include "commands.hpp"
#include "cli/held_renderer.hpp"
#include "cli/interrupt.hpp"
#include "cli/output.hpp"
#include "cli/progress.hpp"
#include "cli/text/scene.hpp"
#include "cli/text/statistics.hpp"
#include "form/camera.hpp"
#include "form/written_back.hpp"
#include "scene/object_path.hpp"

namespace csgrt::cli {

namespace {

#ifdef CSGRT_HAVE_IMAGE
bool names_format(const std::string& path) { return extension_of(path) == ".exr" || extension_of(path) == ".png"; }

/// Whether the path is standard output, a device or a pipe, whose name does not tell the format.
bool has_no_format(const std::string& path) { return path == "-" || (!names_format(path) && target_of(path).direct); }
#endif

auto is_given(const RenderArguments& arguments) {
    return [&arguments](std::string_view member) { return arguments.given.contains(std::string(member)); };
}

/// The option that sets a camera's member.
std::string option_of(std::string_view member) {
    std::string option;
    form::for_members(form::of<Camera>, [&](const auto& described) {
        if (described.key.member == member) option = described.option.name;
    });
    return option;
}

/// Refuses options that set one thing twice.
void check_view(const RenderArguments& arguments) {
    for (const std::string& member : arguments.given)
        if (member != "perspective" && !arguments.view.empty())
            refuse(option_of(member).c_str(), "cannot be combined with --view",
                   "the saved view has the eye and what it sees");
    if (const CameraConflict* conflict = conflict_of(arguments.picture.camera, is_given(arguments)))
        refuse(option_of(conflict->member).c_str(), "cannot be combined with " + option_of(conflict->other),
               conflict->reason);
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

/// Refuses an option's look that fits no region. The scene's own looks may fit none, because its regions change over
/// time.
void check_looks(const std::vector<Look>& looks, const SharedList<RegionInfo>& regions) {
    for (const Look& look : looks) {
        const bool is_there = std::ranges::any_of(
            regions, [&](const RegionInfo& region) { return is_at_or_below(region.path, look.path); });
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

/// Whether the outputs are pictures that hold only colours, without statistics: then first hits are enough.
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

/// Renders the frames and returns their statistics. `image` becomes the last frame.
Statistics render_frames(Scene scene, const RenderArguments& arguments, const View& view, Image& image) {
    scene.looks.insert(scene.looks.end(), arguments.looks.begin(), arguments.looks.end());
    Framebuffer framebuffer;
    Progress progress;
    progress.stage("compiling");
    HeldRenderer renderer(Renderer(scene, arguments.objects, with_progress(arguments.settings, progress)));
    report(renderer.new_warnings());
    check_looks(arguments.looks, renderer->model().regions());
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
    renderer->name_overlaps(view, image);
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
    View view = arguments.picture;
    const Camera seen = arguments.view.empty() ? scene.camera : load_view(arguments.view);
    view.camera = merged(seen, arguments.picture.camera, is_given(arguments));
    [[maybe_unused]] const View drawn = view;
    if (only_colors(arguments)) {
        view.every_partition = false;
        view.channels = channel::color;
    }
    Image image;
    Statistics statistics = render_frames(scene, arguments, view, image);
    statistics.ms.load = load;
#ifdef CSGRT_HAVE_IMAGE
    image.attributes["csgrt:command"] =
        "csgrt " +
        model_words(std::filesystem::path(arguments.scene).filename().string(), arguments.objects, arguments.load,
                    arguments.settings, statistics.tolerance) +
        drawing_options(drawn, arguments.looks);
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
