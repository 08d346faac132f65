// Flattener: writes the tree of a region, combination by combination, down to its solids.
#pragma once

#include <cstdint>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include "compile/flatten/flatten.hpp"
#include "compile/flatten/region_forest.hpp"

namespace csgrt {

/// The result of flattening some trees of a scene. Each thread has its own part.
struct FlatPart {
    struct Leaf {
        std::uint32_t object, piece, matrix;
    };
    std::vector<Leaf> leaves;  ///< in the order of the trees; one solid may have several
    std::vector<Matrix> matrices;
    std::unordered_map<std::uint32_t, SolidParts> composites;
    std::uint64_t references = 0;  ///< to combinations and solids
    bool has_unused = false;       ///< there are leaves that no tree uses any more
};

/// The constants of a term's tree: `value` if the whole tree is constant, and `outside`, its value where no solid is.
struct Constants {
    Value value, outside;
};

/// Writes the tree of one term in postfix order. Operands that are empty, or all of space, are removed on the way.
class Flattener {
public:
    Flattener(const Source& source, FlatPart& result) : source_(source), result_(result) {}

    /// Writes a term's tree. Its leaves are numbers in `result.leaves`.
    Constants write(const RegionForest& forest, std::uint32_t term, FlatTree& tree);

private:
    struct Level {
        Matrix matrix;
        std::uint64_t first_leaf;  ///< number of the first leaf below
    };
    using Open = Walk<Level>::Open;
    friend class Walk<Level>;

    void expand(std::uint32_t object, const Matrix& matrix);
    /// Enters an object. Returns the level if it is a combination to walk.
    std::optional<Level> enter(std::uint32_t object, const Matrix& matrix);
    // The visitor of the walk calls this for each child.
    std::optional<Level> follow(const Open& parent, std::uint32_t node, std::uint32_t child);
    void operate(const Open& parent, std::uint32_t node);
    void nothing() { push(Value::nothing, Value::nothing); }
    void leave(const Open& done);

    void push(Value value, Value outside);
    void operate(Operator op, std::size_t arity);
    std::uint32_t instance_of(std::uint32_t object, std::uint32_t piece, const Matrix& matrix);

    const Source& source_;
    FlatPart& result_;
    FlatTree* tree_ = nullptr;
    // Operands: the nodes of an operand begin at its entry in `firsts_` and end where the next operand's nodes begin. A
    // constant has no nodes.
    std::vector<std::size_t> firsts_;
    std::vector<Value> values_, outsides_;
    Walk<Level> walk_;
    std::unordered_map<std::uint32_t, Value> constants_;  ///< of combinations without solids
    std::uint64_t leaves_ = 0;
};

}  // namespace csgrt
