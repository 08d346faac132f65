// Parts of solids that other objects or files hold: the sketch of an extrude or revolve, the cells of an ebm, vol or
// dsp.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include <csgrt/scene.hpp>

#include "formats/brlcad/objects.hpp"

namespace csgrt {

/// Completes the solids of one model, and limits the files and bytes that a model can make csgrt read.
class BrlcadParts {
public:
    /// The most bytes that all solids of one model together may copy: each solid that names a sketch or file gets a
    /// copy.
    static constexpr std::uint64_t most_bytes = max_file_bytes;

    /// `find` returns the object with a name, or nullptr. Names of files are relative to `folder`; only files below one
    /// of `allowed` are read.
    BrlcadParts(std::filesystem::path folder, const std::vector<std::string>& allowed,
                std::function<const BrlcadItem*(const std::string&)> find);

    /// Completes a solid if it has such parts. Makes it Unsupported, with the reason, if a part is not available.
    void complete(Shape& shape, bool cells_in_object);

private:
    /// Cells of a solid: their source, their number along each side, and the bytes of each cell.
    struct Cells {
        const std::string& source;
        std::uint64_t width, depth, height;
        unsigned size;
    };
    void complete_sketch(Sketch& sketch);
    std::string take_cells(const Cells& cells, bool in_object);
    std::string read_file(const std::string& name, std::uint64_t bytes) const;
    std::string read_object(const std::string& name, std::uint64_t bytes, unsigned size) const;
    void spend(std::uint64_t bytes);

    std::filesystem::path folder_;                ///< the folder as it is written in the model's name
    std::filesystem::path base_;                  ///< without links and ..
    std::vector<std::filesystem::path> allowed_;  ///< without links and ..
    std::function<const BrlcadItem*(const std::string&)> find_;
    std::uint64_t spent_ = 0;
};

}  // namespace csgrt
