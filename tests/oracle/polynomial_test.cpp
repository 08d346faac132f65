// Are the oracle's roots right? Against polynomials that are made from their roots.
#include "catch.hpp"

#include "oracle/polynomial.hpp"
#include "oracle/random.hpp"
#include "oracle/spans.hpp"

using namespace csgrt::oracle;

namespace {

Polynomial from_roots(const std::vector<quad>& roots) {
    Polynomial p(1);
    for (const quad r : roots) p = p * Polynomial::linear(-r, 1);
    return p;
}

}  // namespace

TEST_CASE("square roots are right to the last bits", "[oracle]") {
    Random random(1);
    for (int i = 0; i < 1000; ++i) {
        const quad x = random.power(-200, 200);
        const quad r = root(x);
        CHECK(absolute(r * r - x) <= x * quad(1e-33));
    }
    CHECK(root(0) == 0);
    CHECK(root(4) == 2);
}

TEST_CASE("an affine map and its inverse cancel", "[oracle]") {
    Random random(2);
    for (int i = 0; i < 100; ++i) {
        const QAffine m{random.in_cube(), random.in_cube(), random.in_cube(), quad(1e6) * random.in_cube()};
        if (absolute(m.determinant()) < quad(1e-3)) continue;
        const QVec p = random.in_cube();
        CHECK(length(m.inverse().point(m.point(p)) - p) < quad(1e-24));
        CHECK(length((m * m.inverse()).direction(p) - p) < quad(1e-28));
    }
}

TEST_CASE("roots: every root of the interval, and no other", "[oracle]") {
    const Polynomial p = from_roots({-3, -1, 2, 5});
    const Roots all = roots(p, -10, 10);
    REQUIRE(all.count == 4);
    CHECK(absolute(all.values[0] + 3) < quad(1e-31));
    CHECK(absolute(all.values[1] + 1) < quad(1e-31));
    CHECK(absolute(all.values[2] - 2) < quad(1e-31));
    CHECK(absolute(all.values[3] - 5) < quad(1e-31));
    CHECK(roots(p, -2, 3).count == 2);
    CHECK(roots(p, 6, 7).count == 0);
    CHECK(roots(p * Polynomial(-1), -10, 10).count == 4);
    CHECK(roots(from_roots({1, 2, 3}), 0, 4).count == 3);
    CHECK(roots(Polynomial(3), 0, 4).count == 0);
    CHECK(roots(Polynomial::linear(0, 0), 0, 4).count == 0);
}

TEST_CASE("roots: a leading coefficient of 0 only lowers the degree", "[oracle]") {
    Polynomial p = from_roots({-1, 2});
    p.degree = 4;
    const Roots both = roots(p, -10, 10);
    REQUIRE(both.count == 2);
    CHECK(absolute(both.values[1] - 2) < quad(1e-31));
}

TEST_CASE("roots: close pairs are told apart, and a missed zero stays missed", "[oracle]") {
    for (const double gap : {1e-3, 1e-6, 1e-9, 1e-12, 1e-14}) {
        const Polynomial p = from_roots({1, 1 + quad(gap), -2, quad(1) / 3});
        const Roots found = roots(p, -4, 4);
        REQUIRE(found.count == 4);
        CHECK(absolute(found.values[2] - 1) < quad(1e-31) / quad(gap));
        CHECK(absolute(found.values[3] - 1 - quad(gap)) < quad(1e-31) / quad(gap));
        const Polynomial above = from_roots({1, 1}) + Polynomial(quad(gap) * quad(gap));
        CHECK(roots(above, -4, 4).count == 0);
    }
}

TEST_CASE("roots: random quartics", "[oracle]") {
    Random random(3);
    for (int i = 0; i < 2000; ++i) {
        std::vector<quad> made;
        for (int k = 0; k < 4; ++k) made.push_back(random.between(-1, 1));
        std::sort(made.begin(), made.end());
        const Roots found = roots(from_roots(made), -2, 2);
        REQUIRE(found.count == 4);
        for (std::size_t k = 0; k < 4; ++k) REQUIRE(absolute(found.values[k] - made[k]) < quad(1e-22));
    }
}

TEST_CASE("spans: intersection, complement, union, difference", "[oracle]") {
    const auto span = [](double in, double out) { return Span{{in, 0}, {out, 0}}; };
    const auto same = [](const Spans& a, const Spans& b) {
        if (a.size() != b.size()) return false;
        for (std::size_t i = 0; i < a.size(); ++i)
            if (a[i].in.at != b[i].in.at || a[i].out.at != b[i].out.at) return false;
        return true;
    };
    const Spans a{span(0, 2), span(3, 5)}, b{span(1, 4)};
    CHECK(same(intersect(a, b), {span(1, 2), span(3, 4)}));
    CHECK(same(unite(a, b), {span(0, 5)}));
    CHECK(same(subtract(a, b), {span(0, 1), span(4, 5)}));
    CHECK(same(complement(complement(a)), a));
    CHECK(same(intersect(a, everything()), a));
    CHECK(complement(everything()).empty());
    CHECK(intersect({span(0, 1)}, {span(1, 2)}).empty());
    CHECK(nested_one_to_one({span(1, 2)}, {span(0, 3)}, {span(-1, 4)}));
    CHECK_FALSE(nested_one_to_one({}, {span(0, 3)}, {span(-1, 4)}));
    CHECK_FALSE(nested_one_to_one({span(-1, 2)}, {span(0, 3)}, {span(-1, 4)}));
}
