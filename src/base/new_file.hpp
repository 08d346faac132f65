// A file that is written whole or not at all, wherever its name leads. All in the header: the library, the component
// for pictures and the command share it, and show each other nothing behind their interfaces.
#pragma once

#include <algorithm>
#include <cerrno>
#include <cstddef>
#include <cstring>
#include <filesystem>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>

#include <fcntl.h>
#include <unistd.h>  // Windows: with mingw-w64
#ifdef _WIN32
#include <io.h>
#endif

#include <csgrt/error.hpp>

namespace csgrt {

/// How open files are opened: not for processes that this one starts, and, under Windows, without changing line ends.
#ifdef _WIN32
inline constexpr int open_flags = _O_NOINHERIT | _O_BINARY;
inline int duplicate(int file) { return _dup(file); }
#else
inline constexpr int open_flags = O_CLOEXEC;
inline int duplicate(int file) { return fcntl(file, F_DUPFD_CLOEXEC, 3); }
#endif

/// Where a name leads over links: the file that is written, so that a link stays a link.
struct Target {
    std::filesystem::path path;
    /// A device, a pipe or an open file (/dev/stdout, /dev/fd/3): nothing can be renamed onto it.
    bool direct = false;
    int descriptor = -1;   ///< the open file, if it is one of this process
    bool endless = false;  ///< the links lead in a circle
};

inline Target target_of(const std::string& name) {
    namespace fs = std::filesystem;
    constexpr int most_links = 40;  // as many as Linux follows
    Target target{name};
    std::error_code error;
    for (int links = 0;; ++links) {
        const fs::path folder = fs::canonical(target.path.has_parent_path() ? target.path.parent_path() : ".", error);
        if (!error && folder.filename() == "fd" && folder.string().starts_with("/proc/")) {
            target.direct = true;
            const std::string number = target.path.filename().string();
            const bool own = folder == fs::canonical("/proc/self/fd", error);
            if (own && !number.empty() && number.size() < 8 && number.find_first_not_of("0123456789") == number.npos)
                target.descriptor = std::stoi(number);
            return target;
        }
        if (!fs::is_symlink(fs::symlink_status(target.path, error))) break;
        target.endless = links == most_links;
        if (target.endless) return target;
        const fs::path to = fs::read_symlink(target.path, error);
        if (error) break;
        target.path = to.is_absolute() ? to : target.path.parent_path() / to;
    }
    const fs::file_type type = fs::status(target.path, error).type();
    target.direct = type != fs::file_type::none && type != fs::file_type::not_found && type != fs::file_type::regular &&
                    type != fs::file_type::directory;
    return target;
}

/// Stands beside its place under another name until keep(), and is removed if that never comes: whoever looks finds the
/// old file or the new one, whole. What nothing can be renamed onto is written directly. Throws Error (file).
class NewFile {
public:
    /// `on_signal` is called where a signal ends a wait, and may throw; then the wait goes on.
    explicit NewFile(const std::string& name, void (*on_signal)() = nullptr) : name_(name), on_signal_(on_signal) {
        Target target = target_of(name);
        target_ = target.path.string();
        if (target.endless) fail("cannot create", ELOOP);
        if (target.direct) {
            const bool own = target.descriptor >= 0;
            file_ = own ? duplicate(target.descriptor) : open(target_.c_str(), O_WRONLY | open_flags);
            if (file_ < 0) fail("cannot open", errno);
            return;
        }
        namespace fs = std::filesystem;
        std::error_code error;
        const fs::file_status old = fs::status(target.path, error);
        const bool replaces = fs::exists(old);
        if (fs::is_directory(old)) fail("cannot replace", EISDIR);
        if (replaces && access(target_.c_str(), W_OK) != 0) fail("cannot replace", errno);
        for (int attempt = 0; file_ < 0; ++attempt) {
            temporary_ = beside(target.path, attempt);
            file_ = open(temporary_.c_str(), O_CREAT | O_EXCL | O_WRONLY | open_flags, 0666);
            if (file_ >= 0 || errno == EEXIST) continue;
            temporary_.clear();
            fail("cannot create", errno);
        }
        // As an editor would leave it.
        if (replaces) fs::permissions(temporary_, old.permissions() & fs::perms::all, error);
    }
    NewFile(const NewFile&) = delete;
    NewFile& operator=(const NewFile&) = delete;
    ~NewFile() {
        if (file_ >= 0) close(file_);
        if (!temporary_.empty()) unlink(temporary_.c_str());
    }

    void write(std::string_view bytes) { write_to(file_, bytes, name_, on_signal_); }

    void keep() {
        if (close(std::exchange(file_, -1)) != 0) fail("cannot write", errno);
        if (temporary_.empty()) return;
        std::error_code error;
        std::filesystem::rename(temporary_, target_, error);  // std::rename replaces nothing under Windows
        if (error) refuse(name_, "cannot replace", error.message());
        temporary_.clear();
    }

    /// All of it to an open file that is called `name`.
    static void write_to(int file, std::string_view bytes, const std::string& name, void (*on_signal)() = nullptr) {
        constexpr std::size_t most = std::size_t{1} << 30;  // at once: Windows counts bytes in an int
        while (!bytes.empty()) {
            const auto written = ::write(file, bytes.data(), static_cast<unsigned>(std::min(bytes.size(), most)));
            if (written >= 0) {
                bytes.remove_prefix(static_cast<std::size_t>(written));
            } else if (errno != EINTR) {
                refuse(name, "cannot write", words(errno));
            } else if (on_signal != nullptr) {
                on_signal();
            }
        }
    }

private:
    static std::string words(int code) { return code == EBADF ? "it is closed" : std::strerror(code); }
    [[noreturn]] static void refuse(const std::string& name, const char* what, const std::string& why) {
        throw Error(Status::file, name + ": " + what + ": " + why);
    }
    [[noreturn]] void fail(const char* what, int code) const { refuse(name_, what, words(code)); }

    /// Another name where a process that ended badly, and had our number, left its own; no longer than a folder bears.
    static std::string beside(const std::filesystem::path& target, int attempt) {
        constexpr std::size_t longest = 200;
        std::string name = target.filename().string().substr(0, longest);
        name += "." + std::to_string(getpid()) + "-" + std::to_string(attempt) + ".part";
        return (target.parent_path() / name).string();
    }

    std::string name_, target_, temporary_;  ///< no temporary: written directly
    void (*on_signal_)();
    int file_ = -1;
};

}  // namespace csgrt
