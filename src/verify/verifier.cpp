#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <random>
#include <span>

#include "base/floating_point.hpp"
#include "verify/answers.hpp"

namespace csgrt {
namespace {

constexpr double roundings = 64, unit_roundoff = 0x1p-53;
constexpr double most_leap = 4;  ///< times shift / cos: boundaries that move farther are not measured; on a grazed
                                 ///< surface a decided boundary may move by 2 shift / cos
constexpr int corners = 8;
constexpr int few_neighbours = 8, all_neighbours = 64;  ///< numbers of rays on a circle around a tie

Vec3 operator+(Vec3 a, Vec3 b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
Vec3 operator-(Vec3 a, Vec3 b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
Vec3 operator*(double s, Vec3 v) { return {s * v.x, s * v.y, s * v.z}; }

/// The model's box. If nothing in the model is bounded: a box of two millimetres around the origin.
Box box_of(const Renderer& renderer) {
    const Box box = renderer.model().bounds();
    return box.low.x <= box.high.x ? box : Box{{-1, -1, -1}, {1, 1, 1}};
}

Settings on_reference(Settings settings) {
    settings.reference = true;
    settings.device.clear();
    return settings;
}

/// Settings of the exact answers, which the others are compared with: 113 bits, `tolerance`, and all defaults
/// otherwise.
Settings exact(const Settings& settings, double tolerance) {
    Settings result = on_reference(settings);
    result.precision = Precision::quad;
    result.laboratory = {};
    result.tolerance_rule = Tolerance::length;
    result.tolerance = tolerance;
    return result;
}

/// The 113-bit answer for one ray, and its changes when the ray is moved.
struct Judged {
    RayPartitions answer;
    bool tie = false, all_as_they_are = true;
    std::vector<std::array<double, 2>> moved;  ///< for each partition's boundaries: the largest change of t
    RegionDifference difference;               ///< for a tie: the change that made it one
};

// The distance of two numbers. 0 if the numbers are equal, also if both are infinite.
double apart(double a, double b) { return a == b ? 0 : std::abs(a - b); }

}  // namespace

/// A unit vector perpendicular to `d`.
Vec3 across(Vec3 d) {
    const double x = std::abs(d.x), y = std::abs(d.y), z = std::abs(d.z);
    const Vec3 n = x <= y && x <= z ? Vec3{0, -d.z, d.y} : y <= z ? Vec3{d.z, 0, -d.x} : Vec3{-d.y, d.x, 0};
    return 1 / length(n) * n;
}

/// Parallel rays on a circle around a ray.
std::vector<Ray> neighbours_of(const Ray& ray, double distance, int count) {
    const Vec3 d = 1 / length(ray.direction) * ray.direction, u = across(d);
    const Vec3 v{d.y * u.z - d.z * u.y, d.z * u.x - d.x * u.z, d.x * u.y - d.y * u.x};
    std::vector<Ray> neighbours;
    for (int i = 0; i < count; ++i) {
        const double angle = (2 * i + 1) * std::acos(-1.0) / count;
        const Vec3 step = distance * std::cos(angle) * u + distance * std::sin(angle) * v;
        neighbours.push_back({ray.origin + step, ray.direction});
    }
    return neighbours;
}

struct Verifier::Impl {
    Settings settings;
    std::function<bool(double)> progress;  ///< of the current call
    double done = 0, part = 0;             ///< fractions of the call: before the current list of rays, and of this list
    std::optional<Renderer> device, reference, judge;
    std::vector<Renderer> other_tolerances;
    Box box;
    double size = 0;
    Verification result;

    bool report(double fraction) const { return !progress || progress(done + part * fraction); }

    std::vector<RayPartitions> shoot(Renderer& renderer, const std::vector<Ray>& rays, double share) {
        part = share;
        std::vector<RayPartitions> answers = renderer.shoot(rays);
        done += share;
        return answers;
    }

    Blur blur_of(const Ray& ray) const {
        const double to_middle = length(ray.origin - 0.5 * (box.low + box.high));
        const double shift = roundings * unit_roundoff * (length(ray.origin) + to_middle + size);
        return {ray.direction, judge->statistics().tolerance, shift, size};
    }

    void compare(Judged& judged, const RayPartitions& other, const NumberedRay& ray);
    void measure(const std::vector<Partition>& found, const Judged& judged, const NumberedRay& ray);
    void add_tie(const NumberedRay& ray, RegionDifference difference);
    void judge_ties(const std::vector<Ray>& rays, std::vector<Judged>& judged, const std::vector<RayPartitions>& found);
};

/// Compares a ray's answer with the answer of the moved ray, or with another tolerance, and notes a tie or the changes.
void Verifier::Impl::compare(Judged& judged, const RayPartitions& other, const NumberedRay& ray) {
    if (judged.tie) return;
    const std::vector<Partition>&a = judged.answer.partitions, &b = other.partitions;
    const Blur blur = blur_of(ray.ray);
    const Pairing paired = pair(a, b, blur);
    if (!paired.same_regions) {
        judged.tie = true;
        judged.difference = difference_of(a, b, blur);
    }
    judged.all_as_they_are = judged.all_as_they_are && paired.as_they_are;
    if (!judged.all_as_they_are) return;
    for (std::size_t i = 0; i < a.size(); ++i) {
        judged.moved[i][0] = std::max(judged.moved[i][0], apart(a[i].in, b[i].in));
        judged.moved[i][1] = std::max(judged.moved[i][1], apart(a[i].out, b[i].out));
    }
}

void Verifier::Impl::add_tie(const NumberedRay& ray, RegionDifference difference) {
    auto kind = std::find_if(result.tie_kinds.begin(), result.tie_kinds.end(),
                             [&](const Tie& tie) { return tie.difference == difference; });
    if (kind == result.tie_kinds.end()) {
        if (result.tie_kinds.size() == Verification::kept) return;
        kind = result.tie_kinds.insert(kind, {{ray}, std::move(difference), 0});
    }
    ++kind->rays;
}

/// Decides ties by rays around them. Where all these neighbours are in the same region, an answer for the tie that
/// differs is wrong. For example, a ray in a face between two parts of one solid is inside the solid. The neighbours
/// have more directions than the corners have, so that a neighbour is inside the solid at any edge that the ray
/// touches.
void Verifier::Impl::judge_ties(const std::vector<Ray>& rays, std::vector<Judged>& judged,
                                const std::vector<RayPartitions>& found) {
    std::vector<std::size_t> suspects;
    for (std::size_t i = 0; i < rays.size(); ++i)
        if (judged[i].tie) suspects.push_back(i);
    for (const int count : {few_neighbours, all_neighbours}) {
        std::vector<Ray> beside;
        for (const std::size_t i : suspects) {
            const std::vector<Ray> all = neighbours_of(rays[i], blur_of(rays[i]).shift, count);
            beside.insert(beside.end(), all.begin(), all.end());
        }
        const std::vector<RayPartitions> answers = shoot(*judge, beside, 0);
        std::vector<std::size_t> remaining;
        for (std::size_t k = 0; k < suspects.size(); ++k) {
            const std::size_t i = suspects[k];
            const std::span neighbours(answers.data() + k * static_cast<std::size_t>(count),
                                       static_cast<std::size_t>(count));
            if (!stands_alone(found[i].partitions, neighbours, blur_of(rays[i]))) continue;
            remaining.push_back(i);
            judged[i].answer = neighbours.front();
        }
        suspects = std::move(remaining);
    }
    for (const std::size_t i : suspects) judged[i].tie = false;
}

/// Measures the errors of the boundaries of a decided ray whose regions are right.
void Verifier::Impl::measure(const std::vector<Partition>& found, const Judged& judged, const NumberedRay& ray) {
    const std::vector<Partition>& exact = judged.answer.partitions;
    const Blur blur = blur_of(ray.ray);
    if (!judged.all_as_they_are || !pair(exact, found, blur).as_they_are) {
        result.leaping_ends += 2 * exact.size();
        return;
    }
    const double speed = length(ray.ray.direction), origin = length(ray.ray.origin);
    const auto measure_end = [&](double t, double off, double moved, Vec3 normal, std::uint32_t region) {
        const double slope = std::max(cosine(ray.ray.direction, normal), std::numeric_limits<double>::min());
        if (!(moved * speed <= most_leap * blur.shift / slope)) {
            ++result.leaping_ends;
            return;
        }
        ++result.ends;
        EndError error{ray};
        error.distance = t * speed;
        error.millimetres = off * speed;
        error.region = region;
        if (off > 0)
            error.ulps = error.millimetres * slope / (unit_roundoff * (origin + std::abs(error.distance) + size));
        if (error.millimetres > result.farthest.millimetres) result.farthest = error;
        if (error.ulps > result.worst.ulps) result.worst = error;
    };
    for (std::size_t i = 0; i < exact.size(); ++i) {
        const Partition &e = exact[i], &f = found[i];
        measure_end(e.in, apart(e.in, f.in), judged.moved[i][0], e.in_normal, e.region);
        measure_end(e.out, apart(e.out, f.out), judged.moved[i][1], e.out_normal, e.region);
    }
}

Verifier::Verifier(const Scene& scene, const std::vector<std::string>& objects, const Settings& settings)
    : impl_(std::make_unique<Impl>()) {
    const FloatingPoint own_state;
    if (settings.precision == Precision::quad)
        throw Error(Status::usage, "113-bit precision is what the others are judged by");
    Impl& impl = *impl_;
    impl.settings = settings;
    Settings own = settings;
    own.wait_for_device = true;  // because the device itself is verified
    own.progress = [&impl](double fraction) { return impl.report(fraction); };
    if (!settings.reference) prepare_devices(own);
    const Model model(scene, objects, own);
    if (!settings.reference) {
        impl.device.emplace(model, own);
        impl.result.device = impl.device->statistics().device;
    }
    impl.reference.emplace(model, on_reference(own));
    const double tolerance = impl.reference->statistics().tolerance;
    impl.judge.emplace(model, exact(own, tolerance));
    if (tolerance > 0)
        for (const double factor : {0.5, 2.0})
            impl.other_tolerances.emplace_back(model, exact(own, factor * tolerance));
    impl.box = box_of(*impl.judge);
    impl.size = length(impl.box.high - impl.box.low);
}

Verifier::~Verifier() = default;
Verifier::Verifier(Verifier&&) noexcept = default;
Verifier& Verifier::operator=(Verifier&&) noexcept = default;

std::vector<Ray> Verifier::sample(const Camera& camera, std::size_t count, std::uint64_t seed) const {
    const FloatingPoint own;
    const int side = static_cast<int>(std::sqrt(static_cast<double>(count / 2)));
    std::vector<Ray> rays;
    if (side > 0) rays = impl_->judge->model().grid_of({.width = side, .height = side, .camera = camera}).rays();
    std::mt19937_64 random(seed);
    const Box& box = impl_->box;
    const auto point = [&] {
        const auto between = [&](double low, double high) {
            return low + (high - low) * (static_cast<double>(random() >> 11) * unit_roundoff);
        };
        const double x = between(box.low.x, box.high.x), y = between(box.low.y, box.high.y);
        return Vec3{x, y, between(box.low.z, box.high.z)};
    };
    while (rays.size() < count) {
        const Vec3 from = point(), way = point() - from;
        const double distance = length(way);
        if (!(distance > 0)) continue;
        const Vec3 direction = 1 / distance * way;
        rays.push_back({from - impl_->size * direction, direction});
    }
    return rays;
}

void Verifier::shoot(const std::vector<Ray>& rays) {
    const FloatingPoint own;
    Impl& impl = *impl_;
    impl.progress = own.of_host(impl.settings.progress);
    const double share = 1.0 / static_cast<double>(1 + corners + impl.other_tolerances.size() + 1);
    impl.done = 0;
    // The rays in 113 bits take nearly all of the time.
    const std::vector<RayPartitions> on_reference = impl.shoot(*impl.reference, rays, share / 2);
    std::vector<RayPartitions> on_device;
    if (impl.device) on_device = impl.shoot(*impl.device, rays, share / 2);
    std::vector<RayPartitions> answers = impl.shoot(*impl.judge, rays, share);

    const std::uint64_t first = impl.result.rays;
    std::vector<Judged> judged(rays.size());
    for (std::size_t i = 0; i < rays.size(); ++i) {
        judged[i].answer = std::move(answers[i]);
        judged[i].moved.resize(judged[i].answer.partitions.size());
    }
    const auto compare = [&](const std::vector<RayPartitions>& others) {
        for (std::size_t i = 0; i < rays.size(); ++i) impl.compare(judged[i], others[i], {first + i, rays[i]});
    };
    std::vector<Ray> moved = rays;
    for (int corner = 0; corner < corners; ++corner) {
        for (std::size_t i = 0; i < rays.size(); ++i) {
            const double step = impl.blur_of(rays[i]).shift / std::sqrt(3.0);
            const auto side = [&](int bit) { return corner >> bit & 1 ? step : -step; };
            moved[i].origin = rays[i].origin + Vec3{side(0), side(1), side(2)};
        }
        compare(impl.shoot(*impl.judge, moved, share));
    }
    for (Renderer& other : impl.other_tolerances) compare(impl.shoot(other, rays, share));

    impl.judge_ties(rays, judged, impl.device ? on_device : on_reference);

    Verification& result = impl.result;
    for (std::size_t i = 0; i < rays.size(); ++i) {
        const NumberedRay ray{first + i, rays[i]};
        ++result.rays;
        result.hits += !judged[i].answer.partitions.empty();
        const bool differs = impl.device && !identical(on_device[i], on_reference[i]);
        if (differs && ++result.bit_differences <= Verification::kept) result.different_rays.push_back(ray);
        if (judged[i].tie) {
            ++result.ties;
            impl.add_tie(ray, std::move(judged[i].difference));
            continue;
        }
        ++result.decided;
        const std::vector<Partition>& exact = judged[i].answer.partitions;
        const std::vector<Partition>* wrong = nullptr;
        WrongRay entry{ray, false, false, {}};
        const auto judge = [&](const std::vector<Partition>& found, bool& fault) {
            fault = !pair(exact, found, impl.blur_of(ray.ray)).same_regions;
            if (!fault) impl.measure(found, judged[i], ray);
            if (fault && !wrong) wrong = &found;
        };
        if (impl.device) judge(on_device[i].partitions, entry.on_device);
        if (!impl.device || differs)
            judge(on_reference[i].partitions, entry.on_reference);
        else
            entry.on_reference = entry.on_device;
        if (!wrong || ++result.wrong > Verification::kept) continue;
        entry.difference = difference_of(exact, *wrong, impl.blur_of(ray.ray));
        result.wrong_rays.push_back(std::move(entry));
    }
}

const Verification& Verifier::result() const { return impl_->result; }
const Renderer& Verifier::renderer() const { return *impl_->reference; }

}  // namespace csgrt
