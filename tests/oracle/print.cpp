#include "print.hpp"

#include <sstream>
#include <variant>

namespace csgrt::oracle {

static void print(std::ostream& out, const char* name, const Vec3& v) { print(out << ' ' << name << ' ', v); }

std::ostream& print(std::ostream& out, const Vec3& v) { return out << '(' << v.x << ' ' << v.y << ' ' << v.z << ')'; }

namespace {

struct ShapePrinter {
    std::ostream& out;
    void operator()(const Ell& s) const {
        out << "ell";
        print(out, "v", s.v), print(out, "a", s.a), print(out, "b", s.b), print(out, "c", s.c);
    }
    void operator()(const Tgc& s) const {
        out << "tgc";
        print(out, "v", s.v), print(out, "h", s.h), print(out, "a", s.a), print(out, "b", s.b);
        print(out, "c", s.c), print(out, "d", s.d);
    }
    void operator()(const Arb& s) const {
        out << "arb";
        for (const Vec3& v : s.vertices) print(out << ' ', v);
    }
    void operator()(const Arbn& s) const {
        out << "arbn";
        for (const Plane& p : s.planes) print(out << " [", p.normal) << ' ' << p.distance << ']';
    }
    void operator()(const Half& s) const { print(out << "half ", s.plane.normal) << ' ' << s.plane.distance; }
    void operator()(const Tor& s) const {
        out << "tor";
        print(out, "v", s.v), print(out, "h", s.h);
        out << " r_a " << s.r_a << " r_h " << s.r_h;
    }
    void operator()(const Ehy& s) const {
        out << "ehy";
        print(out, "v", s.v), print(out, "h", s.h), print(out, "a", s.a);
        out << " r_1 " << s.r_1 << " r_2 " << s.r_2 << " c " << s.c;
    }
    void curve(const Sketch::Line& c) const { out << "\n    line " << c.start << ' ' << c.end; }
    void curve(const Sketch::Arc& c) const {
        out << "\n    arc " << c.start << ' ' << c.end << " r " << c.radius << (c.center_left ? " left" : " right")
            << (c.clockwise ? " clockwise" : "");
    }
    void curve(const Sketch::Bezier& c) const {
        out << "\n    bezier";
        for (const auto i : c.points) out << ' ' << i;
    }
    void curve(const Sketch::Nurb& c) const {
        out << "\n    nurb order " << c.order << " points";
        for (const auto i : c.points) out << ' ' << i;
        out << " knots";
        for (const double knot : c.knots) out << ' ' << knot;
        if (!c.weights.empty()) out << " weights";
        for (const double weight : c.weights) out << ' ' << weight;
    }
    void operator()(const Sketch& s) const {
        out << "\n    vertices";
        for (const Sketch::Point& p : s.vertices) out << " (" << p.u << ' ' << p.v << ')';
        for (const Sketch::Curve& c : s.curves) std::visit([&](const auto& one) { curve(one); }, c);
    }
    void operator()(const Extrude& s) const {
        out << "extrude";
        print(out, "v", s.v), print(out, "h", s.h), print(out, "a", s.a), print(out, "b", s.b);
        (*this)(s.sketch);
    }
    void operator()(const Revolve& s) const {
        out << "revolve";
        print(out, "v", s.v), print(out, "axis", s.axis), print(out, "r", s.r);
        out << " angle " << s.angle;
        (*this)(s.sketch);
    }
    void operator()(const Ebm& s) const {
        out << "ebm " << s.width << " x " << s.depth << " height " << s.height << " matrix";
        for (const double m : s.matrix) out << ' ' << m;
        out << "\n    cells";
        for (const auto cell : s.cells) out << ' ' << int{cell};
    }
    void operator()(const Part& s) const {
        out << "part";
        print(out, "v", s.v), print(out, "h", s.h);
        out << " r_v " << s.r_v << " r_h " << s.r_h;
    }
    void operator()(const Epa& s) const {
        out << "epa";
        print(out, "v", s.v), print(out, "h", s.h), print(out, "a", s.a);
        out << " r_1 " << s.r_1 << " r_2 " << s.r_2;
    }
    void operator()(const Rpc& s) const {
        out << "rpc";
        print(out, "v", s.v), print(out, "h", s.h), print(out, "b", s.b);
        out << " r " << s.r;
    }
    void operator()(const Rhc& s) const {
        out << "rhc";
        print(out, "v", s.v), print(out, "h", s.h), print(out, "b", s.b);
        out << " r " << s.r << " c " << s.c;
    }
    void operator()(const Eto& s) const {
        out << "eto";
        print(out, "v", s.v), print(out, "n", s.n), print(out, "c", s.c);
        out << " r " << s.r << " r_d " << s.r_d;
    }
    void operator()(const Hyp& s) const {
        out << "hyp";
        print(out, "v", s.v), print(out, "h", s.h), print(out, "a", s.a);
        out << " b " << s.b << " neck " << s.neck;
    }
    void operator()(const Superell& s) const {
        out << "superell";
        print(out, "v", s.v), print(out, "a", s.a), print(out, "b", s.b), print(out, "c", s.c);
        out << " n " << s.n << " e " << s.e;
    }
    void operator()(const Hrt& s) const {
        out << "hrt";
        print(out, "v", s.v), print(out, "x", s.x), print(out, "y", s.y), print(out, "z", s.z);
    }
    void operator()(const Metaball& s) const {
        out << "metaball method " << static_cast<int>(s.method) << " threshold " << s.threshold;
        for (const Metaball::Point& p : s.points)
            print(out << " [", p.position) << ' ' << p.strength << ' ' << p.softness << ']';
    }
    template <class Other>
    void operator()(const Other& s) const {
        out << type_name(s);
    }
};

}  // namespace

std::string describe(const Shape& shape, const Matrix& matrix) {
    std::ostringstream out;
    out.precision(17);
    std::visit(ShapePrinter{out}, shape);
    out << "\n  matrix";
    for (const double m : matrix) out << ' ' << m;
    return out.str();
}

std::string describe(const Ray& ray) {
    std::ostringstream out;
    out.precision(17);
    print(out << "ray from ", ray.origin);
    print(out << " along ", ray.direction);
    return out.str();
}

std::string describe(const Answer& answer) {
    std::ostringstream out;
    out.precision(17);
    out << (answer.tie ? "tie" : "decided") << ", delta " << answer.delta;
    for (const Interval& i : answer.intervals) {
        out << "\n    [" << i.in.t << ", " << i.out.t << "] within " << i.in.tolerance << ", " << i.out.tolerance;
        print(print(out << " normals ", i.in.normal) << ' ', i.out.normal);
    }
    for (const Span& s : answer.inner)
        out << "\n    certainly [" << to_double(s.in.at) << ", " << to_double(s.out.at) << ']';
    for (const Span& s : answer.outer)
        out << "\n    possibly  [" << to_double(s.in.at) << ", " << to_double(s.out.at) << ']';
    return out.str();
}

}  // namespace csgrt::oracle
