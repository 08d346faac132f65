// Verification: tests whether csgrt computes a model correctly. Rays are shot on the device and on the reference, and
// both answers are compared with the answer of the same geometry in 113-bit arithmetic.
//
//     csgrt::Verifier verifier(scene);
//     verifier.shoot(verifier.sample(scene.camera, 10'000));
//     if (!verifier.result().passed()) ...
//
// A ray is decided if the 113-bit answer is the same sequence of regions for the ray itself, for eight rays that start
//
//     shift = 64 x 2^-53 x (|o| + |o - c| + size)      o: the ray's origin, c: the centre of the model's box,
//                                                      size: the diagonal of this box
//
// away from it, towards the corners of a cube, and for the ray with half and with twice the tolerance. Otherwise the
// ray is a tie: rounding of the ray's own numbers may give either of two answers. If 64 rays around a tie, at the
// distance `shift`, all have the same answer, the tie must have this answer, too; otherwise it counts as decided, and
// wrong. Partitions, and gaps between two partitions of one region, are ignored if they are no longer than the
// tolerance + shift / cos at each of their boundaries (cos: of the angle between the ray and the surface's normal). A
// partition that ends so close to the ray's start is ignored, too, because it is left out if rounding puts its end
// before the start.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include <csgrt/renderer.hpp>

namespace csgrt {

/// Two sequences of regions, without their common beginning and end. The numbers are indices into Model::regions().
struct RegionDifference {
    std::vector<std::uint32_t> exact = {}, found = {};
    bool operator==(const RegionDifference&) const = default;
};

/// A ray and its index.
struct NumberedRay {
    std::uint64_t index = 0;  ///< among all rays that the Verifier shot, from 0
    Ray ray = {};
};

/// A decided ray whose regions are not those of the 113-bit answer.
struct WrongRay : NumberedRay {
    bool on_device = false, on_reference = false;  ///< the answers that are wrong
    RegionDifference difference = {};              ///< on the device, or on the reference if the device is right
};

/// A group of ties with the same difference. The ray is the first of the group.
struct Tie : NumberedRay {
    RegionDifference difference = {};  ///< `found`: the answer of the shifted ray, or with the other tolerance
    std::uint64_t rays = 0;            ///< number of rays in the group
};

/// The error of one boundary of a partition on a decided ray.
struct EndError : NumberedRay {
    double millimetres = 0;    ///< along the ray, from the 113-bit distance rounded to double
    double ulps = 0;           ///< the error in units of 2^-53 x (|o| + |distance| + size) / cos
    double distance = 0;       ///< from the ray's origin to the boundary, millimetres
    std::uint32_t region = 0;  ///< region of the partition: index into Model::regions()
};

/// The result for all rays that a Verifier shot.
struct Verification {
    std::string device = {};  ///< the device's name; empty: only the reference is verified
    std::uint64_t rays = 0;
    std::uint64_t hits = 0;  ///< rays that hit a region
    std::uint64_t decided = 0, ties = 0;
    std::uint64_t wrong = 0;            ///< decided rays with other regions on the device or on the reference
    std::uint64_t bit_differences = 0;  ///< rays whose partitions differ in any bit between device and reference
    std::uint64_t ends = 0;             ///< boundaries of partitions whose errors were measured
    /// Boundaries whose errors were not measured, because they move by more than 4 shift / cos when the ray is shifted:
    /// at edges, and where boundaries closer than the tolerance become one.
    std::uint64_t leaping_ends = 0;
    EndError farthest = {}, worst = {};  ///< the errors with the most millimetres and with the most ulps

    static constexpr std::size_t kept = 100;  ///< the largest size of each list below, which has the first elements
    std::vector<WrongRay> wrong_rays = {};
    std::vector<NumberedRay> different_rays = {};  ///< the rays counted in bit_differences
    std::vector<Tie> tie_kinds = {};               ///< one element for each difference

    /// True if no decided ray is wrong and the device gives the bits of the reference.
    bool passed() const { return wrong == 0 && bit_differences == 0; }
};

/// Verifies a scene on one device. Not copyable. One thread at a time.
class CSGRT_API Verifier {
public:
    /// Makes the Renderers whose answers are compared. With `settings.reference` only the reference is verified. Throws
    /// as Renderer does, and throws Error (usage) for 113 bits, the precision of the comparison.
    explicit Verifier(const Scene& scene, const std::vector<std::string>& objects = {}, const Settings& settings = {});
    ~Verifier();
    Verifier(Verifier&&) noexcept;
    Verifier& operator=(Verifier&&) noexcept;

    /// Makes `count` rays to shoot. About half of them, a square number, are the rays of a view's pixels. The others go
    /// through two random points of the model's box and start outside of it. The same seed gives the same rays. Throws
    /// Error (usage).
    std::vector<Ray> sample(const Camera& camera, std::size_t count, std::uint64_t seed = 1) const;

    /// Shoots these rays and adds them to the result. Settings::progress gets the done fraction of this call. Throws as
    /// Renderer::shoot() does.
    void shoot(const std::vector<Ray>& rays);
    /// The result for all rays so far. Valid as long as the Verifier.
    const Verification& result() const;

    /// The Renderer on the reference, for the names of its regions, its tolerance, its warnings. Valid as long as the
    /// Verifier.
    const Renderer& renderer() const;

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace csgrt
