#include "interval.hpp"

#include <algorithm>
#include <cmath>

namespace csgrt::bench {

ConfidenceInterval share_interval(std::size_t wrong, std::size_t all) {
    if (all == 0) return {0, 1};
    constexpr double z = 1.959963984540054, z2 = z * z;  // of the normal distribution, 2.5 % lie above
    const double n = static_cast<double>(all), p = static_cast<double>(wrong) / n;
    const double middle = (p + z2 / (2 * n)) / (1 + z2 / n);
    const double half = z / (1 + z2 / n) * std::sqrt(p * (1 - p) / n + z2 / (4 * n * n));
    return {wrong == 0 ? 0.0 : middle - half, wrong == all ? 1.0 : middle + half};
}

ConfidenceInterval median_interval(std::vector<double> measured) {
    if (measured.empty()) return {};
    std::sort(measured.begin(), measured.end());
    // As many are left out on either side as are below the median with 2.5 % at most: of n measurements k are, with
    // n! / (k! (n - k)!) 2^-n.
    const std::size_t n = measured.size();
    std::size_t left_out = 0;
    double below = 0, of_k = std::pow(0.5, static_cast<double>(n));
    for (std::size_t k = 0; 2 * k + 1 < n; ++k) {
        below += of_k;
        if (below > 0.025) break;
        left_out = k;
        of_k *= static_cast<double>(n - k) / static_cast<double>(k + 1);
    }
    return {measured[left_out], measured[n - 1 - left_out]};
}

}  // namespace csgrt::bench
