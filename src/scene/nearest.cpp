#include "scene/nearest.hpp"

#include <algorithm>
#include <cstddef>

#include "base/letters.hpp"

namespace csgrt {

namespace {

/// The longest names that are compared: the time of a comparison grows with the product of the lengths.
constexpr std::size_t longest = 64;
constexpr std::size_t most_steps = 2'000'000;  ///< number of compared letters

/// The number of letters to add, remove, replace or swap with a neighbour, to get one word from the other. Upper and
/// lower case are the same.
std::size_t edit_distance(std::string_view a, std::string_view b) {
    std::vector<std::size_t> before_last(b.size() + 1), last(b.size() + 1), row(b.size() + 1);
    for (std::size_t j = 0; j <= b.size(); ++j) last[j] = j;
    for (std::size_t i = 1; i <= a.size(); ++i) {
        row[0] = i;
        for (std::size_t j = 1; j <= b.size(); ++j) {
            const std::size_t replaced = last[j - 1] + (lower(a[i - 1]) != lower(b[j - 1]));
            row[j] = std::min({last[j] + 1, row[j - 1] + 1, replaced});
            const bool swapped =
                i > 1 && j > 1 && lower(a[i - 1]) == lower(b[j - 2]) && lower(a[i - 2]) == lower(b[j - 1]);
            if (swapped) row[j] = std::min(row[j], before_last[j - 2] + 1);
        }
        before_last.swap(last);
        last.swap(row);
    }
    return last[b.size()];
}

/// Is `start` the beginning of `whole`, for example "tor" of "torus"?
bool is_start(std::string_view start, std::string_view whole) { return start.size() >= 3 && whole.starts_with(start); }

}  // namespace

std::string did_you_mean(std::string_view wrong, const std::vector<std::string_view>& known) {
    if (wrong.size() > longest) return {};
    const std::size_t allowed = std::max<std::size_t>(1, wrong.size() / 3);
    std::string_view best, same_start;
    std::size_t best_distance = allowed + 1, steps = 0;
    for (const std::string_view candidate : known) {
        if (is_start(candidate, wrong) || is_start(wrong, candidate)) same_start = candidate;
        const std::size_t difference =
            std::max(candidate.size(), wrong.size()) - std::min(candidate.size(), wrong.size());
        if (difference >= best_distance) continue;  // the distance is at least the difference of the lengths
        if ((steps += wrong.size() * candidate.size()) > most_steps) break;
        const std::size_t distance = edit_distance(wrong, candidate);
        // If every letter would be replaced, the name is not a misspelt one.
        if (distance < best_distance && distance < std::max(wrong.size(), candidate.size())) {
            best = candidate;
            best_distance = distance;
        }
    }
    if (best.empty()) best = same_start;
    return best.empty() ? std::string() : "did you mean '" + std::string(best) + "'?";
}

}  // namespace csgrt
