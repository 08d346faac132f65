// csgrt verify: compares a sample of rays with 113-bit answers, some thousand rays at a time.
#include <algorithm>

#include "commands.hpp"
#include "cli/interrupt.hpp"
#include "cli/output.hpp"
#include "cli/progress.hpp"
#include "cli/text/rays.hpp"
#include "cli/text/verification.hpp"

namespace csgrt::cli {

namespace {

constexpr std::size_t rays_at_once = 16'384;

}  // namespace

Status run(const VerifyArguments& arguments) {
    std::vector<NamedFile> outputs;
    if (!arguments.json.empty()) outputs.push_back({"--json", arguments.json});
    check_outputs(outputs, {{"SCENE", arguments.scene}, {"--rays", arguments.rays}});
    Verification result;
    std::string table, json;
    {
        Progress progress;
        progress.stage("loading");
        prepare_devices(arguments.settings);
        Scene scene = load(arguments.scene, arguments.load);
        std::optional<RayReader> reader;
        if (!arguments.rays.empty()) {
            progress.stage("reading rays");
            reader.emplace(arguments.rays);
        }
        progress.stage("compiling");
        Verifier verifier(scene, arguments.objects, with_progress(arguments.settings, progress));
        report(verifier.renderer().model().warnings(), false);
        check_interrupt();

        std::vector<Ray> sample, rays;
        if (!reader) sample = verifier.sample(scene.camera, arguments.count, arguments.seed);
        const auto total = static_cast<double>(reader ? reader->count() : sample.size());
        std::size_t done = 0;
        const auto next = [&] {
            if (reader) return reader->next(rays, rays_at_once);
            const std::size_t end = std::min(done + rays_at_once, sample.size());
            rays.assign(sample.begin() + static_cast<std::ptrdiff_t>(done),
                        sample.begin() + static_cast<std::ptrdiff_t>(end));
            return !rays.empty();
        };
        progress.stage("verifying");
        while (next()) {
            progress.range(static_cast<double>(done) / total, static_cast<double>(done + rays.size()) / total);
            verifier.shoot(rays);
            done += rays.size();
            check_interrupt();
        }
        result = verifier.result();
        table = to_text(result, verifier.renderer());
        json = to_json(result, verifier.renderer());
    }
    write_file(arguments.json, json);
    if (arguments.json != "-") print(table);
    return result.passed() ? Status::ok : Status::differs;
}

}  // namespace csgrt::cli
