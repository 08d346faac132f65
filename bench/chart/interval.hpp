// How sure a measured figure is: intervals of 95 %.
#pragma once

#include <cstddef>
#include <vector>

namespace csgrt::bench {

struct ConfidenceInterval {
    double low = 0, high = 0;
};

/// Of the share behind `wrong` of `all` trials (Wilson 1927); 0 of n: up to 3.84 / (n + 3.84). Of none: 0 to 1.
ConfidenceInterval share_interval(std::size_t wrong, std::size_t all);

/// Of the median behind these measurements, by order statistics: the narrowest two of them between which it lies with
/// 95 % whatever the distribution is. Less than 6 measurements cannot tell: then the least and the largest. 0 of none.
ConfidenceInterval median_interval(std::vector<double> measured);

}  // namespace csgrt::bench
