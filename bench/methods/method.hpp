// The laboratory: other people's methods of ray tracing CSG, one file each, beside the library's own.
//
// A method gets what the library's kernels get: the compiled scene, its hierarchy, the code that intersects solids
// (scene_rays.hpp). It answers rays for the chart's judges (bench/chart/accuracy.hpp). No method calls the library's
// weaving, its evaluation or its reference. None is linked into the library.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include <csgrt/renderer.hpp>

#include "bench/chart/accuracy.hpp"
#include "compile/compiled_scene.hpp"

namespace csgrt::bench {

/// What a method traces. All of it outlives the tracer.
struct Subject {
    const Scene& scene;
    const std::vector<std::string>& objects;
    const CompiledScene& compiled;
};

struct TraceOptions {
    double knob = 0;          ///< the value of the method's parameter; 0: it has none
    bool first_hits = false;  ///< only the first stretch is wanted that does not end at or behind the ray's start
    std::string device;       ///< as of csgrt, for methods with kernels; the others run on the processors
    unsigned threads = 0;     ///< of the others; 0: one a processor
    bool planted = false;     ///< every difference is taken for a union: the judge must see it (a test)
};

/// What a method says of one ray.
struct Answer {
    bool answered = true;  ///< false: the method gives this ray up. It is counted, and not judged
    /// Of regions, in order of distance, without gaps. The judge joins neighbours that touch. Of first hits one, whose
    /// `out` may be infinite: methods need not look for it.
    Sequence stretches;
};

/// A method, prepared for one subject and one value of its knob.
class Tracer {
public:
    virtual ~Tracer() = default;
    virtual std::vector<Answer> trace(const std::vector<Ray>& rays) = 0;
    /// Seconds of the last trace(): of its kernels on a device, else of the loop over rays by the clock.
    virtual double seconds() const = 0;
    /// What else the method has to tell of the subject or of the last trace(), by name with its unit: "bits a label",
    /// "meshing s", "mesh MB", "nodes a ray".
    virtual std::map<std::string, double> figures() const { return {}; }
};

/// A method of the laboratory.
struct Method {
    std::string name;    ///< on the chart: "Roth"
    std::string source;  ///< author and year
    std::string about;   ///< two or three sentences: what it does, what was done for its speed
    std::string breaks;  ///< which stress family will break it, and why: written before it was measured
    std::string knob;    ///< the parameter's name and unit; empty: it has none
    std::vector<double> knob_values = {};            ///< from coarse to fine
    bool first_hits = true, every_partition = true;  ///< what it can answer
    bool exact = true;       ///< it has no error of its own: its regions are those of the reference
    bool gives_up = false;   ///< there are scenes of which it answers few rays or none
    bool on_device = false;  ///< it has kernels
    bool on_chart = true;    ///< false: its time is that of a part of its work
    /// Throws Error (usage), with words, if the method cannot trace this subject.
    std::function<std::unique_ptr<Tracer>(const Subject&, const TraceOptions&)> prepare;
};

/// All of them, in the chart's order.
const std::vector<Method>& methods();

}  // namespace csgrt::bench
