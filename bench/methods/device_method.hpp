// Methods whose kernel runs in place of kernel 4, behind the library's kernels 1 to 3.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "method.hpp"
#include "positive_tree.hpp"

namespace csgrt::bench {

struct DeviceMethod {
    std::string name;                                ///< for messages
    std::string kernel;                              ///< of the files that source() in device_method.cpp joins
    std::vector<std::vector<std::uint32_t>> tables;  ///< the method's own, from table 2 on (kernels/covered.h)
    bool item_a_ray = false;                         ///< else a work-item is a node of kernel 3's lists
    std::size_t ray_words = 0;                       ///< of memory that a ray has, 0 at first
    std::map<std::string, double> figures;
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
