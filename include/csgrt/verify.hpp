// Is a model computed right? Rays are shot on the device and on the reference, and judged by the same geometry in
// 113-bit arithmetic.
//
//     csgrt::Verifier verifier(scene);
//     verifier.shoot(verifier.sample(scene.camera, 10'000));
//     if (!verifier.result().passed()) ...
//
// A ray is decided if the 113-bit answer has one and the same sequence of regions for the ray, for eight rays moved by
//
//     shift = 64 x 2^-53 x (|o| + |o - c| + size)      o: the ray's origin, c: the middle of the model's box,
//                                                      size: the box's diagonal
//
// towards the corners of a cube, and for the ray with the tolerance halved and doubled. Else it is a tie: rounding the
// ray's own numbers may decide it either way. What is no longer than the tolerance + shift / cos at each of its ends
// (cos: between ray and surface's normal) does not count: neither such partitions, nor such gaps between two of one
// region.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include <csgrt/renderer.hpp>

namespace csgrt {

/// Where two sequences of regions differ: without what they share before that and behind it. Indices into regions().
struct RegionDifference {
    std::vector<std::uint32_t> exact, found;
    bool operator==(const RegionDifference&) const = default;
};

struct NumberedRay {
    std::uint64_t index = 0;  ///< among all rays shot, from 0
    Ray ray;
};

/// A decided ray that meets other regions than those of the 113-bit answer.
struct WrongRay : NumberedRay {
    bool on_device = false, on_reference = false;
    RegionDifference difference;  ///< the device's, or the reference's if the device is right
};

/// Rays that are ties in the same way.
struct Tie : NumberedRay {        ///< the first of them
    RegionDifference difference;  ///< `found`: what the moved ray, or the other tolerance, gives
    std::uint64_t rays = 0;
};

/// By how much an end of a partition is off. Of decided rays only.
struct EndError : NumberedRay {
    double millimetres = 0;  ///< along the ray, from the 113-bit distance rounded to double
    double ulps = 0;         ///< the same in units of 2^-53 x (|o| + |distance| + size) / cos
    double distance = 0;     ///< from the ray's origin, in millimetres
    std::uint32_t region = 0;
};

struct Verification {
    std::string device;  ///< its name; empty: the reference alone
    std::uint64_t rays = 0;
    std::uint64_t hits = 0;  ///< rays that meet a region
    std::uint64_t decided = 0, ties = 0;
    std::uint64_t wrong = 0;            ///< of the decided: other regions on the device or on the reference
    std::uint64_t bit_differences = 0;  ///< rays on which device and reference differ in any bit of their partitions
    std::uint64_t ends = 0;             ///< ends of partitions whose distances were measured
    /// Ends that were not: they leap by more than 4 shift / cos when the ray moves, where ends closer than the
    /// tolerance become one, or at an edge.
    std::uint64_t leaping_ends = 0;
    EndError farthest, worst;  ///< most millimetres, most ulps

    static constexpr std::size_t kept = 100;  ///< of each list below, the first ones
    std::vector<WrongRay> wrong_rays;
    std::vector<NumberedRay> different_rays;  ///< in any bit
    std::vector<Tie> tie_kinds;

    /// No decided ray is wrong, and the device gives the reference's bits.
    bool passed() const { return wrong == 0 && bit_differences == 0; }
};

/// Judges a scene on one device. Not copyable; one thread at a time.
class CSGRT_API Verifier {
public:
    /// As Renderer's. With `settings.reference` the reference alone is judged. Throws what Renderer throws; Error
    /// (usage) for contraction, which changes bits by intent, and for 113 bits, which would judge themselves.
    explicit Verifier(const Scene& scene, const std::vector<std::string>& objects = {}, const Settings& settings = {});
    ~Verifier();
    Verifier(Verifier&&) noexcept;
    Verifier& operator=(Verifier&&) noexcept;

    /// `count` rays: half of them (as near as a square grid comes) the pixels of a view, the rest through two random
    /// points of the model's box, from outside of it. The same seed gives the same rays.
    std::vector<Ray> sample(const Camera& camera, std::size_t count, std::uint64_t seed = 1) const;

    /// Adds these rays to the result. The settings' progress is told the done fraction of this call.
    void shoot(const std::vector<Ray>& rays);
    const Verification& result() const;

    /// What is judged: for the names of its regions, its tolerance, its notes.
    const Renderer& renderer() const;

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace csgrt
