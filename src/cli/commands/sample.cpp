// csgrt sample: finds the region that holds each of given points, or each pixel of a plane.
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <unistd.h>

#include <csgrt/image.hpp>

#include "commands.hpp"
#include "cli/held_renderer.hpp"
#include "cli/interrupt.hpp"
#include "cli/output.hpp"
#include "cli/progress.hpp"
#include "cli/text/partitions.hpp"
#include "cli/text/rays.hpp"
#include "cli/text/tables.hpp"

namespace csgrt::cli {

namespace {

constexpr std::size_t most_points = 1'000'000;        ///< at once
constexpr std::size_t most_sampled_text = 1'000'000;  ///< bytes at once, approximately
constexpr const char* sample_type = "'<i4'";

void check(const SampleArguments& arguments) {
    if (arguments.points.empty() && !arguments.plane)
        refuse("", "nothing to sample", "name a file of points with --points, or a plane with --plane z:0");
    const std::string extension = extension_of(arguments.output);
    const bool is_picture = extension == ".png";
    if (arguments.output != "-" && extension != ".npy" && extension != ".csv" && !is_picture)
        refuse("--output", "'" + arguments.output + "' ends in none of .npy, .csv and .png",
               "a file's name says its format; standard output gets CSV");
    if (is_picture && !arguments.plane) refuse("--output", "points make no picture", "FILE.npy and FILE.csv hold them");
#ifndef CSGRT_HAVE_IMAGE
    if (is_picture)
        refuse("--output", "this csgrt was built without OpenImageIO and writes no pictures",
               "FILE.npy and FILE.csv work without it");
#endif
    std::vector<NamedFile> inputs = {{"SCENE", arguments.scene}};
    if (!arguments.points.empty()) inputs.push_back({"--points", arguments.points});
    check_outputs({{"--output", arguments.output}}, inputs);
}

/// Appends ",ID,PATH" and a line break; PATH is empty if there is no region, or several.
void append_region(std::string& text, std::int32_t id, const Model& model) {
    text += ',' + std::to_string(id) + ',';
    if (id >= 0) append_field(text, model.regions()[static_cast<std::size_t>(id)].path);
    text += '\n';
}

void sample_points(PointReader& reader, bool is_npy, Renderer& renderer, Progress& progress, OutputFile& out) {
    const std::uint64_t total = reader.count();
    out.write(is_npy ? npy_header(sample_type, std::span(&total, 1)) : "x,y,z,region_id,path\n");
    std::vector<Vec3> points;
    Array<std::int32_t> ids;
    const Model model = renderer.model();
    std::string text;
    for (std::uint64_t done = 0; reader.next(points, most_points); done += points.size()) {
        const auto part = [total](std::uint64_t of) { return static_cast<double>(of) / static_cast<double>(total); };
        progress.range(part(done), part(done + points.size()));
        renderer.region_at(points, ids);
        text.clear();
        if (is_npy) append_bytes(text, std::span<const std::int32_t>(ids.data(), ids.size()));
        for (std::size_t i = 0; !is_npy && i < points.size(); ++i) {
            append_shortest(text, points[i].x);
            append_shortest(text += ',', points[i].y);
            append_shortest(text += ',', points[i].z);
            append_region(text, ids[i], model);
        }
        out.write(text);
        check_interrupt();
    }
}

void write_pixels(const Slice& slice, const Array<std::int32_t>& ids, bool is_npy, const Model& model,
                  OutputFile& out) {
    const auto width = static_cast<std::size_t>(slice.width), height = static_cast<std::size_t>(slice.height);
    if (is_npy) {
        out.write(npy_header(sample_type, std::vector<std::uint64_t>{height, width}));
        std::string bytes;
        for (std::size_t row = 0; row < height; ++row) {
            append_bytes(bytes, std::span<const std::int32_t>(ids.data() + row * width, width));
            out.write(bytes);
            bytes.clear();
        }
        return;
    }
    std::string text = "column,row,region_id,path\n";
    for (std::size_t i = 0; i < ids.size(); ++i) {
        if (ids[i] == -1) continue;
        text += std::to_string(i % width) + ',' + std::to_string(i / width);
        append_region(text, ids[i], model);
        if (text.size() < most_sampled_text) continue;
        out.write(text);
        text.clear();
    }
    out.write(text);
}

#ifdef CSGRT_HAVE_IMAGE
/// A picture of the regions in their colours; overlaps are red, and nothing is transparent.
Image picture_of(const Slice& slice, const Array<std::int32_t>& ids, const Model& model) {
    constexpr float nothing[] = {0, 0, 0, 0};
    Image image;
    image.width = slice.width;
    image.height = slice.height;
    image.names = {"R", "G", "B", "A"};
    image.channels = Channels(ids.size(), nothing);
    image.display_values = true;
    for (std::size_t i = 0; i < ids.size(); ++i) {
        if (ids[i] == -1) continue;
        const Vec3 color = ids[i] < 0 ? Vec3{1, 0, 0} : model.regions()[static_cast<std::size_t>(ids[i])].color;
        std::size_t channel = 0;
        for (const double value : {color.x, color.y, color.z, 1.0})
            image.channels[channel++][i] = static_cast<float>(value);
    }
    return image;
}
#endif

void sample(const SampleArguments& arguments, PointReader* points, Renderer& renderer, Progress& progress) {
    const std::string extension = extension_of(arguments.output);
    Array<std::int32_t> ids;
    Slice slice;
    if (!points) {
        const Box box = renderer.model().bounds();
        if (!(box.low.x <= box.high.x))
            refuse("--plane", "the model has no bounded region to cut", "name points with --points");
        slice = slice_of(box, arguments.plane->normal, arguments.plane->distance, arguments.width, arguments.height);
        renderer.slice(slice, ids);
        check_interrupt();
    }
#ifdef CSGRT_HAVE_IMAGE
    if (extension == ".png") return write_image(picture_of(slice, ids, renderer.model()), arguments.output);
#endif
    OutputFile out(arguments.output);
    if (points)
        sample_points(*points, extension == ".npy", renderer, progress, out);
    else
        write_pixels(slice, ids, extension == ".npy", renderer.model(), out);
    out.commit();
}

}  // namespace

Status run(const SampleArguments& arguments) {
    check(arguments);
    Progress progress(arguments.output != "-" || isatty(STDOUT_FILENO) != 1);
    progress.stage("loading");
    prepare_devices(arguments.settings);
    Scene scene = load(arguments.scene, arguments.load);
    std::optional<PointReader> points;
    if (!arguments.plane) {
        progress.stage("reading points");
        points.emplace(arguments.points);
    }
    progress.stage("compiling");
    HeldRenderer renderer(Renderer(scene, arguments.objects, with_progress(arguments.settings, progress)));
    report(renderer.new_warnings(), false);
    check_interrupt();
    progress.stage("sampling");
    sample(arguments, points ? &*points : nullptr, *renderer, progress);
    report(renderer.new_warnings(), false);
    return Status::ok;
}

}  // namespace csgrt::cli
