// Finding list: the first findings, and the number of the others.
#pragma once

#include <algorithm>
#include <cstddef>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include <csgrt/error.hpp>

namespace csgrt {

/// The order of places in a file.
inline bool comes_before(const Place& a, const Place& b) {
    return std::tie(a.line, a.column, a.offset) < std::tie(b.line, b.column, b.offset);
}

/// Collects findings and sorts them by their places in the file.
class FindingList {
public:
    /// The largest number of findings that are shown. Others are only counted.
    static constexpr std::size_t most = 50;

    bool empty() const noexcept { return found_.empty(); }
    bool full() const noexcept { return found_.size() == most; }
    /// Counts a finding that is not shown.
    void leave_out() noexcept { ++left_out_; }
    /// Notes that the check stopped early.
    void stop() noexcept { stopped_ = true; }
    void add(Diagnostic diagnostic) {
        if (full()) return leave_out();
        found_.push_back(std::move(diagnostic));
    }
    void sort_by_place() {
        std::stable_sort(found_.begin(), found_.end(),
                         [](const Diagnostic& a, const Diagnostic& b) { return comes_before(a.place, b.place); });
    }
    std::vector<Diagnostic>& shown() noexcept { return found_; }
    /// Takes all findings out of the list. If there are more than these, the last one tells their number.
    std::vector<Diagnostic> take() {
        if (left_out_ > 0 || stopped_)
            found_.push_back({{},
                              std::string("and ") + (stopped_ ? "at least " : "") + std::to_string(left_out_) +
                                  (left_out_ == 1 ? " more error" : " more errors"),
                              {},
                              {}});
        left_out_ = 0;
        stopped_ = false;
        return std::exchange(found_, {});
    }

private:
    std::vector<Diagnostic> found_;
    std::size_t left_out_ = 0;
    bool stopped_ = false;
};

}  // namespace csgrt
