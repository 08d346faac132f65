// csgrt_campaign: many rays through every scene, on a device, each judged by the oracle.
//
//   csgrt_campaign [--rays N] [--seconds N] [--threads N] [--device CHOICE] [--only FAMILY,...] [--models FOLDER]
//                  [--scenes FOLDER] [--precision NAME] [--json FILE] [--wrong FILE]
//
// --device: as of csgrt, or "reference". --precision: to see that what is wrong is seen.
//
// Every thread takes a scene, builds its kernels, shoots its rays in batches on the device and judges them. The rays
// are shared out by the items' shares; so is what is left of --seconds whenever a scene begins, with what its kind
// costs counted in: one whose rays cost more still gets fewer. Exit status: 0 all is right, 8 something is not; what
// else may be as of csgrt.
#include <algorithm>
#include <atomic>
#include <cmath>
#include <ctime>
#include <mutex>
#include <thread>

#include <csgrt/csgrt.hpp>

#include "base/clock.hpp"
#include "base/identical.hpp"
#include "bench/chart/report.hpp"
#include "bench/program.hpp"
#include "tally.hpp"

namespace {

using namespace csgrt;
using namespace csgrt::campaign;

constexpr std::size_t batch = 16'384;     ///< rays of a call
constexpr std::size_t on_reference = 64;  ///< of these, shot there, too; an eighth of a small batch

struct Options {
    double rays = 1e6, seconds = 1e9;
    unsigned threads = std::max(1u, std::thread::hardware_concurrency());
    std::string device, json = "campaign.json", wrong = "campaign_wrong.jsonl";
    Precision precision = Precision::double_;
    Choice choice{"scenes", "../shared/brlcad", {}};
};

/// Of this thread alone, however many share the cores.
double processor_seconds() {
    timespec now{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

/// One item, until its rays or its time are used up.
Sums run(const Item& item, const Options& options, std::size_t planned, double seconds, Tally& tally,
         std::string& device_name) {
    const Clock::time_point start = Clock::now();
    Sums sums;
    sums.items = 1;
    sums.planned = planned;
    try {
        const std::unique_ptr<Subject> subject = item.make();
        Settings settings;
        settings.reference = options.device == "reference";
        if (!settings.reference) settings.device = options.device;
        settings.wait_for_device = true;
        settings.precision = options.precision;
        settings.threads = 1;
        settings.skip_unsupported = true;
        Renderer device(subject->scene(), subject->objects(), settings);
        device_name = device.statistics().device;
        settings.reference = true;
        settings.device.clear();
        Renderer reference(subject->scene(), subject->objects(), settings);
        subject->prepare(device, planned);
        sums.build = seconds_since(start);
        while (sums.rays < planned && (sums.rays == 0 || seconds_since(start) < seconds)) {
            const Clock::time_point begun = Clock::now();
            const std::vector<Ray> rays = subject->rays(std::min<std::size_t>(batch, planned - sums.rays));
            if (rays.empty()) break;
            std::vector<RayPartitions> found = device.shoot(rays);
            sums.shoot += seconds_since(begun);
            const double judging = processor_seconds();
            const std::size_t some = std::min(on_reference, 1 + rays.size() / 8);
            const std::vector<Ray> few(rays.begin(), rays.begin() + static_cast<std::ptrdiff_t>(some));
            const std::vector<RayPartitions> same = reference.shoot(few);
            sums.compared += few.size();
            for (std::size_t i = 0; i < few.size(); ++i)
                if (!identical(found[i], same[i])) {
                    ++sums.bit_differences;
                    tally.add_wrong(item, few[i], "device and reference differ");
                }
            for (std::size_t i = 0; i < rays.size(); ++i) {
                if (sums.rays > 0 && seconds_since(start) > seconds) break;
                const Verdict verdict = subject->judge(i, found[i]);
                ++sums.rays;
                sums.hits += !found[i].partitions.empty();
                ++(verdict.tie ? sums.ties : sums.decided);
                sums.worst = std::max(sums.worst, verdict.worst);
                if (verdict.wrong.empty()) continue;
                ++sums.wrong;
                tally.add_wrong(item, rays[i], verdict.wrong);
            }
            sums.judge += processor_seconds() - judging;
        }
    } catch (const std::exception& error) {
        tally.add_error(item, error.what());
    }
    return sums;
}

Options parse(int argc, char** argv) {
    Options o;
    bench::OptionReader options;
    options.number("--rays", o.rays, 1, 1e12);
    options.number("--seconds", o.seconds, 1, 1e12);
    options.number("--threads", o.threads, 1, 1024);
    options.text("--device", o.device);
    options.list("--only", o.choice.only);
    options.text("--models", o.choice.models);
    options.text("--scenes", o.choice.scenes);
    options.value("--precision", [&](const std::string& value) {
        const auto* at = std::find_if(std::begin(precision_names), std::end(precision_names),
                                      [&](const auto& known) { return known.first == value; });
        if (at == std::end(precision_names)) throw Error(Status::usage, "--precision: there is no " + value);
        o.precision = at->second;
    });
    options.text("--json", o.json);
    options.text("--wrong", o.wrong);
    options.read(argc, argv);
    return o;
}

int run_all(const Options& options) {
    const Clock::time_point start = Clock::now();
    Choice choice = options.choice;
    choice.threads = options.threads;
    const std::vector<Item> all = items(choice);
    if (all.empty()) throw Error(Status::usage, "--only: nothing is called that");
    double shares = 0;
    std::vector<double> work_left(all.size() + 1, 0);  // from each item on
    for (std::size_t i = all.size(); i-- > 0;) {
        shares += all[i].share;
        work_left[i] = work_left[i + 1] + all[i].work();
    }
    Tally tally(options.wrong);
    std::atomic<std::size_t> next{0};
    std::mutex mutex;
    std::string device;
    const auto work = [&] {
        for (std::size_t i; (i = next.fetch_add(1)) < all.size();) {
            const auto planned = static_cast<std::size_t>(std::ceil(options.rays * all[i].share / shares));
            const double left = (options.seconds - seconds_since(start)) * options.threads *
                                std::min(1.0, 1.5 * all[i].work() / work_left[i]);
            std::string name;
            tally.add(all[i], run(all[i], options, planned, std::min(left, options.seconds - seconds_since(start)),
                                  tally, name));
            const std::lock_guard lock(mutex);
            if (!name.empty()) device = name;
            if (i % 64 == 63)
                std::fprintf(stderr, "%zu of %zu, %.0f s, %.3g rays, %llu wrong\n", i + 1, all.size(),
                             seconds_since(start), static_cast<double>(tally.total().rays),
                             static_cast<unsigned long long>(tally.total().wrong));
        }
    };
    std::vector<std::thread> threads;
    for (unsigned i = 0; i < options.threads; ++i) threads.emplace_back(work);
    for (std::thread& thread : threads) thread.join();
    std::fputs(tally.table().c_str(), stdout);
    const Sums total = tally.total();
    std::printf("%llu wrong of %llu decided rays, %llu different bits, %.0f s\n",
                static_cast<unsigned long long>(total.wrong), static_cast<unsigned long long>(total.decided),
                static_cast<unsigned long long>(total.bit_differences), seconds_since(start));
    bench::write_whole(tally.to_json(device, options.threads, seconds_since(start)), options.json);
    return tally.passed() ? 0 : static_cast<int>(Status::differs);
}

}  // namespace

int main(int argc, char** argv) {
    return bench::run_program("csgrt_campaign", [&] { return run_all(parse(argc, argv)); });
}
