// Floating-point state: how a thread's processor rounds, when it traps, whether it takes tiny numbers for 0. The bits
// of csgrt's answers depend on the state, but the host owns it. So each public function that computes sets the state
// that csgrt needs, and restores the host's. The header holds all of the code, as new_file.hpp does.
#pragma once

#include <cfenv>
#include <functional>
#include <utility>

namespace csgrt {

/// Sets the default state of IEEE 754 for its thread while it lives: rounding to nearest, without traps. The destructor
/// restores the former state; flags that were raised meanwhile are lost.
class FloatingPoint {
public:
    FloatingPoint() noexcept : FloatingPoint(FE_DFL_ENV) {}
    FloatingPoint(const FloatingPoint&) = delete;
    FloatingPoint& operator=(const FloatingPoint&) = delete;
    ~FloatingPoint() { std::fesetenv(&before_); }

    /// Wraps a function of the host, so that it runs with the host's former state, on any thread. This object and
    /// `function` must outlive the result.
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
