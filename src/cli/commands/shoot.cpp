// csgrt shoot: the partitions along given rays, in chunks, so that any number of rays fits into memory.
#include <algorithm>

#include <unistd.h>

#include "commands.hpp"
#include "cli/held_renderer.hpp"
#include "cli/interrupt.hpp"
#include "cli/output.hpp"
#include "cli/text/partitions.hpp"
#include "cli/progress.hpp"
#include "cli/text/rays.hpp"
#include "cli/text/scene.hpp"

namespace csgrt::cli {

namespace {

constexpr std::size_t most_rays = 65'536;      ///< in a chunk; enough to fill a device
constexpr std::size_t most_text = 64'000'000;  ///< bytes of a chunk's answers, more or less

std::string header(const ShootArguments& arguments, const Renderer& renderer, std::uint64_t rays) {
    std::string text = std::string("# csgrt ") + version() + " model " + model_text(arguments) + "\n# rays " +
                       std::to_string(rays) + " solids " + std::to_string(renderer.solids().size()) + " regions " +
                       std::to_string(renderer.regions().size()) + " useair " + (arguments.settings.air ? "1" : "0") +
                       " tol.dist ";
    append_shortest(text, renderer.statistics().tolerance);
    const auto number = [](double value) {
        std::string digits;
        append_shortest(digits, value);
        return digits;
    };
    return text + "\n# box " + bounds_text(renderer, false, number) + "\n";
}

}  // namespace

Status run(const ShootArguments& arguments) {
    check_outputs({{"--output", arguments.output}}, {{"SCENE", arguments.scene}, {"--rays", arguments.rays}});
    Progress progress(arguments.output != "-" || isatty(STDOUT_FILENO) != 1);
    progress.stage("loading");
    prepare_devices(arguments.settings);
    Scene scene = load(arguments.scene, arguments.load);
    progress.stage("reading rays");
    RayReader reader(arguments.rays);
    progress.stage("compiling");
    HeldRenderer held(Renderer(scene, arguments.objects, with_progress(arguments.settings, progress)));
    Renderer& renderer = *held;
    report(renderer.warnings(), false);
    const std::size_t reported = renderer.warnings().size();
    check_interrupt();

    OutputFile out(arguments.output);
    out.write(header(arguments, renderer, reader.count()));
    PartitionWriter writer(renderer);
    progress.stage("shooting");
    std::vector<Ray> rays;
    std::string text;
    std::uint64_t done = 0;
    auto total = static_cast<double>(reader.count());
    std::size_t chunk = 1;  // the answer to one ray has megabytes where thousands of regions overlap
    while (reader.next(rays, chunk)) {
        progress.range(static_cast<double>(done) / total, static_cast<double>(done + rays.size()) / total);
        for (const RayPartitions& along : renderer.shoot(rays)) writer.append(text, done++, along);
        out.write(text);
        chunk = std::clamp(rays.size() * most_text / (text.size() + 1), std::size_t{1}, std::min(8 * chunk, most_rays));
        text.clear();
        check_interrupt();
    }
    out.commit();
    report({renderer.warnings().begin() + static_cast<std::ptrdiff_t>(reported), renderer.warnings().end()}, false);
    return Status::ok;
}

}  // namespace csgrt::cli
