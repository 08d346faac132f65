// Solids: checks each member of each solid by the solid's description.
#include "scene/faults/solids.hpp"

#include <array>
#include <functional>

#include "scene/faults/families.hpp"
#include "scene/solids/shape_forms.hpp"

namespace csgrt {

namespace {

/// Calls `each` with the members of a struct and their values.
template <class S, class Each>
void for_values(const S& s, Each each) {
    form::for_members(form::of<S>, [&](const auto& member) {
        if constexpr (requires { std::invoke(member.at, s); }) each(member, std::invoke(member.at, s));
    });
}

struct Numbers {
    bool finite = true;
    double most = 0;

    void add(double x) {
        finite = finite && std::isfinite(x);
        most = std::max(most, std::abs(x));
    }
    void add(const Vec3& v) {
        finite = finite && is_finite(v);
        most = std::max(most, largest(v));
    }
    void add(const std::array<Vec3, 8>& vertices) {
        for (const Vec3& v : vertices) add(v);
    }
    void add(const auto&) {}  // values without numbers, and lists that check_further checks
};

/// Reports a number that is not finite or is beyond the largest length, at most one for each solid. Other faults of
/// such a solid are not reported.
template <class S>
bool check_numbers(Faults& faults, const S& s) {
    Numbers numbers;
    for_values(s, [&](const auto&, const auto& value) { numbers.add(value); });
    if (!numbers.finite) {
        faults.push_back("it has a number that is not finite");
    } else if (numbers.most > Limits::length) {
        faults.push_back("it has the number " + number_text(numbers.most) + "; " + length_limit());
    }
    for_values(s, [&](const auto& member, const auto& value) {
        if constexpr (requires { member.rule.fewer; }) {
            for (std::size_t i = 0; i < value.size() && faults.empty(); ++i) check_numbers(faults, value[i]);
        }
    });
    return faults.empty();
}

template <class S>
bool check_counts(Faults& faults, const S& s) {
    for_values(s, [&](const auto& member, const auto& value) {
        if constexpr (requires { member.rule.fewer; }) {
            if (member.rule.fewer != nullptr && value.size() < member.kind.least) faults.push_back(member.rule.fewer);
            require_at_most(faults, member.rule.called, value.size(), member.kind.most);
        }
    });
    return faults.empty();
}

/// Checks the rule of each member.
template <class S>
struct CheckRules {
    Faults& faults;
    const S& s;
    std::string where;  ///< tells the part of the solid that `s` is; empty if `s` is the solid

    void all() {
        for_values(s, [&](const auto& member, const auto& value) { check(member.kind, value, member.rule); });
    }

private:
    void check(const auto&...) {}  // members without a rule, or with a rule that check_further checks

    void check(const auto&, double value, const form::Bounds& rule) {
        if (!rule.hold(value)) faults.push_back(rule.called + where + " " + rule.sentence);
    }

    void check(const auto& kind, const Vec3& v, const form::Nonzero& rule) { check_length(kind, v, rule.called); }

    void check(const auto& kind, const Vec3& v, const form::Across<S>& rule) {
        if (check_length(kind, v, rule.called) && std::abs(dot(unit(v), unit(s.*rule.other))) > angle_slack)
            faults.push_back(rule.called + where + " must be perpendicular to " + rule.other_called);
    }

    /// Adds a fault and returns false if the vector has length 0, or if it is a direction and not a unit vector.
    template <class Kind>
    bool check_length(const Kind&, const Vec3& v, const char* called) {
        if (!(length(v) > 0)) {
            faults.push_back(called + where + " has length 0");
        } else if (std::is_same_v<Kind, form::Direction> && !is_unit(v)) {
            faults.push_back(called + where + " is not of length 1");
        } else {
            return true;
        }
        return false;
    }

    void check(const auto&, const Vec3&, const form::Spanning<S>& rule) {
        const Vec3 &a = s.*rule.axes[0], &b = s.*rule.axes[1], &c = s.*rule.axes[2];
        if (plainly_independent(a, b, c)) return;
        const std::size_t before = faults.size();
        for (std::size_t i = 0; i < 3; ++i)
            check_length(form::lengths, s.*rule.axes[i], (std::string("the axis ") + rule.called[i]).c_str());
        if (faults.size() > before || !dependent(a, b, c)) return;
        faults.push_back(std::string("the axes ") + rule.called[0] + ", " + rule.called[1] + " and " + rule.called[2] +
                         " lie in one plane");
    }

    template <class Part>
    void check(const auto&, const std::vector<Part>& parts, const form::Items& rule) {
        for (std::size_t i = 0; i < parts.size(); ++i)
            CheckRules<Part>{faults, parts[i], rule.before + std::to_string(i)}.all();
    }
};

template <class S>
Faults faults_of(const S& s) {
    Faults faults;
    if (!check_counts(faults, s) || !check_numbers(faults, s)) return faults;
    CheckRules<S>{faults, s, {}}.all();
    check_further(faults, s);
    return faults;
}

}  // namespace

std::vector<std::string> solid_faults(const Shape& shape) {
    return std::visit([](const auto& s) { return faults_of(s); }, shape);
}

}  // namespace csgrt
