#include "loft.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

#include "compile/linear.hpp"
#include "scene/vector.hpp"

namespace csgrt::bench {
namespace {

using Curve = std::function<Vec3(double)>;

double distance_to_chord(const Vec3& p, const Vec3& a, const Vec3& b) {
    const Vec3 along = b - a;
    const double square = dot(along, along);
    const double at = square > 0 ? std::clamp(dot(p - a, along) / square, 0.0, 1.0) : 0;
    return length(p - (a + at * along));
}

/// How far the curve is from its chord between two of its points, as some points between them tell.
double bend(const Curve& curve, double from, double to) {
    const Vec3 a = curve(from), b = curve(to);
    double most = 0;
    for (int i = 1; i < 8; ++i) most = std::max(most, distance_to_chord(curve(from + i * (to - from) / 8), a, b));
    return most;
}

/// Parameters from `from` to `to` between which no curve bends by more than `chord`, about as few as there can be.
std::vector<double> steps(const std::vector<Curve>& curves, double from, double to, double chord, std::size_t most) {
    const auto bends = [&](double a, double b) {
        double worst = 0;
        for (const Curve& curve : curves) worst = std::max(worst, bend(curve, a, b));
        return worst;
    };
    std::vector<double> greedy{from};
    double step = to - from;
    for (double at = from; at < to;) {
        step = std::min(2 * step, to - at);
        for (double b; (b = bends(at, at + step)) > chord;) step *= std::clamp(0.99 * std::sqrt(chord / b), 0.2, 0.95);
        at = to - at <= step ? to : at + step;
        greedy.push_back(at);
        if (greedy.size() > most) refuse_size();
    }
    // The last step is shorter. As many equal ones do as well on a circle, and make equal cylinders equal meshes.
    const std::size_t count = greedy.size() - 1;
    std::vector<double> equal(count + 1);
    for (std::size_t i = 0; i <= count; ++i)
        equal[i] = i == count ? to : from + static_cast<double>(i) * (to - from) / static_cast<double>(count);
    for (std::size_t i = 0; i < count; ++i)
        if (bends(equal[i], equal[i + 1]) > chord) return greedy;
    return equal;
}

/// The same from each of `breaks` to the next one.
std::vector<double> steps_between(const std::vector<Curve>& curves, const std::vector<double>& breaks, double chord,
                                  std::size_t most) {
    std::vector<double> all{breaks.front()};
    for (std::size_t i = 0; i + 1 < breaks.size(); ++i) {
        const std::vector<double> part = steps(curves, breaks[i], breaks[i + 1], chord, most);
        all.insert(all.end(), part.begin() + 1, part.end());
    }
    return all;
}

class Lofter {
public:
    Lofter(const Loft& loft, const Matrix& matrix, const FacetOptions& options)
        : loft_(loft), matrix_(matrix), options_(options) {}

    Triangles mesh() {
        // Half of the error for each direction makes the fewest triangles.
        const double chord = options_.chord / 2;
        std::vector<Curve> around, along;
        for (const double s : samples(loft_.sections, 4)) around.push_back([this, s](double t) { return at(s, t); });
        for (const double t : samples(loft_.angles, 4)) along.push_back([this, t](double s) { return at(s, t); });
        t_ = steps_between(around, loft_.angles, chord, options_.most);
        s_ = steps_between(along, loft_.sections, chord, options_.most);
        if (loft_.is_round) t_.pop_back();
        // A section may be another ellipse than the one before: then the triangles between them are off where both
        // sections and all angles are straight.
        while (twist() > options_.chord) {
            std::vector<double> finer;
            for (std::size_t i = 0; i + 1 < s_.size(); ++i) {
                finer.push_back(s_[i]);
                finer.push_back((s_[i] + s_[i + 1]) / 2);
            }
            finer.push_back(s_.back());
            s_ = std::move(finer);
            check_size();
        }
        check_size();
        if (loft_.is_ring) s_.pop_back();
        return join();
    }

private:
    Vec3 at(double s, double t) const { return narrow(transform_point(matrix_, wide(loft_.at(s, t)))); }

    void check_size() const {
        if (static_cast<double>(s_.size()) * static_cast<double>(t_.size()) * 2 > static_cast<double>(options_.most))
            refuse_size();
    }

    static std::vector<double> samples(const std::vector<double>& breaks, int each) {
        std::vector<double> all;
        for (std::size_t i = 0; i + 1 < breaks.size(); ++i)
            for (int k = 0; k < each; ++k) all.push_back(breaks[i] + k * (breaks[i + 1] - breaks[i]) / each);
        all.push_back(breaks.back());
        return all;
    }

    /// Along the surface's normal, how far the diagonals of quadrangles are from it; as some of them tell.
    double twist() const {
        double worst = 0;
        const std::size_t rows = s_.size() - 1, columns = t_.size();
        for (std::size_t i = 0; i < rows; i += 1 + rows / 64)
            for (std::size_t j = 0; j + 1 < columns; j += 1 + columns / 64) {
                const double s0 = s_[i], s1 = s_[i + 1], t0 = t_[j], t1 = t_[j + 1];
                const Vec3 a = at(s0, t0), b = at(s0, t1), c = at(s1, t0), d = at(s1, t1);
                const Vec3 normal = unit(cross(b + d - a - c, c + d - a - b));
                worst = std::max(worst, std::abs(dot(normal, 0.5 * (a + d) - at((s0 + s1) / 2, (t0 + t1) / 2))));
            }
        return worst;
    }

    Triangles join() const {
        Triangles mesh;
        std::vector<std::vector<std::uint32_t>> rings(s_.size());
        const auto add = [&](const Vec3& p) {
            mesh.vertices.push_back(p);
            return static_cast<std::uint32_t>(mesh.vertices.size() - 1);
        };
        for (std::size_t i = 0; i < s_.size(); ++i) {
            const bool is_point = !loft_.is_ring && ((i == 0 && loft_.first == Loft::End::point) ||
                                                     (i + 1 == s_.size() && loft_.last == Loft::End::point));
            const std::uint32_t point = is_point ? add(at(s_[i], t_.front())) : 0;
            for (const double t : t_) rings[i].push_back(is_point ? point : add(at(s_[i], t)));
        }
        const auto triangle = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
            if (a != b && b != c && c != a) mesh.triangle(a, b, c);
        };
        const std::size_t columns = t_.size(), rows = loft_.is_ring ? s_.size() : s_.size() - 1;
        for (std::size_t i = 0; i < rows; ++i) {
            const auto &one = rings[i], &next = rings[(i + 1) % rings.size()];
            for (std::size_t j = 0, k = 1; j < columns; ++j, k = (k + 1) % columns) {
                triangle(one[j], one[k], next[k]);
                triangle(one[j], next[k], next[j]);
            }
        }
        const auto close = [&](std::vector<std::uint32_t> ring, bool is_first) {
            if (is_first) std::reverse(ring.begin(), ring.end());
            Vec3 middle;
            for (const std::uint32_t v : ring) middle = middle + mesh.vertices[v];
            const std::uint32_t center = add((1 / static_cast<double>(ring.size())) * middle);
            for (std::size_t j = 0; j < ring.size(); ++j) triangle(center, ring[j], ring[(j + 1) % ring.size()]);
        };
        if (!loft_.is_ring && loft_.first == Loft::End::flat) close(rings.front(), true);
        if (!loft_.is_ring && loft_.last == Loft::End::flat) close(rings.back(), false);
        return mesh;
    }

    const Loft& loft_;
    const Matrix& matrix_;
    const FacetOptions& options_;
    std::vector<double> s_, t_;
};

}  // namespace

void refuse_size() { throw Error(Status::out_of_memory, "more triangles than there may be"); }

Triangles mesh_of(const Loft& loft, const Matrix& matrix, const FacetOptions& options) {
    return Lofter(loft, matrix, options).mesh();
}

}  // namespace csgrt::bench
