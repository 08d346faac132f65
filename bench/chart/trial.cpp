#include "trial.hpp"

#include <algorithm>
#include <chrono>
#include <mutex>
#include <optional>

#include <csgrt/framebuffer.hpp>

#include "base/clock.hpp"
#include "base/parallel.hpp"

namespace csgrt::bench {
namespace {

/// Times of frames, as a row has them.
struct Times {
    std::vector<double> kernels, frames;  ///< milliseconds
    void to(Row& row) const {
        if (kernels.empty()) return;
        const double ns = 1e6 / static_cast<double>(row.timed_rays);
        row.ns_per_ray = ns * quantile(kernels, 0.5);
        const ConfidenceInterval interval = median_interval(kernels);
        row.ns = {ns * interval.low, ns * interval.high};
        row.frame_ms = quantile(frames, 0.5);
    }
};

/// Of the timed pictures of a workload: pixels along a side. Depth costs more a ray than anything else.
int side_of(const ChartWorkload& workload, const TrialOptions& options) {
    return workload.family == "deep" ? options.deep_size : options.size;
}

class VariantTrial : public Trial {
public:
    VariantTrial(const Variant& variant, const ChartWorkload& workload, const Truth& truth, const TrialOptions& options)
        : workload_(workload), options_(options), times_(options.modes.size()) {
        row_.variant = row_.method = variant.name;
        row_.workload = workload.name;
        row_.family = workload.family;
        settings_ = variant.settings;
        settings_.device = options.device;
        settings_.max_memory = options.max_memory;
        settings_.wait_for_device = true;
        settings_.reference = settings_.reference || (!workload.timed() && variant.on_reference());
        if (settings_.reference) settings_.device.clear();
        accuracy_.resize(options.modes.size());
        const std::size_t all = workload.tasks.size();
        const bool few = !workload.timed() && !settings_.reference;
        guard([&] { answer(truth, few ? std::min(all, options.device_scenes) : all); });
    }

    void frame(bool counts) override {
        if (!renderer_) return;
        guard([&] {
            View view;
            view.camera = workload_.tasks.front().scene.camera;
            view.camera.perspective = 0;
            view.width = view.height = size();
            view.channels = channel::color | channel::ids;
            for (std::size_t i = 0; i < options_.modes.size(); ++i) {
                view.every_partition = options_.modes[i] == Mode::every_partition;
                renderer_->render(view, framebuffer_);
                // That one woke the processors up: the first variant after the laboratory's methods needed up to 1.8
                // times the time of the others. Three more: where other work takes a processor away for a while, a
                // median of few frames is off by a factor of 2.
                for (int k = 0; counts && k < 3; ++k) {
                    renderer_->render(view, framebuffer_);
                    const auto& ms = renderer_->statistics().ms;
                    times_[i].kernels.push_back(settings_.reference ? ms.frame : ms.kernels);
                    times_[i].frames.push_back(ms.frame);
                }
            }
        });
    }

    std::vector<Row> rows() override {
        std::vector<Row> all;
        for (std::size_t i = 0; i < options_.modes.size(); ++i) {
            Row row = row_;
            row.mode = options_.modes[i];
            row.accuracy = accuracy_[i];
            row.timed_rays = static_cast<std::size_t>(size()) * static_cast<std::size_t>(size());
            times_[i].to(row);
            all.push_back(std::move(row));
        }
        return all;
    }

private:
    /// The reference has no device that would time its kernels: by the clock, in small pictures.
    int size() const {
        const int side = side_of(workload_, options_);
        return settings_.reference ? std::min(32, side) : side;
    }

    /// What a method cannot do is its result; that there is no device is nobody's.
    template <class Work>
    void guard(const Work& work) {
        try {
            work();
        } catch (const Error& error) {
            if (error.status() == Status::no_device) throw;
            accuracy_.assign(options_.modes.size(), {});
            row_.error = error.what();
            renderer_.reset();
            times_.assign(options_.modes.size(), {});
        }
    }

    std::vector<Accuracy> judge(Renderer& renderer, const Task& task, const std::vector<TrueRay>& truth) const {
        std::vector<Accuracy> accuracy(options_.modes.size());
        const std::vector<RayPartitions> found = renderer.shoot(task.rays);
        for (std::size_t k = 0; k < found.size(); ++k)
            for (std::size_t i = 0; i < accuracy.size(); ++i) accuracy[i].add(truth[k], found[k], options_.modes[i]);
        return accuracy;
    }

    void answer(const Truth& truth, std::size_t tasks) {
        const auto add = [&](const std::vector<Accuracy>& more) {
            for (std::size_t i = 0; i < more.size(); ++i) accuracy_[i] += more[i];
        };
        if (settings_.reference && tasks > 1) {  // many small scenes: a thread each
            Settings settings = settings_;
            settings.threads = 1;
            std::mutex mutex;
            for_chunks(tasks, 1, 0, [&](std::size_t i, std::size_t, std::size_t) {
                const Task& task = workload_.tasks[i];
                Renderer renderer(task.scene, task.objects, settings);
                const std::vector<Accuracy> accuracy = judge(renderer, task, truth[i]);
                const std::lock_guard lock(mutex);
                add(accuracy);
                row_.device = renderer.statistics().device;
            });
            return;
        }
        for (std::size_t i = 0; i < tasks; ++i) {
            const Task& task = workload_.tasks[i];
            auto renderer = std::make_unique<Renderer>(task.scene, task.objects, settings_);
            add(judge(*renderer, task, truth[i]));
            row_.device = renderer->statistics().device;
            if (workload_.timed()) renderer_ = std::move(renderer);
        }
    }

    const ChartWorkload& workload_;
    const TrialOptions& options_;
    Settings settings_;
    Row row_;
    std::vector<Accuracy> accuracy_;  ///< by mode
    std::vector<Times> times_;
    std::unique_ptr<Renderer> renderer_;
    Framebuffer framebuffer_;
};

class MethodTrial : public Trial {
public:
    MethodTrial(const Method& method, double knob, Mode mode, const ChartWorkload& workload, const Truth& truth,
                const TrialOptions& options)
        : method_(method), workload_(workload), options_(options) {
        row_.variant = row_.method = method.name;
        row_.knob = method.knob;
        row_.knob_value = knob;
        if (!method.knob.empty()) row_.variant += " " + number_text(knob);
        row_.mode = mode;
        row_.workload = workload.name;
        row_.family = workload.family;
        row_.laboratory = true;
        row_.exact = method.exact;
        row_.device = method.on_device ? options.device : "processors";
        trace_options_.knob = knob;
        trace_options_.first_hits = mode == Mode::first_hits;
        trace_options_.device = options.device;
        guard([&] { answer(truth); });
        if (workload.timed() && row_.error.empty()) guard([&] { prepare_frames(); });
    }

    void frame(bool counts) override {
        if (!tracer_) return;
        guard([&] {
            const auto start = Clock::now();
            tracer_->trace(picture_);
            if (!counts) return;
            times_.kernels.push_back(1e3 * tracer_->seconds());
            times_.frames.push_back(1e3 * seconds_since(start));
        });
    }

    std::vector<Row> rows() override {
        times_.to(row_);
        return {row_};
    }

private:
    static std::string number_text(double value) {
        char text[32];
        std::snprintf(text, sizeof text, "%.6g", value);
        return text;
    }

    template <class Work>
    void guard(const Work& work) {
        try {
            work();
        } catch (const std::exception& error) {
            row_.accuracy = {};
            row_.error = error.what();
            tracer_.reset();
            times_ = {};
        }
    }

    /// What one task adds to the row.
    struct Part {
        Accuracy accuracy;
        std::string refusal;
        std::map<std::string, double> figures;
    };

    Part answer(const Task& task, const std::vector<TrueRay>& truth, unsigned threads, Clock::time_point end) const {
        Part part;
        const CompiledScene compiled = compile(task.scene, task.objects);
        std::unique_ptr<Tracer> tracer;
        TraceOptions trace_options = trace_options_;
        trace_options.threads = threads;
        try {
            tracer = method_.prepare({task.scene, task.objects, compiled}, trace_options);
        } catch (const Error& error) {
            if (error.status() != Status::usage) throw;
            part.refusal = error.what();
            part.accuracy.add_unanswered(task.rays.size());
            return part;
        }
        // In turns, each all over the task's rays: if the time ends, what was judged stands for all of them.
        const std::size_t turns = (task.rays.size() + 1023) / 1024;
        for (std::size_t turn = 0; turn < turns && (turn == 0 || Clock::now() < end); ++turn) {
            std::vector<Ray> rays;
            for (std::size_t k = turn; k < task.rays.size(); k += turns) rays.push_back(task.rays[k]);
            const std::vector<Answer> found = tracer->trace(rays);
            for (std::size_t i = 0; i < found.size(); ++i)
                if (found[i].answered)
                    part.accuracy.add(truth[turn + i * turns], joined(found[i].stretches), row_.mode);
                else
                    part.accuracy.add_unanswered(1);
        }
        part.figures = tracer->figures();
        return part;
    }

    void answer(const Truth& truth) {
        const auto end = Clock::now() + std::chrono::duration_cast<Clock::duration>(
                                            std::chrono::duration<double>(options_.method_seconds));
        const std::size_t tasks = workload_.tasks.size();
        const bool side_by_side = tasks > 1 && !method_.on_device;
        std::mutex mutex;
        for_chunks(tasks, 1, side_by_side ? 0 : 1, [&](std::size_t i, std::size_t, std::size_t) {
            if (i > 0 && Clock::now() >= end) return;
            const Part part = answer(workload_.tasks[i], truth[i], side_by_side ? 1 : 0, end);
            const std::lock_guard lock(mutex);
            row_.accuracy += part.accuracy;
            if (!part.refusal.empty()) row_.refusals[part.refusal] += part.accuracy.rays;
            for (const auto& [name, value] : part.figures) row_.figures[name] = std::max(row_.figures[name], value);
        });
    }

    /// As many pixels as the method traces in the time that a frame may take, at most those of the others' pictures.
    void prepare_frames() {
        const Task& task = workload_.tasks.front();
        compiled_.emplace(compile(task.scene, task.objects));
        try {
            tracer_ = method_.prepare({task.scene, task.objects, *compiled_}, trace_options_);
        } catch (const Error& error) {
            if (error.status() != Status::usage) throw;
            return;  // the row has its words
        }
        const int most = side_of(workload_, options_);
        for (int side = std::min(16, most);; side = std::min(2 * side, most)) {
            picture_ = view_rays(task.scene, task.objects, side);
            const auto start = Clock::now();
            tracer_->trace(picture_);
            if (side == most || 4 * seconds_since(start) > options_.method_frame) break;
        }
        row_.timed_rays = picture_.size();
    }

    const Method& method_;
    const ChartWorkload& workload_;
    const TrialOptions& options_;
    TraceOptions trace_options_;
    Row row_;
    std::optional<CompiledScene> compiled_;  ///< what tracer_ traces
    std::unique_ptr<Tracer> tracer_;
    std::vector<Ray> picture_;
    Times times_;
};

}  // namespace

std::unique_ptr<Trial> try_variant(const Variant& variant, const ChartWorkload& workload, const Truth& truth,
                                   const TrialOptions& options) {
    return std::make_unique<VariantTrial>(variant, workload, truth, options);
}
std::unique_ptr<Trial> try_method(const Method& method, double knob, Mode mode, const ChartWorkload& workload,
                                  const Truth& truth, const TrialOptions& options) {
    return std::make_unique<MethodTrial>(method, knob, mode, workload, truth, options);
}

}  // namespace csgrt::bench
