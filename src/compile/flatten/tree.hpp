// The tree of a region, combination by combination, down to its solids.
#pragma once

#include <cstdint>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include "compile/flatten/flatten.hpp"
#include "compile/regions/regions.hpp"

namespace csgrt {

/// What some of a scene's trees hold: a part of it is a thread's.
struct FlatPart {
    struct Leaf {
        std::uint32_t object, piece, matrix;
    };
    std::vector<Leaf> leaves;  ///< in the order of the trees; not each once
    std::vector<Matrix> matrices;
    std::unordered_map<std::uint32_t, Pieces> composites;
    std::uint64_t references = 0;  ///< to combinations and solids
    bool has_unused = false;       ///< leaves that no tree holds any more
};

/// Writes the tree of one term in postfix order, dropping what is empty (or everything) on the way.
class Flattener {
public:
    Flattener(const Scene& scene, const ObjectIndex& index, FlatPart& result)
        : scene_(scene), index_(index), result_(result) {}

    enum class Kind { tree, nothing, everything };
    /// Leaves are numbers in `result.leaves`.
    Kind write(const RegionForest& forest, std::uint32_t term, FlatTree& tree);

private:
    /// The nodes of an operand start at `first` and end where the next one's start. A constant has none.
    struct Operand {
        std::size_t first;
        Kind kind;
    };
    struct Frame {
        const Combination* combination;
        std::uint32_t object;
        Matrix matrix;
        std::size_t next;
        std::uint64_t first_leaf;  ///< number of the first leaf below
    };

    void expand(std::uint32_t object, const Matrix& matrix);
    void enter(std::uint32_t object, const Matrix& matrix);
    void operate(Operator op, std::uint32_t arity);
    void append(Operator op, std::size_t arity);
    std::uint32_t instance_of(std::uint32_t object, std::uint32_t piece, const Matrix& matrix);

    const Scene& scene_;
    const ObjectIndex& index_;
    FlatPart& result_;
    FlatTree* tree_ = nullptr;
    std::vector<Operand> operands_;
    std::vector<Frame> frames_;
    std::unordered_map<const Combination*, Kind> hollow_;  ///< without solids below, and the constant that they are
    std::uint64_t leaves_ = 0;
};

}  // namespace csgrt
