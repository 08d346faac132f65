// Yang et al. 2010: "Real-time concurrent linked list construction on the GPU"; thesis sections 2.3.2 and 3.3.3.
//
// Theory: all segments of all rays lie in one buffer of nodes, and a second buffer has of each ray its newest node. A
// work-item that finds a segment takes the next free node from one atomic counter, and puts it before the ray's list by
// an atomic exchange. So one pass finds and stores, where csgrt's kernels 1 and 2 count, sum and store. The order in a
// list is that of arrival; a second kernel sorts each list by solid.
//
//   heads   ray 0: 3   ray 1: 2          next   0: end   1: 0   2: end   3: 1       ray 0 has 3, 1, 0; ray 1 has 2
//
// The buffer is as large as the last rays needed, at first four nodes a ray. If the counter passes its end, a larger
// buffer is made, and all is done again.
//
// How it is judged: the sorted lists are compared with what kernels 1 and 2 stored, bit by bit, but for ends that
// kernel 3 has moved to their event since; and the regions follow from the lists, on the host, by Blists. The method's
// time is that of its two kernels alone, to be compared with that of kernels 1 and 2, and not with methods that
// evaluate trees: the chart leaves it out.
//
// Cost: an atomic addition and an exchange a segment, a step or more a node to sort, and memory by the largest batch.
// Prediction: bits the same. On processors faster than counting and storing, since each solid is intersected once and
// the hierarchy walked once; on a GPU slower, since a ray's candidates wait for each other and one counter serves all.
// Broken by depth, if it has several work-items a ray: sorting a list of n takes n^2 steps.
//
// Mulder's semi-linked lists (thesis section 2.3.1) are not here. They give single nodes back while others are taken,
// by an allocator in the kernel (KMA, Spliet et al.), which lays its heap out on the device and which no OpenCL driver
// brings. What it saves is memory that a frame gives back before the frame ends; segments are all needed until kernel 4
// has read them, so nothing would be given back.
#include <cmath>

#include "base/identical.hpp"
#include "blists.hpp"
#include "device_method.hpp"
#include "each_ray.hpp"
#include "list.hpp"
#include "ray_events.hpp"

namespace csgrt::bench {
namespace {

constexpr std::uint32_t list_end = 0xffffffff;

class YangLists final : public DeviceWork {
public:
    YangLists(const Subject& subject, const TraceOptions& options, Device& device)
        : scene_(subject, options),
          slices_(static_cast<std::uint32_t>(options.knob)),
          covers_(subject.compiled.solids.size()),
          counter_(device, "counter of list nodes"),
          heads_(device, "heads of lists"),
          boundaries_(device, "list nodes"),
          next_(device, "links of list nodes") {
        for (const PositiveTree& tree : positive_trees(subject.compiled, Grouping::heavy_left, options.planted))
            blists_.push_back(blist_of(tree));
        counter_.reserve(sizeof(std::uint32_t));
    }

    Event launch(Kernel& kernel, const PartitionPass::Input& input, PartitionMemory& memory) override {
        const auto run = [&](std::uint32_t slices) {
            const std::size_t items = std::size_t{input.rays} * std::max(slices, 1u);
            return kernel.launch(items, work_group, input.batch.frame, input.scene.nodes(), input.scene.geometry(),
                                 input.batch.rays, input.batch.numbers(input.work), cl_uint{slices}, cl_uint{capacity_},
                                 counter_, heads_, boundaries_, next_);
        };
        const std::size_t heads = input.rays * sizeof(std::uint32_t);
        heads_.reserve(heads);
        for (std::uint32_t needed = 4 * input.rays;;) {
            if (needed > capacity_) {
                capacity_ = needed;
                boundaries_.reserve(2 * sizeof(kernel::Boundary) * std::size_t{capacity_});
                next_.reserve(sizeof(std::uint32_t) * std::size_t{capacity_});
            }
            counter_.queue_fill(0, sizeof(std::uint32_t));
            heads_.queue_fill(list_end, heads);
            inserts_.emplace_back(&PipelineCounts::evaluate, run(slices_));
            ++runs_;
            needed = counter_.read<std::uint32_t>(1).front();
            if (needed <= capacity_) break;
        }
        const std::vector<std::uint32_t> links = next_.read<std::uint32_t>(capacity_);
        for (std::uint32_t node : heads_.read<std::uint32_t>(input.rays))
            for (; node != list_end; node = links[node]) {
                ++links_;
                is_adjacent_ += links[node] + 1 == node;
            }
        own_bytes_ = heads_.size() + boundaries_.size() + next_.size();
        csgrt_bytes_ = memory.candidate_places().size() + memory.offsets().size() + memory.candidates().size() +
                       memory.found().size() + memory.boundaries().size();
        return run(0);
    }

    void read(const TracedBatch& traced, std::span<const Ray> rays, Answer* answers) override {
        const auto heads = heads_.read<std::uint32_t>(rays.size()), next = next_.read<std::uint32_t>(capacity_);
        const auto nodes = boundaries_.read<kernel::Boundary>(2 * std::size_t{capacity_});
        for (std::size_t ray = 0; ray < rays.size(); ++ray) {
            found_.clear();
            for (std::uint32_t node = heads[ray]; node != list_end; node = next[node])
                found_.insert(found_.end(), {nodes[2 * std::size_t{node}], nodes[2 * std::size_t{node} + 1]});
            const double tolerance = scene_.rays.tolerance(rays[ray]);
            const std::size_t first = 2 * std::size_t{traced.offsets[ray].segments};
            const std::size_t stored = 2 * std::size_t{traced.offsets[ray + 1].segments} - first;
            different_ += found_.size() != stored ||
                          !std::equal(found_.begin(), found_.end(), traced.boundaries.begin() + first,
                                      [&](const auto& a, const auto& b) { return is_stored_as(a, b, tolerance); });
            events_.sort(found_, tolerance);
            const auto& owners =
                owners_.find(events_, [this](std::uint32_t missed, auto& claimed) { classify(missed, claimed); });
            answers[ray].stretches = stretches_of(events_, owners, false);
        }
    }

    std::map<std::string, double> take_figures(const PipelineCounts& csgrt, double& seconds) override {
        PipelineCounts inserting;
        add_times(inserts_, inserting);
        seconds = 1e-3 * (inserting.evaluate + csgrt.evaluate);
        std::map<std::string, double> figures = {
            {"ms to find and insert", inserting.evaluate},
            {"ms to sort", csgrt.evaluate},
            {"ms of kernels 1 and 2", csgrt.count_segments + csgrt.scan + csgrt.store_segments},
            {"rays whose bits differ from kernels 1 and 2", static_cast<double>(different_)},
            {"runs", static_cast<double>(runs_)},
            {"links to the node before, share",
             static_cast<double>(is_adjacent_) / static_cast<double>(std::max<std::uint64_t>(links_, 1))},
            {"list MB", 1e-6 * static_cast<double>(own_bytes_)},
            {"MB of kernels 1 and 2", 1e-6 * static_cast<double>(csgrt_bytes_)}};
        inserts_.clear();
        different_ = runs_ = links_ = is_adjacent_ = 0;
        return figures;
    }

private:
    /// Whether kernel 2 stored the same bits. Kernel 3 has moved some ends to their event since.
    static bool is_stored_as(const kernel::Boundary& own, const kernel::Boundary& stored, double tolerance) {
        const bool is_moved = stored.t < own.t && own.t - stored.t <= tolerance;
        return own.solid == stored.solid && own.surface == stored.surface && (is_moved || same_bits(own.t, stored.t));
    }

    /// Finds the least region that claims each step.
    void classify(std::uint32_t missed, std::vector<std::uint32_t>& claimed) {
        claimed.assign(events_.steps(), NONE);
        for (std::uint32_t step = 0; step < events_.steps(); ++step) {
            regions_.clear();
            ++place_;
            for (const RayEvents::Segment& segment : events_.segments) {
                if (step < segment.in || step >= segment.out || (segment.missed & missed)) continue;
                covers_[segment.solid] = place_;
                scene_.add_regions_of(segment.solid, regions_);
            }
            sort_once(regions_);
            const auto region = std::find_if(regions_.begin(), regions_.end(), [this](auto r) { return holds(r); });
            if (region != regions_.end()) claimed[step] = *region;
        }
    }
    bool holds(std::uint32_t region) const {
        std::uint32_t at = 0;
        while (at < BlistLeaf::out) {
            const BlistLeaf& leaf = blists_[region][at];
            at = (covers_[leaf.solid] == place_) != leaf.complement ? leaf.on_true : leaf.on_false;
        }
        return at == BlistLeaf::in;
    }

    EventScene scene_;
    std::uint32_t slices_, capacity_ = 0;  ///< work-items a ray; nodes
    std::vector<std::vector<BlistLeaf>> blists_;
    std::vector<std::uint64_t> covers_;  ///< by solid: the last place that it covers
    std::uint64_t place_ = 0;
    Buffer counter_, heads_, boundaries_, next_;
    TimedKernels inserts_;
    std::vector<kernel::Boundary> found_;
    RayEvents events_;
    StepOwners owners_;
    std::vector<std::uint32_t> regions_;
    std::uint64_t different_ = 0, runs_ = 0, links_ = 0, is_adjacent_ = 0, own_bytes_ = 0, csgrt_bytes_ = 0;
};

}  // namespace

Method yang_lists() {
    return {
        .name = "Yang's lists",
        .source = "Yang et al. 2010",
        .about =
            "One pass finds the segments of all rays and puts them into linked lists, with one atomic counter of "
            "nodes; a second kernel sorts each list. They are compared with what kernels 1 and 2 store, bit by bit. "
            "The time is that of the lists alone: regions follow on the host.",
        .breaks = "depth, with several work-items a ray: sorting takes the square of a list. No family makes it wrong.",
        .knob = "work-items a ray",
        .knob_values = {1, 4},
        .first_hits = false,
        .on_device = true,
        .on_chart = false,
        .prepare = [](const Subject& subject, const TraceOptions& options) {
            if (!(options.knob >= 1 && options.knob <= 64) || options.knob != std::floor(options.knob))
                throw Error(Status::usage, "Yang's lists: needs from 1 to 64 work-items a ray");
            DeviceMethod method{.name = "Yang's lists", .kernel = "yang_lists", .tables = {}, .figures = {}};
            method.work = [subject, options](Device& device) {
                return std::make_unique<YangLists>(subject, options, device);
            };
            return trace_on_device(subject, options, std::move(method));
        }};
}

}  // namespace csgrt::bench
