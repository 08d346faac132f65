// Erase at: erases elements at given positions.
#pragma once

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace csgrt {

/// Erases the elements at `positions`, which ascend. All other elements keep their order.
template <class T>
void erase_at(std::vector<T>& all, const std::vector<std::uint32_t>& positions) {
    if (positions.empty()) return;
    auto next = positions.begin();
    std::size_t kept = positions.front();
    for (std::size_t i = kept; i < all.size(); ++i) {
        if (next != positions.end() && *next == i) {
            ++next;
        } else {
            all[kept++] = std::move(all[i]);
        }
    }
    all.resize(kept);
}

/// Returns a list (SharedList) without the elements at `positions`, which ascend.
template <class List>
List without(const List& all, const std::vector<std::uint32_t>& positions) {
    List left(all.size() - positions.size());
    auto next = positions.begin();
    std::size_t kept = 0;
    for (std::size_t i = 0; i < all.size(); ++i) {
        if (next != positions.end() && *next == i) {
            ++next;
        } else {
            left.own(kept++) = all[i];
        }
    }
    return left;
}

}  // namespace csgrt
