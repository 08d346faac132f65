#include "scene_weave.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace csgrt::oracle {

Spans resized(Spans spans, quad by) {
    for (Span& s : spans) {
        s.in.at = s.in.at - by;
        s.out.at = s.out.at + by;
    }
    std::erase_if(spans, [](const Span& s) { return !(s.in.at < s.out.at); });
    return join(std::move(spans));
}

namespace {

/// May an end be somewhere else altogether: where a ray runs along a face, another one decides?
bool leaps(const Spans& inner, const Spans& outer, quad far) {
    for (std::size_t i = 0; i < inner.size(); ++i)
        if (inner[i].in.at - outer[i].in.at > far || outer[i].out.at - inner[i].out.at > far) return true;
    return false;
}

/// A solid's set begins or ends here.
struct Change {
    double rounded = 0;  ///< orders most of them
    quad at = 0;
    std::size_t solid = 0;
    int which = 0, by = 0;  ///< which of inner, exact and outer; 1 or -1

    friend bool operator<(const Change& a, const Change& b) {
        return a.rounded != b.rounded ? a.rounded < b.rounded : a.at < b.at;
    }
};

using Inside = std::array<int, 3>;  ///< in how many spans of inner, exact and outer

std::vector<Change> changes_of(const std::vector<Sure>& sets, std::vector<Inside>& inside) {
    std::vector<Change> changes;
    for (const Sure& set : sets) {
        int which = 0;
        for (const Spans* spans : {&set.inner, &set.exact, &set.outer}) {
            for (const Span& s : *spans) {
                const double in = to_double(s.in.at), out = to_double(s.out.at);
                if (std::isinf(in))
                    ++inside[set.index][static_cast<std::size_t>(which)];
                else
                    changes.push_back({in, s.in.at, set.index, which, 1});
                if (!std::isinf(out)) changes.push_back({out, s.out.at, set.index, which, -1});
            }
            ++which;
        }
    }
    std::sort(changes.begin(), changes.end());
    return changes;
}

/// Where a region is, as the pieces of the ray are gone through.
struct Woven {
    std::size_t index = 0;
    Membership sure = Membership::outside;
    bool exact = false;
    Spans inner_spans, exact_spans, outer_spans;

    static void turn(Spans& spans, bool from, bool to, quad at) {
        if (to && !from && !spans.empty() && spans.back().out.at == at)
            spans.back().out.at = infinity();
        else if (to && !from)
            spans.push_back({{at, 0}, {infinity(), 0}});
        else if (from && !to)
            spans.back().out.at = at;
    }
    void become(Membership s, bool e, quad at) {
        turn(inner_spans, sure == Membership::inside, s == Membership::inside, at);
        turn(outer_spans, sure != Membership::outside, s != Membership::outside, at);
        turn(exact_spans, exact, e, at);
        sure = s;
        exact = e;
    }
};

}  // namespace

void weave(const std::vector<Sure>& sets, const std::vector<OracleRegion>& regions,
           const std::vector<std::vector<std::uint32_t>>& regions_of, quad most, SceneAnswer& answer) {
    std::vector<Inside> inside(regions_of.size());
    const std::vector<Change> changes = changes_of(sets, inside);
    // Regions none of whose solids are met hold nothing.
    std::vector<Woven> found;
    std::vector<std::uint32_t> touched;
    for (const Sure& set : sets)
        touched.insert(touched.end(), regions_of[set.index].begin(), regions_of[set.index].end());
    const auto make_unique = [](std::vector<std::uint32_t>& some) {
        std::sort(some.begin(), some.end());
        some.erase(std::unique(some.begin(), some.end()), some.end());
    };
    make_unique(touched);
    for (const std::uint32_t r : touched) {
        found.emplace_back();
        found.back().index = r;
    }
    const auto sure = [&](std::size_t s) {
        return inside[s][0] > 0 ? Membership::inside : inside[s][2] > 0 ? Membership::unsure : Membership::outside;
    };
    const auto exact = [&](std::size_t s) { return inside[s][1] > 0 ? Membership::inside : Membership::outside; };
    const auto at_region = [](const Woven& w, std::uint32_t r) { return w.index < r; };
    quad at = -infinity();
    for (std::size_t next = 0;;) {
        // Memberships change only in regions of the solids that begin or end here.
        for (const std::uint32_t r : touched) {
            const OracleRegion& region = regions[r];
            std::lower_bound(found.begin(), found.end(), r, at_region)
                ->become(region.evaluate(sure), region.evaluate(exact) == Membership::inside, at);
        }
        const quad from = at;
        const bool ends = next == changes.size();
        at = ends ? infinity() : changes[next].at;
        Piece piece{to_double(from), to_double(at), {}};
        for (const Woven& one : found)
            if (one.sure != Membership::outside)
                piece.claims.push_back({static_cast<std::uint32_t>(one.index), one.sure == Membership::inside});
        answer.pieces.push_back(std::move(piece));
        if (ends) break;
        touched.clear();
        for (; next < changes.size() && changes[next].at == at; ++next) {
            const Change& change = changes[next];
            inside[change.solid][static_cast<std::size_t>(change.which)] += change.by;
            const std::vector<std::uint32_t>& of = regions_of[change.solid];
            touched.insert(touched.end(), of.begin(), of.end());
        }
        make_unique(touched);
    }
    answer.regions.resize(regions.size());
    for (Woven& one : found) {
        answer.tie = answer.tie || !nested_one_to_one(one.inner_spans, one.exact_spans, one.outer_spans) ||
                     leaps(one.inner_spans, one.outer_spans, 8 * most);
        answer.regions[one.index] = std::move(one.exact_spans);
    }
}

}  // namespace csgrt::oracle
