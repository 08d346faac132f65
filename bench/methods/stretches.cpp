#include "stretches.hpp"

#include <algorithm>
#include <map>

namespace csgrt::bench {

Sequence owners(const std::vector<Stretch>& claimed, double epsilon, bool first) {
    struct Event {
        double t;
        std::uint32_t region;
        int change;
    };
    std::vector<Event> events;
    for (const Stretch& s : claimed)
        if (s.in < s.out) {
            events.push_back({s.in, s.region, 1});
            events.push_back({s.out, s.region, -1});
        }
    std::sort(events.begin(), events.end(), [](const Event& a, const Event& b) { return a.t < b.t; });
    Sequence sequence;
    std::map<std::uint32_t, int> open;
    Stretch now;
    for (std::size_t i = 0; i < events.size();) {
        const double t = events[i].t;
        for (; i < events.size() && events[i].t <= t + epsilon; ++i) {
            const auto at = open.try_emplace(events[i].region, 0).first;
            if ((at->second += events[i].change) == 0) open.erase(at);
        }
        const std::uint32_t owner = open.empty() ? Stretch::gap : open.begin()->first;
        if (owner == now.region) continue;
        if (now.region != Stretch::gap && t > 0) {
            now.out = t;
            sequence.push_back(now);
            if (first) return sequence;
        }
        now = {owner, t, t};
    }
    return sequence;
}

}  // namespace csgrt::bench
