// Private folder: a new folder for this user alone, which is removed at the end with its contents.
#pragma once

#include <cstdlib>
#include <filesystem>
#include <string>
#include <system_error>

#include <csgrt/error.hpp>

namespace csgrt {

/// A temporary folder, removed with its contents when the object is destroyed.
class PrivateFolder {
public:
    /// Makes a folder in the system's folder for temporary files. Throws Error (file).
    PrivateFolder() {
        std::error_code error;
        path_ = (std::filesystem::temp_directory_path(error) / "csgrt-XXXXXX").string();
        if (error || !mkdtemp(path_.data()))
            throw Error(Status::file, "cannot make a folder for temporary files (TMPDIR): " + path_);
    }
    ~PrivateFolder() {
        std::error_code ignored;
        std::filesystem::remove_all(path_, ignored);
    }
    PrivateFolder(const PrivateFolder&) = delete;
    PrivateFolder& operator=(const PrivateFolder&) = delete;

    std::string operator/(const std::string& name) const { return path_ + "/" + name; }

private:
    std::string path_;
};

}  // namespace csgrt
