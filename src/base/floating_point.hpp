// How a thread's processor computes: how it rounds, where it traps, whether it takes tiny numbers for 0. csgrt's bits
// hang on it, and it belongs to the host: each public function that computes sets what csgrt needs, and gives the
// host's back. All in the header, as new_file.hpp is.
#pragma once

#include <cfenv>
#include <functional>
#include <utility>

namespace csgrt {

/// While it lives, its thread computes as IEEE 754 has it by default: to nearest, without traps. Then it computes as
/// before, and nothing tells of what happened meanwhile.
class FloatingPoint {
public:
    FloatingPoint() noexcept : FloatingPoint(FE_DFL_ENV) {}
    FloatingPoint(const FloatingPoint&) = delete;
    FloatingPoint& operator=(const FloatingPoint&) = delete;
    ~FloatingPoint() { std::fesetenv(&before_); }

    /// The host's function, which computes as the host did before this; on whatever thread. Both must outlive it.
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
