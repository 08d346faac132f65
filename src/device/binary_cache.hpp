// Binary cache: keeps compiled programs in files, for drivers that do not do so. Intel's driver would compile for
// seconds in every process.
#pragma once

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include <csgrt/renderer.hpp>

namespace csgrt {

/// A folder with one file for each program, named by a hash of everything that the program depends on. Several threads
/// and processes may use a folder at a time. A file that was cut off or damaged counts as missing. The cache trusts
/// everybody who may write to the folder.
class BinaryCache {
public:
    static constexpr std::uint64_t usual_bytes = std::uint64_t{256} << 20;

    /// `most_bytes`: the largest total size of the files.
    explicit BinaryCache(std::filesystem::path folder, std::uint64_t most_bytes = usual_bytes);

    /// The binary with this key, if there is one. It becomes the most recently used.
    std::optional<std::string> find(const std::string& key) const;
    /// Writes `binary`, replaces an older one with the same key, and removes the least recently used files until the
    /// total size is allowed. If nothing can be written, the call has no effect and reports no error.
    void keep(const std::string& key, std::string_view binary) const;

    std::filesystem::path file_of(const std::string& key) const;

    /// For tests: true gives a cache also to drivers that keep compiled programs themselves.
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
