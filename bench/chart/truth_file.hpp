// The truth on disk: made once, in pieces of some seconds each, and read by every later run.
//
// A piece is a file of its own, FOLDER/WORKLOAD-RAYS-PIECE.truth, of native byte order:
//
//     "CSGTRUTH"                8 bytes
//     version, piece's rays     2 x 4 bytes
//     key                       8 bytes: hashes of the compiled scenes, the rays, and the truth's method
//     a ray, for each           verdict, first_verdict (1 byte each), stretches (4 bytes), speed (8 bytes);
//                               for each stretch: region (4 bytes); in, out, in_unit, out_unit (8 bytes each)
//     checksum                  8 bytes: Fnv1a of all before
#pragma once

#include <chrono>
#include <optional>
#include <string>

#include "tasks.hpp"
#include "truth.hpp"

namespace csgrt::bench {

/// Changes whenever true_rays() may answer otherwise: older files are made anew.
inline constexpr std::uint32_t truth_version = 3;

using Truth = std::vector<std::vector<TrueRay>>;  ///< by task, one a ray

struct Progress {
    std::size_t done = 0, all = 0;  ///< rays
};

class TruthMaker {
public:
    using Clock = std::chrono::steady_clock;
    /// `folder`: empty: nothing is read or written. It is made if need be. `workload` must outlive it.
    TruthMaker(const ChartWorkload& workload, const std::string& folder, unsigned threads = 0);
    ~TruthMaker();

    /// Reads what is there and makes what is not, until all is done or it is `end`. A file that is damaged, or made of
    /// other scenes, rays or methods, is made anew, and standard error says so. Throws Error (file) if a piece cannot
    /// be written.
    Progress make(Clock::time_point end = Clock::time_point::max());
    /// All of it, after a make() that was not ended.
    Truth take() { return std::move(truth_); }

private:
    struct Piece;
    std::vector<std::vector<TrueRay>> made(const Piece& piece);

    const ChartWorkload& workload_;
    std::string folder_;
    unsigned threads_;
    std::vector<Piece> pieces_;
    Truth truth_;
    std::size_t judged_task_ = SIZE_MAX;
    std::optional<Judge> judge_;  ///< of that task
};

/// The bytes of a piece, and back. Why they are none: in `fault`.
std::string to_bytes(const std::vector<TrueRay>& rays, std::uint64_t key);
std::optional<std::vector<TrueRay>> from_bytes(const std::string& bytes, std::uint64_t key, std::string& fault);

}  // namespace csgrt::bench
