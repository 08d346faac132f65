// Files of compiled programs: what is kept is found, what is damaged is not, and what is too much goes. No driver is
// needed but by the last tests, which a driver with a compiler serves that keeps its own binaries, too.
#include "catch.hpp"

#include <atomic>
#include <chrono>
#include <fstream>
#include <iterator>
#include <optional>
#include <thread>

#include <sys/stat.h>
#include <unistd.h>

#include <csgrt/csgrt.hpp>

#include "device/binary_cache.hpp"
#include "device/compiling_device.hpp"
#include "device/program.hpp"
#include "folder.hpp"
#include "integration/same_answers.hpp"
#include "integration/scenes.hpp"
#include "sanitized.hpp"

using namespace csgrt;
namespace fs = std::filesystem;

namespace {

/// A fresh folder's name, which is removed in the end.
class Folder {
public:
    Folder() : path_(fs::temp_directory_path() / ("csgrt-binaries-" + std::to_string(getpid()))) {
        fs::remove_all(path_);
    }
    Folder(const Folder&) = delete;
    Folder& operator=(const Folder&) = delete;
    ~Folder() {
        std::error_code ignored;
        fs::remove_all(path_, ignored);
    }
    const fs::path& path() const { return path_; }
    std::vector<fs::path> files() const {
        std::vector<fs::path> all;
        std::error_code none;
        for (const auto& entry : fs::directory_iterator(path_, none)) all.push_back(entry.path());
        return all;
    }

private:
    fs::path path_;
};

void write(const fs::path& file, const std::string& content) { std::ofstream(file, std::ios::binary) << content; }

void make_older(const fs::path& file, int minutes) {
    fs::last_write_time(file, fs::last_write_time(file) - std::chrono::minutes(minutes));
}

// Bytes of every kind, none of which ends anything.
const std::string some_binary = std::string(
                                    "\x7f"
                                    "ELF\0\n\xff code",
                                    11) +
                                std::string(1000, '\0') + "end";

/// A variable of the environment as it was, in the end.
class Variable {
public:
    Variable(const char* name, const char* value) : name_(name) {
        if (const char* old = std::getenv(name)) old_ = old;
        set(value);
    }
    Variable(const Variable&) = delete;
    Variable& operator=(const Variable&) = delete;
    ~Variable() { set(old_ ? old_->c_str() : nullptr); }
    void set(const char* value) const {
        if (value)
            setenv(name_, value, 1);
        else
            unsetenv(name_);
    }

private:
    const char* name_;
    std::optional<std::string> old_;
};

/// The cache is on for the driver that serves, and in this folder.
class ForcedCache {
public:
    explicit ForcedCache(const fs::path& folder) : variable_("CSGRT_CACHE_DIR", folder.c_str()) {
        BinaryCache::for_every_driver = true;
    }
    ForcedCache(const ForcedCache&) = delete;
    ForcedCache& operator=(const ForcedCache&) = delete;
    ~ForcedCache() { BinaryCache::for_every_driver = false; }

private:
    Variable variable_;
};

}  // namespace

TEST_CASE("binaries: what was kept under a key is found under it, and under no other", "[device][promise:devices]") {
    const Folder folder;
    const BinaryCache cache(folder.path() / "made" / "with it");
    CHECK_FALSE(cache.find("key"));
    cache.keep("key", some_binary);
    cache.keep("other key", "another");
    CHECK(cache.find("key") == some_binary);
    CHECK(cache.find("other key") == "another");
    CHECK_FALSE(cache.find("ke"));
    CHECK_FALSE(cache.find("key "));
    cache.keep("key", "new");
    CHECK(cache.find("key") == "new");
    cache.keep("nothing", "");
    CHECK_FALSE(cache.find("nothing"));
}

TEST_CASE("binaries: a file that was cut off, altered or is another key's counts as none", "[device]") {
    const Folder folder;
    const BinaryCache cache(folder.path());
    cache.keep("key", some_binary);
    const fs::path file = cache.file_of("key");
    const std::string whole = test::read_file(file);
    const auto is_refused = [&](const std::string& content) {
        write(file, content);
        if (cache.find("key")) return false;
        cache.keep("key", some_binary);
        return cache.find("key") == some_binary && test::read_file(file) == whole;
    };
    for (std::size_t size = 0; size < whole.size(); size += size < 80 ? 1 : 97) {
        INFO(size << " of " << whole.size() << " bytes");
        CHECK(is_refused(whole.substr(0, size)));
    }
    for (std::size_t at = 0; at < whole.size(); at += at < 80 ? 1 : 89) {
        INFO("byte " << at);
        std::string altered = whole;
        altered[at] = static_cast<char>(altered[at] ^ 0x10);
        CHECK(is_refused(altered));
    }
    CHECK(is_refused(whole + '\0'));
    CHECK(is_refused(whole + whole));

    // As two keys of one hash would have it.
    cache.keep("yek", "another");
    fs::copy_file(cache.file_of("yek"), file, fs::copy_options::overwrite_existing);
    CHECK_FALSE(cache.find("key"));

    fs::remove(file);
    fs::create_directory(file);
    CHECK_FALSE(cache.find("key"));
    cache.keep("key", some_binary);
    CHECK_FALSE(cache.find("key"));
}

TEST_CASE("binaries: where nothing can be written nothing is kept, and that is no error", "[device][promise:devices]") {
    const Folder folder;
    write(folder.path(), "a file, no folder");
    const fs::path file = folder.path();
    for (const fs::path& nowhere : {file, file / "below", fs::path("/dev/null"), fs::path("/proc/none"), fs::path()}) {
        INFO(nowhere);
        const BinaryCache cache(nowhere);
        cache.keep("key", some_binary);
        CHECK_FALSE(cache.find("key"));
    }
    CHECK(test::read_file(folder.path()) == "a file, no folder");
}

TEST_CASE("binaries: what is no regular file is left alone, and waits for nobody", "[device]") {
    const Folder folder;
    const BinaryCache cache(folder.path());
    cache.keep("key", "binary");
    REQUIRE(folder.files().size() == 1);
    const fs::path name = folder.files().front();
    fs::remove(name);
    REQUIRE(mkfifo(name.c_str(), 0600) == 0);
    CHECK(!cache.find("key"));
    cache.keep("key", "binary");
    CHECK(fs::is_fifo(name));
}

TEST_CASE("binaries: the longest unused go when there are too many, and nobody else's files",
          "[device][promise:devices]") {
    const Folder folder;
    const BinaryCache all(folder.path());
    const std::string binary(10'000, 'x');
    all.keep("0", binary);
    const std::uint64_t one = fs::file_size(all.file_of("0"));
    const BinaryCache three(folder.path(), 3 * one);
    write(folder.path() / "mine.bin", std::string(100'000, 'x'));
    three.keep("1", binary);
    three.keep("2", binary);
    for (int i = 0; i < 3; ++i) make_older(all.file_of(std::to_string(i)), 90 - 10 * i);
    CHECK(three.find("0"));  // the oldest, but used
    three.keep("3", binary);
    CHECK(three.find("0"));
    CHECK_FALSE(three.find("1"));
    CHECK(three.find("2"));
    CHECK(three.find("3"));
    CHECK(fs::file_size(folder.path() / "mine.bin") == 100'000);

    // One that is too large alone moves none out.
    three.keep("large", std::string(3 * one, 'x'));
    CHECK_FALSE(three.find("large"));
    CHECK(three.find("3"));
    CHECK(folder.files().size() == 4);
}

TEST_CASE("binaries: what a process did not finish goes after an hour", "[device]") {
    const Folder folder;
    const BinaryCache cache(folder.path());
    cache.keep("key", some_binary);
    const fs::path left = cache.file_of("other").string() + ".123-0.part";
    const fs::path now = cache.file_of("third").string() + ".124-0.part";
    write(left, "half");
    write(now, "half");
    make_older(left, 61);
    make_older(cache.file_of("key"), 10'000);
    cache.keep("fourth", some_binary);
    CHECK_FALSE(fs::exists(left));
    CHECK(fs::exists(now));
    CHECK(cache.find("key"));
}

TEST_CASE("binaries: threads that keep and find at once see whole files alone", "[device]") {
    const Folder folder;
    const BinaryCache cache(folder.path(), 40'000);  // some are removed meanwhile
    std::atomic<int> wrong{0}, found{0};
    std::vector<std::thread> threads;
    for (int t = 0; t < 4; ++t)
        threads.emplace_back([&cache, &wrong, &found, t] {
            for (int i = 0; i < 60; ++i) {
                const std::string key = std::to_string((i + t) % 5);
                const std::string binary = key + std::string(10'000, static_cast<char>('a' + t));
                cache.keep(key, binary);
                const auto kept = cache.find(key);
                if (!kept) continue;
                ++found;
                const bool whole = kept->size() == binary.size() && kept->substr(0, 1) == key &&
                                   kept->find_first_not_of((*kept)[1], 1) == kept->npos;
                if (!whole) ++wrong;
            }
        });
    for (std::thread& thread : threads) thread.join();
    CHECK(wrong == 0);
    CHECK(found > 60);
    cache.keep("last", "x");  // two that keep at once may each count without the other
    std::uint64_t bytes = 0;
    for (const fs::path& file : folder.files()) {
        CHECK(file.extension() != ".part");
        bytes += fs::file_size(file);
    }
    CHECK(bytes <= 40'000);
}

TEST_CASE("binaries: the folder is csgrt's own variable's, else in the user's caches", "[device]") {
    const Variable own("CSGRT_CACHE_DIR", "/some/where"), caches("XDG_CACHE_HOME", "/caches"), home("HOME", "/home/me");
    CHECK(binary_cache_folder() == "/some/where");
    own.set("");
#if !defined(_WIN32) && !defined(__APPLE__)
    CHECK(binary_cache_folder() == "/caches/csgrt");
    caches.set(nullptr);
    CHECK(binary_cache_folder() == "/home/me/.cache/csgrt");
    home.set(nullptr);
    CHECK(binary_cache_folder().empty());
#endif
}

TEST_CASE("binaries: drivers that keep their own, and native devices, have no cache here", "[device]") {
    DeviceInfo info{.platform = "Intel(R) OpenCL"};
    CHECK(binary_cache_for(info));
    for (const char* platform : {"csgrt", "Portable Computing Language", "NVIDIA CUDA"}) {
        info.platform = platform;
        CHECK_FALSE(binary_cache_for(info));
    }
}

TEST_CASE("a program comes from the cache with the same source and options, and from no damaged file",
          "[device][promise:devices]") {
    const Folder folder;
    const ForcedCache forced(folder.path());
    Device device(test::compiling_device());
    const std::string source = "__kernel void fill(__global uint* x) { x[get_global_id(0)] = NUMBER; }";
    const auto result = [&](const char* define, bool from_cache) {
        const Program program(device, source, {define});
        CHECK(program.is_from_cache() == from_cache);
        Buffer x(device, "x", 64 * sizeof(cl_uint));
        program.kernel("fill").launch(64, 64, x);
        return x.read<cl_uint>(1).front();
    };
    CHECK(result("NUMBER=7", false) == 7);
    CHECK(result("NUMBER=7", true) == 7);
    CHECK(result("NUMBER=8", false) == 8);
    CHECK(result("NUMBER=8", true) == 8);
    CHECK(folder.files().size() == 2);

    // Whole files of what is no binary: the driver refuses them, and the right ones take their places.
    for (const fs::path& file : folder.files()) {
        const std::string content = test::read_file(file);
        const std::size_t first = content.find('\n') + 1;
        const std::size_t key_bytes = std::stoull(content.substr(first + 16, 16), nullptr, 16);
        BinaryCache(folder.path()).keep(content.substr(first + 49, key_bytes), "no binary");
    }
    CHECK(folder.files().size() == 2);
    CHECK(result("NUMBER=7", false) == 7);
    CHECK(result("NUMBER=7", true) == 7);

    // Cut off.
    for (const fs::path& file : folder.files()) fs::resize_file(file, fs::file_size(file) - 1);
    CHECK(result("NUMBER=8", false) == 8);
    CHECK(result("NUMBER=8", true) == 8);
}

TEST_CASE("pictures and partitions of programs from the cache have the bits of those that were compiled",
          "[device][promise:devices]") {
    const std::string scenes = test::folder("CSGRT_SCENES");
    if (scenes.empty() || test::sanitized) return;  // the driver compiles most of the time
    const Folder folder;
    const ForcedCache forced(folder.path());
    const Scene scene = load_scene(scenes + "/operators.json");
    Settings settings{.device = test::compiling_device(), .wait_for_device = true};
    View view{.width = 48, .height = 48};
    Image pictures[2];
    std::vector<RayPartitions> shot[2];
    std::vector<std::string> contents[2];
    for (int i = 0; i < 2; ++i) {
        Renderer renderer(scene, {}, settings);
        pictures[i] = renderer.render(view);
        shot[i] = renderer.shoot(test::random_rays(renderer.model().bounds(), 200));
        for (const fs::path& file : folder.files()) contents[i].push_back(test::read_file(file));
    }
    CHECK_FALSE(contents[0].empty());
    CHECK(contents[1] == contents[0]);
    test::require_same(pictures[1], pictures[0]);
    test::require_same(shot[1], shot[0]);
}
