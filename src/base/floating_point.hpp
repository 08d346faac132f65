// Floating-point state: how a thread's processor rounds, where it traps, whether it takes tiny numbers for 0. csgrt's
// bits depend on it, but it belongs to the host. So each public function that computes sets the state that csgrt needs,
// and restores the host's. All in the header, as in new_file.hpp.
#pragma once

#include <cfenv>
#include <functional>
#include <utility>

namespace csgrt {

/// Sets the default of IEEE 754 for its thread while it lives: to nearest, without traps. Then it restores the former
/// state, and flags that were raised meanwhile are gone.
class FloatingPoint {
public:
    FloatingPoint() noexcept : FloatingPoint(FE_DFL_ENV) {}
    FloatingPoint(const FloatingPoint&) = delete;
    FloatingPoint& operator=(const FloatingPoint&) = delete;
    ~FloatingPoint() { std::fesetenv(&before_); }

    /// Wraps a function of the host, so that it runs with the host's former state, on any thread. Both the object and
    /// the function must outlive the result.
    template <class Result, class... Arguments>
    std::function<Result(Arguments...)> of_host(const std::function<Result(Arguments...)>& function) const {
        if (!function) return {};
        return [this, &function](Arguments... arguments) {
            const FloatingPoint hosts(&before_);
            return function(std::forward<Arguments>(arguments)...);
        };
    }

private:
    explicit FloatingPoint(const std::fenv_t* now) noexcept {
        std::fegetenv(&before_);
        std::fesetenv(now);
    }

    std::fenv_t before_;
};

}  // namespace csgrt
