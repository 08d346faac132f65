#include "device_method.hpp"

#include <algorithm>
#include <limits>
#include <mutex>

#include "base/laboratory.hpp"
#include "compile/records/converter.hpp"
#include "device/choice.hpp"
#include "pipeline/passes/batch_buffers.hpp"
#include "pipeline/passes/scene_tables.hpp"
#include "ray_events.hpp"
#include "rays/along.hpp"
#include "rays/frame.hpp"
#include "rays/list.hpp"

namespace csgrt {
const std::vector<KernelFile>& method_kernel_files();  // written by embed_kernels
}

namespace csgrt::bench {
namespace {

constexpr std::uint32_t batch_rays = 65'536;
constexpr std::uint64_t most_ray_memory = 256u << 20;  ///< bytes, for all rays of a batch

/// A device that compiles kernels; the native ones have theirs compiled ahead.
std::string compiling_device(const std::string& method, const std::string& choice) {
    const std::vector<DeviceInfo> all = devices();
    const std::size_t chosen = choose_device(all, choice, choice.empty() ? Kernels::compiled_by_device : Kernels::any);
    if (is_native(all[chosen]))
        throw Error(Status::usage, method + " cannot run on " + all[chosen].name +
                                       ": its kernels are compiled ahead; choose a device with a compiler");
    return std::to_string(chosen);
}

/// The source of all methods in one text: where a driver keeps programs, the kernels in front are compiled once. A file
/// with a function NAME_holds gets its kernel, evaluate_NAME, from each_partition.h.
std::string source() {
    std::map<std::string, std::string> texts;
    for (const KernelFile& file : method_kernel_files())
        texts[file.name] = "#line 1 \"bench/methods/kernels/" + std::string(file.name) + "\"\n" + file.text;
    std::string all = texts.at("covered.h");
    for (const auto& [file, text] : texts) {
        if (!file.ends_with(".cl")) continue;
        all += text;
        const std::string name = file.substr(0, file.size() - 3);
        if (text.find(name + "_holds(") != std::string::npos)
            all += "#define KERNEL evaluate_" + name + "\n#define REGION_HOLDS " + name + "_holds\n" +
                   texts.at("each_partition.h") + "#undef KERNEL\n#undef REGION_HOLDS\n";
    }
    return all;
}

/// All tables in one buffer, behind the places where they begin.
std::vector<std::uint32_t> joined_tables(std::vector<std::vector<std::uint32_t>> tables) {
    std::uint64_t size = tables.size();
    for (const std::vector<std::uint32_t>& table : tables) size += table.size();
    if (size > std::numeric_limits<std::uint32_t>::max())
        throw Error(Status::usage, "the method's tables have more than 2^32 words");
    std::vector<std::uint32_t> all;
    all.reserve(size);
    std::uint64_t at = tables.size();
    for (const std::vector<std::uint32_t>& table : tables) {
        all.push_back(static_cast<std::uint32_t>(at));
        at += table.size();
    }
    for (const std::vector<std::uint32_t>& table : tables) all.insert(all.end(), table.begin(), table.end());
    return all;
}

class DeviceTracer final : public Tracer {
public:
    DeviceTracer(const Subject& subject, const TraceOptions& options, DeviceMethod method)
        : scene_(subject.compiled),
          method_(std::move(method)),
          first_hits_(options.first_hits),
          records_(make_converter(scene_)),
          device_(compiling_device(method_.name, options.device)),
          scene_tables_(device_, scene_, records_->tables()),
          tables_(device_, "the method's tables", tables_of(scene_, method_)),
          memory_(device_, "the method's memory of rays"),
          batch_(device_),
          evaluation_{method_.kernel, source(),
                      [this](Kernel& kernel, const PartitionPass::Input& input, PartitionMemory& memory,
                             std::uint32_t segments) { return launch(kernel, input, memory, segments); }},
          pass_(device_, scene_, *records_, with_methods({.evaluation = &evaluation_})) {
        most_rays_ = batch_rays;
        if (method_.work) work_ = method_.work(device_);
        if (method_.ray_words == 0) return;
        const std::uint64_t bytes = method_.ray_words * sizeof(std::uint32_t);
        const std::uint64_t rays = std::min(most_ray_memory, device_.max_buffer()) / bytes;
        if (rays == 0)
            throw Error(Status::usage, method_.name + ": a ray would need " + std::to_string(bytes) + " bytes");
        most_rays_ = static_cast<std::uint32_t>(std::min<std::uint64_t>(rays, batch_rays));
    }

    std::vector<Answer> trace(const std::vector<Ray>& rays) override {
        std::vector<Answer> answers(rays.size());
        counts_ = {};
        partitions_ = 0;
        for (std::size_t first = 0; first < rays.size();) {
            const std::size_t count = std::min<std::size_t>(most_rays_, rays.size() - first);
            if (trace(std::span(rays).subspan(first, count), answers.data() + first))
                first += count;
            else if (most_rays_ == 1)
                throw Error(Status::out_of_memory, method_.name + ": one ray does not fit the device's memory");
            else
                most_rays_ = static_cast<std::uint32_t>((count + 1) / 2);
        }
        seconds_ = 1e-3 * (before_ms() + counts_.evaluate);
        if (work_) work_figures_ = work_->take_figures(counts_, seconds_);
        return answers;
    }

    double seconds() const override { return seconds_; }
    std::map<std::string, double> figures() const override {
        if (work_) return work_figures_;
        std::map<std::string, double> figures = method_.figures;
        figures["kernel 4 ms"] = counts_.evaluate;
        figures["kernels 1 to 3 ms"] = before_ms();
        figures["kernel 4 ns a partition"] =
            1e6 * counts_.evaluate / static_cast<double>(std::max<std::uint64_t>(partitions_, 1));
        figures["tables MB"] = 1e-6 * static_cast<double>(tables_.size());
        if (method_.ray_words) figures["bytes a ray"] = static_cast<double>(method_.ray_words) * sizeof(std::uint32_t);
        return figures;
    }

private:
    static std::vector<std::uint32_t> tables_of(const CompiledScene& scene, const DeviceMethod& method) {
        ListTable regions = ListTable::of(regions_of_solids(scene));
        std::vector<std::vector<std::uint32_t>> tables = {std::move(regions.firsts), std::move(regions.values)};
        tables.insert(tables.end(), method.tables.begin(), method.tables.end());
        return joined_tables(std::move(tables));
    }

    Event launch(Kernel& kernel, const PartitionPass::Input& input, PartitionMemory& memory, std::uint32_t segments) {
        if (work_) return work_->launch(kernel, input, memory);
        const std::size_t bytes = std::size_t{input.rays} * method_.ray_words * sizeof(std::uint32_t);
        memory_.reserve(bytes);
        if (bytes) memory_.queue_fill(0, bytes);
        const std::size_t items = method_.item_a_ray ? input.rays : 2 * std::size_t{segments};
        // As for csgrt's own kernel 4; items that are rays take differently long.
        const std::size_t group = method_.group        ? method_.group
                                  : method_.item_a_ray ? divergent_group(device_)
                                                       : work_group;
        return kernel.launch(segments ? items : 0, group, input.batch.frame, memory.offsets(), memory.boundaries(),
                             memory.bits(), memory.partitions(), tables_, memory_);
    }

    /// False: it needs more memory than there is.
    bool trace(std::span<const Ray> rays, Answer* answers) {
        const auto count = static_cast<std::uint32_t>(rays.size());
        kernel::Frame frame = prepare_rays(scene_, count, tolerance_of(scene_)).frame;
        frame.ray_count = count;
        frame.candidate_capacity = frame.segment_capacity = frame.word_capacity = COUNT_MAX;
        batch_.frame = Buffer(device_, "frame", records_->frame(frame));
        std::vector<kernel::RayRecord> records(rays.size());
        RayList(rays, {.all = whole_line}).fill(0, records);
        batch_.rays = Buffer(device_, "list of rays", records_->rays(records));
        TimedKernels timed;
        if (!pass_.trace_counted({scene_tables_, batch_, Work::rays, count}, timed)) return false;
        add_times(timed, counts_);
        const TracedBatch traced = pass_.read(count);
        if (work_) {
            work_->read(traced, rays, answers);
            return true;
        }
        for (std::uint32_t ray = 0; ray < count; ++ray) {
            const std::uint32_t segments = traced.offsets[ray + 1].segments - traced.offsets[ray].segments;
            const std::size_t first = 2 * std::size_t{traced.offsets[ray].segments};
            const kernel::Boundary* const boundaries = traced.boundaries.data() + first;
            const kernel::PartitionNode* const nodes = traced.nodes.data() + first;
            Sequence& stretches = answers[ray].stretches;
            stretches.clear();
            for (std::uint32_t k = kernel::first_partition(nodes, segments); k != NONE; k = nodes[k].next) {
                ++partitions_;
                if (nodes[k].owner == NONE) continue;
                append(stretches,
                       {nodes[k].owner, boundaries[nodes[k].in_boundary].t, boundaries[nodes[k].out_boundary].t});
                if (first_hits_) break;  // the kernel has gone no further
            }
        }
        return true;
    }

    double before_ms() const { return counts_.count_segments + counts_.scan + counts_.store_segments + counts_.weave; }

    const CompiledScene& scene_;
    DeviceMethod method_;
    bool first_hits_;
    std::unique_ptr<RecordConverter> records_;  ///< for the tables' and buffers' formats alone
    Device device_;
    SceneTables scene_tables_;
    Buffer tables_, memory_;
    BatchBuffers batch_;
    std::unique_ptr<DeviceWork> work_;
    std::map<std::string, double> work_figures_;
    double seconds_ = 0;
    Evaluation evaluation_;
    PartitionPass pass_;
    std::uint32_t most_rays_ = 0;
    PipelineCounts counts_;
    std::uint64_t partitions_ = 0;
};

}  // namespace

std::unique_ptr<Tracer> trace_on_device(const Subject& subject, const TraceOptions& options, DeviceMethod method) {
    return std::make_unique<DeviceTracer>(subject, options, std::move(method));
}

std::vector<PositiveTree> positive_trees(const CompiledScene& scene, Grouping grouping, bool planted) {
    std::vector<PositiveTree> trees;
    trees.reserve(scene.flat_trees.size());
    for (const FlatTree& tree : scene.flat_trees) trees.push_back(positive_tree(tree, grouping, planted));
    return trees;
}

ListTable ListTable::of(const std::vector<std::vector<std::uint32_t>>& lists) {
    ListTable table;
    for (const std::vector<std::uint32_t>& list : lists) {
        table.values.insert(table.values.end(), list.begin(), list.end());
        table.end_list();
    }
    return table;
}

}  // namespace csgrt::bench
