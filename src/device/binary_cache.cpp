#include "device/binary_cache.hpp"

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <fstream>
#include <utility>
#include <vector>

#include "device/discovery.hpp"
#include "base/fnv1a.hpp"
#include "base/new_file.hpp"

namespace csgrt {

namespace {

namespace fs = std::filesystem;

// The suffix of the cache's files: the folder may hold the user's own files, too.
constexpr const char* suffix = ".csgrt-binary";

/// The head before a binary. Its first line is the format's version. A file of another version is replaced.
std::string head_of(const std::string& key, std::string_view binary) {
    Fnv1a sum;
    sum.add_text(key);
    sum.add_text(binary);
    return "csgrt binary 1\n" + hexadecimal(sum.state()) + hexadecimal(key.size()) + hexadecimal(binary.size()) + '\n' +
           key;
}

/// The contents of a file. Empty if there is no file, or if it has more than `most_bytes`. If reading fails, the part
/// that was read.
std::string content_of(const fs::path& file, std::uint64_t most_bytes) {
    std::error_code error;
    const std::uintmax_t size = fs::file_size(file, error);
    if (error || size > most_bytes) return {};
    std::string content(size, '\0');
    std::ifstream in(file, std::ios::binary);
    in.read(content.data(), static_cast<std::streamsize>(size));
    content.resize(static_cast<std::size_t>(std::max<std::streamsize>(in.gcount(), 0)));
    return content;
}

struct Kept {
    fs::file_time_type used;
    std::uint64_t bytes;
    fs::path file;
};

/// The cache's own files in a folder, the least recently used first.
std::vector<Kept> files_in(const fs::path& folder) {
    std::vector<Kept> all;
    std::error_code error;
    for (fs::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error)) {
        if (entry->path().filename().string().find(suffix) == std::string::npos) continue;
        std::error_code gone;  // set if another process has removed the file
        const auto used = entry->last_write_time(gone);
        const std::uint64_t bytes = gone ? 0 : entry->file_size(gone);
        if (!gone) all.push_back({used, bytes, entry->path()});
    }
    std::sort(all.begin(), all.end(), [](const Kept& a, const Kept& b) { return a.used < b.used; });
    return all;
}

fs::path folder_of(const char* variable) {
    const char* value = std::getenv(variable);
    return value ? value : "";
}

}  // namespace

BinaryCache::BinaryCache(fs::path folder, std::uint64_t most_bytes)
    : folder_(std::move(folder)), most_bytes_(most_bytes) {}

fs::path BinaryCache::file_of(const std::string& key) const {
    Fnv1a name;
    name.add_text(key);
    return folder_ / (hexadecimal(name.state()) + suffix);
}

std::optional<std::string> BinaryCache::find(const std::string& key) const {
    if (folder_.empty()) return {};
    const fs::path file = file_of(key);
    std::string content = content_of(file, most_bytes_);
    const std::size_t head = head_of(key, {}).size();
    if (content.size() <= head) return {};
    const std::string_view binary = std::string_view(content).substr(head);
    if (!content.starts_with(head_of(key, binary))) return {};
    content.erase(0, head);
    std::error_code ignored;  // the file's time cannot be set if it is read-only
    fs::last_write_time(file, fs::file_time_type::clock::now(), ignored);
    return content;
}

void BinaryCache::keep(const std::string& key, std::string_view binary) const {
    const std::string head = head_of(key, binary);
    if (folder_.empty() || binary.empty() || head.size() + binary.size() > most_bytes_) return;
    std::error_code error;
    fs::create_directories(folder_, error);
    if (error) return;
    const fs::path name = file_of(key);
    if (fs::exists(name, error) && !fs::is_regular_file(name, error)) return;  // opening a pipe would wait for a reader
    try {
        NewFile file(name.string());
        file.write(head);
        file.write(binary);
        file.keep();
    } catch (const Error&) {
        return;
    }
    remove_oldest();
}

void BinaryCache::remove_oldest() const {
    const std::vector<Kept> all = files_in(folder_);
    std::uint64_t bytes = 0;
    for (const Kept& kept : all) bytes += kept.bytes;
    // An unfinished file older than an hour was left by a process that ended badly.
    const auto old = fs::file_time_type::clock::now() - std::chrono::hours(1);
    for (const Kept& kept : all) {
        const bool unfinished = !kept.file.string().ends_with(suffix);
        if (unfinished ? kept.used > old : bytes <= most_bytes_) continue;
        std::error_code ignored;
        fs::remove(kept.file, ignored);
        bytes -= kept.bytes;
    }
}

fs::path binary_cache_folder() {
    if (fs::path folder = folder_of("CSGRT_CACHE_DIR"); !folder.empty()) return folder;
#ifdef _WIN32
    const fs::path caches = folder_of("LOCALAPPDATA");
#else
    const fs::path home = folder_of("HOME");
#ifdef __APPLE__
    const fs::path caches = home.empty() ? home : home / "Library" / "Caches";
#else
    fs::path caches = folder_of("XDG_CACHE_HOME");
    if (caches.empty() && !home.empty()) caches = home / ".cache";
#endif
#endif
    return caches.empty() ? caches : caches / "csgrt";
}

std::optional<BinaryCache> binary_cache_for(const DeviceInfo& device) {
    const bool keeps_its_own = is_native(device) || is_pocl(device) || device.platform == "NVIDIA CUDA";
    if (keeps_its_own && !BinaryCache::for_every_driver) return {};
    return BinaryCache(binary_cache_folder());
}

}  // namespace csgrt
