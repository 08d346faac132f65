// Compiled programs in files, for drivers that keep none: Intel's compiles for seconds in every process.
#pragma once

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include <csgrt/renderer.hpp>

namespace csgrt {

/// One file a program, in one folder, under the hash of all that the program hangs on. Several threads and processes
/// may use a folder at a time. A file that was cut off or damaged counts as none. There is no guard against somebody
/// who may write to the folder.
class BinaryCache {
public:
    static constexpr std::uint64_t usual_bytes = std::uint64_t{256} << 20;

    /// `most_bytes`: of all files together.
    explicit BinaryCache(std::filesystem::path folder, std::uint64_t most_bytes = usual_bytes);

    /// What was kept under this very key, if anything. It counts as used now.
    std::optional<std::string> find(const std::string& key) const;
    /// Keeps `binary` in place of what was kept under that key, and then removes what was longest unused, until all
    /// fits. Where nothing can be written, nothing is kept: that is no error.
    void keep(const std::string& key, std::string_view binary) const;

    std::filesystem::path file_of(const std::string& key) const;

    /// Tests set it: drivers that keep their own get one, too.
    static inline std::atomic<bool> for_every_driver{false};

private:
    void remove_oldest() const;

    std::filesystem::path folder_;
    std::uint64_t most_bytes_;
};

/// $CSGRT_CACHE_DIR, else csgrt in the folder where the system keeps a user's caches ($XDG_CACHE_HOME, else ~/.cache).
/// Empty: nowhere.
std::filesystem::path binary_cache_folder();

/// None if the device's driver keeps what it has compiled, or has nothing to compile.
std::optional<BinaryCache> binary_cache_for(const DeviceInfo& device);

}  // namespace csgrt
