// A tenth of the faults that a test can let happen. `ctest -C Long -L faults` lets all happen. The seed is the same in
// each run, since PoCL may wait for ever where memory ends (docs/reliability.md); CSGRT_FAULT_SEED gives another.
#pragma once

#include <cstdlib>

#include "catch.hpp"

namespace csgrt::test {

constexpr unsigned long all_faults = 1, some_faults = 10;

/// Draws one of `step` faults, in turn from a place that CSGRT_FAULT_SEED gives; it is printed.
class FaultDraw {
public:
    explicit FaultDraw(unsigned long step) : step_(step) {
        if (step == all_faults) return;
        const char* const given = std::getenv("CSGRT_FAULT_SEED");
        next_ = given != nullptr ? std::strtoul(given, nullptr, 10) : 7;
        WARN("CSGRT_FAULT_SEED=" << next_ << ": one fault of " << step);
    }
    /// Whether the next fault is to happen.
    bool draws() { return next_++ % step_ == 0; }
    /// Of faults whose number is not known before: the first of 1, 2, ... that is to happen, another one in each call.
    unsigned long first() { return 1 + next_++ % step_; }

private:
    unsigned long step_, next_ = 0;
};

}  // namespace csgrt::test
