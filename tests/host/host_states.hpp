// How a program may compute when it calls csgrt: it rounds otherwise, has traps, or takes tiny numbers for 0.
#pragma once

#include <cfenv>

#if defined(__SSE2__)
#include <immintrin.h>
#endif

namespace csgrt::test {

struct HostState {
    const char* name;
    void (*set)();
};

// Under a trap no line of a test's own may round.
inline const HostState host_states[] = {
    {"rounds up", [] { std::fesetround(FE_UPWARD); }},
    {"rounds down", [] { std::fesetround(FE_DOWNWARD); }},
    {"rounds to zero", [] { std::fesetround(FE_TOWARDZERO); }},
    {"traps", [] { feenableexcept(FE_ALL_EXCEPT); }},
#if defined(__SSE2__)
    {"takes tiny numbers for 0", [] { _mm_setcsr(_mm_getcsr() | 0x8040); }},
    {"all at once",
     [] {
         std::fesetround(FE_UPWARD);
         feenableexcept(FE_ALL_EXCEPT);
         _mm_setcsr(_mm_getcsr() | 0x8040);
     }},
#endif
};

/// All of the state, with the flags that tell what has happened.
struct State {
    int rounding = std::fegetround(), traps = fegetexcept(), flags = std::fetestexcept(FE_ALL_EXCEPT);
#if defined(__SSE2__)
    unsigned control = _mm_getcsr();
#endif
    bool operator==(const State&) const = default;
};

/// While it lives, the thread computes in that way.
class InState {
public:
    explicit InState(const HostState& host) {
        std::fegetenv(&before_);
        host.set();
    }
    InState(const InState&) = delete;
    InState& operator=(const InState&) = delete;
    ~InState() { std::fesetenv(&before_); }

private:
    std::fenv_t before_;
};

}  // namespace csgrt::test
