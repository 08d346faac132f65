// The tree of a region, combination by combination, down to its solids.
#pragma once

#include <cstdint>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include "compile/flatten/flatten.hpp"
#include "compile/flatten/region_forest.hpp"

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

/// What a term's tree is: `value` everywhere, or where no solid is `outside`.
struct Constants {
    Value value, outside;
};

/// Writes the tree of one term in postfix order, dropping what is empty (or everything) on the way.
class Flattener {
public:
    Flattener(const Source& source, FlatPart& result) : source_(source), result_(result) {}

    /// Leaves are numbers in `result.leaves`.
    Constants write(const RegionForest& forest, std::uint32_t term, FlatTree& tree);

private:
    struct Level {
        Matrix matrix;
        std::uint64_t first_leaf;  ///< number of the first leaf below
    };
    using Open = Walk<Level>::Open;
    friend class Walk<Level>;

    void expand(std::uint32_t object, const Matrix& matrix);
    /// Returns the level if it is a combination to walk.
    std::optional<Level> enter(std::uint32_t object, const Matrix& matrix);
    // The visitor of the walk.
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
    // Operands. The nodes of one start at `firsts_` and end where the next one's start. A constant has none.
    std::vector<std::size_t> firsts_;
    std::vector<Value> values_, outsides_;
    Walk<Level> walk_;
    std::unordered_map<std::uint32_t, Value> hollow_;  ///< combinations without solids, and the constant that they are
    std::uint64_t leaves_ = 0;
};

}  // namespace csgrt
