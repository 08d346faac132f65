// Binary cache: compiled programs in files, for drivers that keep none. Intel's driver compiles for seconds in every
// process.
#pragma once

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include <csgrt/renderer.hpp>

namespace csgrt {

/// Keeps one file a program, in one folder, under the hash of everything that the program depends on. Several threads
/// and processes may use a folder at a time. A file that was cut off or damaged counts as missing. There is no guard
/// against somebody who may write to the folder.
class BinaryCache {
public:
    static constexpr std::uint64_t usual_bytes = std::uint64_t{256} << 20;

    /// `most_bytes`: of all files together.
    explicit BinaryCache(std::filesystem::path folder, std::uint64_t most_bytes = usual_bytes);

    /// The binary under this very key, if there is one. It counts as used now.
    std::optional<std::string> find(const std::string& key) const;
    /// Keeps `binary` in place of the one under the same key, and then removes the least recently used files until all
    /// fit. If nothing can be written, nothing is kept, without an error.
    void keep(const std::string& key, std::string_view binary) const;

    std::filesystem::path file_of(const std::string& key) const;

    /// For tests: drivers that keep their own binaries get a cache, too.
    static inline std::atomic<bool> for_every_driver{false};

private:
    void remove_oldest() const;

    std::filesystem::path folder_;
    std::uint64_t most_bytes_;
};

/// The cache's folder: $CSGRT_CACHE_DIR, else csgrt in the system's folder for a user's caches ($XDG_CACHE_HOME, else
/// ~/.cache). Empty: there is none.
std::filesystem::path binary_cache_folder();

/// The cache for a device. None if its driver keeps compiled programs itself, or has nothing to compile.
std::optional<BinaryCache> binary_cache_for(const DeviceInfo& device);

}  // namespace csgrt
