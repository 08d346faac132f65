// Methods whose kernel runs in place of kernel 4, behind the library's kernels 1 to 3.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "method.hpp"
#include "pipeline/passes/partitions.hpp"
#include "positive_tree.hpp"

namespace csgrt::bench {

/// The work of a method with its kernel, if this does not look for the owners of kernel 3's partitions.
class DeviceWork {
public:
    virtual ~DeviceWork() = default;
    virtual Event launch(Kernel& kernel, const PartitionPass::Input& input, PartitionMemory& memory) = 0;
    /// The answers of the batch that was launched last. `traced`: what csgrt's kernels 1 to 3 made of it.
    virtual void read(const TracedBatch& traced, std::span<const Ray> rays, Answer* answers) = 0;
    /// Since the last call. `csgrt`: the times of kernels 1 to 3, and as kernel 4's that of the last launch. `seconds`:
    /// of the kernels that count as the method's time.
    virtual std::map<std::string, double> take_figures(const PipelineCounts& csgrt, double& seconds) = 0;
};

struct DeviceMethod {
    std::string name;                                ///< for messages
    std::string kernel;                              ///< of the files that source() in device_method.cpp joins
    std::vector<std::vector<std::uint32_t>> tables;  ///< the method's own, from table 2 on (kernels/covered.h)
    bool item_a_ray = false;                         ///< else a work-item is a node of kernel 3's lists
    std::size_t group = 0;                           ///< work-items of a group; 0: as many as csgrt's kernels have
    std::size_t ray_words = 0;                       ///< of memory that a ray has, 0 at first
    std::map<std::string, double> figures;
    std::function<std::unique_ptr<DeviceWork>(Device&)> work = {};  ///< none: the kernel looks for owners
};

/// Throws Error: no_device; usage, if the device's kernels are compiled ahead; device_fault; out_of_memory.
std::unique_ptr<Tracer> trace_on_device(const Subject& subject, const TraceOptions& options, DeviceMethod method);

/// Of each region its tree; none of a region without solids.
std::vector<PositiveTree> positive_trees(const CompiledScene& scene, Grouping grouping, bool planted);

/// Lists, one behind the other: where each begins, and the end; and what they hold.
struct ListTable {
    std::vector<std::uint32_t> firsts{0}, values;
    void end_list() { firsts.push_back(static_cast<std::uint32_t>(values.size())); }
    /// Throws Error (usage): the table is too large for 32 bits.
    static ListTable of(const std::vector<std::vector<std::uint32_t>>& lists);
};

}  // namespace csgrt::bench
