// New file: a file that is written whole or not at all. The header holds all of the code, because the library, the
// component for pictures and the command share it, and each sees only the interface of the others.
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
#else
#include <sys/file.h>
#include <sys/stat.h>
#endif

#include <csgrt/error.hpp>

namespace csgrt {

/// Flags of open files: child processes do not inherit the files, and Windows does not change line ends.
#ifdef _WIN32
inline constexpr int open_flags = _O_NOINHERIT | _O_BINARY;
inline int duplicate(int file) { return _dup(file); }
#else
inline constexpr int open_flags = O_CLOEXEC;
inline int duplicate(int file) { return fcntl(file, F_DUPFD_CLOEXEC, 3); }
#endif

/// The file that a name leads to over links. This file is written, so that a link stays a link.
struct Target {
    std::filesystem::path path;
    /// Whether the target is a device, a pipe or an open file (/dev/stdout, /dev/fd/3): nothing can be renamed onto
    /// these.
    bool direct = false;
    int descriptor = -1;   ///< the target's, if it is a file that this process has open
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

/// Writes a temporary file beside its target. keep() renames it to the target; without keep(), the destructor removes
/// it. So readers find the whole old file or the whole new one. A target that nothing can be renamed onto is written
/// directly. The temporary file is locked while it is written: a later writer of the same target removes unlocked ones,
/// which killed processes left. Throws Error (file).
class NewFile {
public:
    /// Creates the file. `on_signal` is called when a signal ends a wait, and may throw; if it does not, the wait goes
    /// on.
    explicit NewFile(const std::string& name, void (*on_signal)() = nullptr) : NewFile(on_signal, name) {
        if (name.find('\0') != name.npos) refuse(name.c_str(), "cannot create", "the name of a file has no NUL");
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
        int number = 0;
        for (; file_ < 0; ++number) {
            std::string temporary = beside(target.path, number);
            remove_if_left(temporary);
            file_ = open(temporary.c_str(), O_CREAT | O_EXCL | O_WRONLY | open_flags, 0666);
            if (file_ < 0 && errno != EEXIST) fail("cannot create", errno);
            if (file_ < 0) continue;
            if (!lock())
                close(std::exchange(file_, -1));  // another process removed it as a killed process's file
            else
                temporary_ = std::move(temporary);
        }
        constexpr int most = 8;  // at most so many processes write one target at a time
        for (; number < most; ++number) remove_if_left(beside(target.path, number));
        // The new file gets the old file's permissions, as if an editor had written it.
        if (replaces) fs::permissions(temporary_, old.permissions() & fs::perms::all, error);
    }
    NewFile(const NewFile&) = delete;
    NewFile& operator=(const NewFile&) = delete;
    ~NewFile() {
        if (file_ >= 0) close(file_);
        if (!temporary_.empty()) unlink(temporary_.c_str());
        if (lock_ >= 0) close(lock_);
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

    /// Writes all bytes to an open file with the name `name`.
    static void write_to(int file, std::string_view bytes, const std::string& name, void (*on_signal)() = nullptr) {
        constexpr std::size_t most = std::size_t{1} << 30;  // bytes of one call, which Windows counts in an int
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
    /// The other constructor delegates to this one, so that the destructor tidies up if the other one throws.
    NewFile(void (*on_signal)(), const std::string& name) : name_(name), on_signal_(on_signal) {}

    static std::string words(int code) { return code == EBADF ? "it is closed" : std::strerror(code); }
    [[noreturn]] static void refuse(const std::string& name, const char* what, const std::string& why) {
        throw Error(Status::file, name + ": " + what + ": " + why);
    }
    [[noreturn]] void fail(const char* what, int code) const { refuse(name_, what, words(code)); }

    /// A name for the temporary file, cut to the length that folders allow. `number` tells apart processes that write
    /// the same target at once.
    static std::string beside(const std::filesystem::path& target, int number) {
        constexpr std::size_t longest = 200;
        const std::string name = target.filename().string().substr(0, longest) + "." + std::to_string(number) + ".part";
        return (target.parent_path() / name).string();
    }

#ifdef _WIN32
    bool lock() { return true; }
    static void remove_if_left(const std::string&) {}
#else
    /// Locks the file. False if the file was removed meanwhile. On file systems without locks, files of killed
    /// processes stay.
    bool lock() {
        struct stat status;
        if (flock(file_, LOCK_EX | LOCK_NB) != 0) return errno != EWOULDBLOCK;
        if (fstat(file_, &status) != 0 || status.st_nlink == 0) return false;
        lock_ = duplicate(file_);  // holds the lock until the file has its name
        return true;
    }

    /// Removes a temporary file if no process writes it.
    static void remove_if_left(const std::string& temporary) {
        const int file = open(temporary.c_str(), O_WRONLY | O_NONBLOCK | O_NOFOLLOW | open_flags);
        if (file < 0) return;
        struct stat opened, named;
        const bool is_left = flock(file, LOCK_EX | LOCK_NB) == 0 && fstat(file, &opened) == 0 &&
                             S_ISREG(opened.st_mode) && lstat(temporary.c_str(), &named) == 0 &&
                             opened.st_ino == named.st_ino && opened.st_dev == named.st_dev;  // still has the name
        if (is_left) unlink(temporary.c_str());
        close(file);
    }
#endif

    std::string name_, target_, temporary_;  ///< temporary_ is empty if the target is written directly
    void (*on_signal_)();
    int file_ = -1, lock_ = -1;
};

}  // namespace csgrt
