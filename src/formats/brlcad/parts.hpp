// Parts of solids that stand elsewhere: the sketch of an extrude or revolve, the cells of an ebm, vol or dsp.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include <csgrt/scene.hpp>

#include "formats/brlcad/objects.hpp"

namespace csgrt {

class BrlcadParts {
public:
    /// What all solids of one model may take together, in bytes: many solids may name one large sketch or file, and
    /// each gets a copy.
    static constexpr std::uint64_t most_bytes = max_file_bytes;

    /// `find` gives the object of a name, or nullptr. Names of files are relative to `folder`; only files below one of
    /// `allowed` are looked at.
    BrlcadParts(std::filesystem::path folder, const std::vector<std::string>& allowed,
                std::function<const BrlcadItem*(const std::string&)> find);

    /// Completes a solid if it needs that; if it cannot be, it becomes Unsupported, with the reason.
    void complete(Shape& shape, bool cells_in_object);

private:
    /// Cells of a solid: where they are, how many along each side, and how many bytes each has.
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

    std::filesystem::path folder_;                ///< as the model's name has it
    std::filesystem::path base_;                  ///< the same without links and ..
    std::vector<std::filesystem::path> allowed_;  ///< without links and ..
    std::function<const BrlcadItem*(const std::string&)> find_;
    std::uint64_t spent_ = 0;
};

}  // namespace csgrt
