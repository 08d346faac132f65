// What a campaign found: sums by family, and every wrong ray in a file of its own.
#pragma once

#include <cstdint>
#include <cstdio>
#include <map>
#include <mutex>
#include <string>
#include <vector>

#include "subjects.hpp"

namespace csgrt::campaign {

struct Sums {
    std::uint64_t items = 0;
    std::uint64_t planned = 0;  ///< rays
    std::uint64_t rays = 0, decided = 0, ties = 0, hits = 0;
    std::uint64_t wrong = 0;  ///< decided rays, and ties on which even what is certain is not as it must be
    std::uint64_t compared = 0, bit_differences = 0;  ///< rays also shot on the reference; of these, those that differ
    double worst = 0;                                 ///< as Verdict's
    double build = 0, shoot = 0, judge = 0;           ///< seconds of one thread
    void operator+=(const Sums& other);
};

/// May be used by many threads.
class Tally {
public:
    /// Throws Error (file) if the file of wrong rays cannot be written.
    explicit Tally(const std::string& wrong_rays);
    ~Tally();
    Tally(const Tally&) = delete;
    Tally& operator=(const Tally&) = delete;

    void add(const Item& item, const Sums& sums);
    void add_wrong(const Item& item, const Ray& ray, const std::string& what);
    void add_error(const Item& item, const std::string& what);

    Sums total() const;
    /// Some rays were decided, and none is wrong.
    bool passed() const;
    std::string table() const;
    /// With what is true of all of them.
    std::string to_json(const std::string& device, unsigned threads, double seconds) const;

private:
    mutable std::mutex mutex_;
    std::map<std::string, Sums> families_, files_;  ///< the latter: of models and scenes, one by one
    std::vector<std::string> errors_;
    std::FILE* wrong_rays_ = nullptr;
};

}  // namespace csgrt::campaign
