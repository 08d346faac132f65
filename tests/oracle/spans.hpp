// Sets of numbers as ascending, disjoint spans [in, out], and the few operations that the judge needs on them.
#pragma once

#include <algorithm>
#include <vector>

#include "quad.hpp"

namespace csgrt::oracle {

inline quad infinity() { return std::numeric_limits<double>::infinity(); }

/// An end of a span and the surface that bounds it there (-1: none).
struct Bound {
    quad at = 0;
    int surface = -1;
};
struct Span {
    Bound in, out;
};
using Spans = std::vector<Span>;

inline Spans everything() { return {{{-infinity(), -1}, {infinity(), -1}}}; }

/// Common to both; spans of no length are dropped.
inline Spans intersect(const Spans& a, const Spans& b) {
    Spans common;
    for (std::size_t i = 0, j = 0; i < a.size() && j < b.size();) {
        const Bound in = a[i].in.at < b[j].in.at ? b[j].in : a[i].in;
        const Bound out = b[j].out.at < a[i].out.at ? b[j].out : a[i].out;
        if (in.at < out.at) common.push_back({in, out});
        a[i].out.at < b[j].out.at ? ++i : ++j;
    }
    return common;
}

inline Spans complement(const Spans& a) {
    Spans rest;
    Bound from{-infinity(), -1};
    for (const Span& span : a) {
        if (from.at < span.in.at) rest.push_back({from, span.in});
        from = span.out;
    }
    if (from.at < infinity()) rest.push_back({from, {infinity(), -1}});
    return rest;
}

/// The union of spans in any order, overlapping or touching.
inline Spans join(Spans spans) {
    std::sort(spans.begin(), spans.end(), [](const Span& a, const Span& b) { return a.in.at < b.in.at; });
    Spans joined;
    for (const Span& span : spans) {
        if (!joined.empty() && span.in.at <= joined.back().out.at) {
            if (joined.back().out.at < span.out.at) joined.back().out = span.out;
        } else {
            joined.push_back(span);
        }
    }
    return joined;
}

inline Spans unite(Spans a, const Spans& b) {
    a.insert(a.end(), b.begin(), b.end());
    return join(std::move(a));
}
inline Spans subtract(const Spans& a, const Spans& b) { return intersect(a, complement(b)); }

/// The same number of spans in all three, each inner one in its exact one in its outer one.
inline bool nested_one_to_one(const Spans& inner, const Spans& exact, const Spans& outer) {
    if (inner.size() != exact.size() || outer.size() != exact.size()) return false;
    for (std::size_t i = 0; i < exact.size(); ++i)
        if (inner[i].in.at < exact[i].in.at || exact[i].out.at < inner[i].out.at || exact[i].in.at < outer[i].in.at ||
            outer[i].out.at < exact[i].out.at)
            return false;
    return true;
}

}  // namespace csgrt::oracle
