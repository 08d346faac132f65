// Tree: the body of a combination.
//
//     width                           of the numbers that follow, 0 to 3: 1, 2, 4 or 8 bytes
//     matrices leaves leaf-bytes expression-length depth
//     matrices of 16 doubles, row by row
//     leaves: a name and its zero byte, the number of its matrix or -1
//     expression: a byte a token, postfix; the leaves are used in their order
//
// Without an expression the tree is the union of all leaves.
#include "formats/brlcad/g/tree.hpp"

#include <optional>
#include <utility>

#include "formats/brlcad/values.hpp"

namespace csgrt {

namespace {

constexpr std::size_t matrix_size = 16 * 8;
constexpr std::uint8_t leaf_token = 1, not_token = 6;

std::optional<Operator> operator_of(std::uint8_t token) {
    constexpr Operator operators[] = {Operator::union_, Operator::intersection, Operator::difference, Operator::xor_,
                                      Operator::not_};
    if (token <= leaf_token || token > not_token) return std::nullopt;
    return operators[token - leaf_token - 1];
}

/// Reads the tree of one combination.
class GTreeReader {
public:
    GTreeReader(const GBlock& body, const ByteSource& source, const std::string& object)
        : source_(source), object_(object), bytes_(read_g_block(body, "the members")) {}

    Tree read() {
        const std::uint64_t token_count = read_head();
        if (token_count == 0) {
            read_union();
        } else {
            read_expression(token_count);
        }
        if (leaves_.left() > 0) throw Fault{leaves_.offset(), "the leaves go on after the last one", {}};
        if (bytes_.left() > 0) throw Fault{bytes_.offset(), "the body goes on after its last part", {}};
        return std::move(tree_);
    }

private:
    /// Reads everything before the expression, and returns the expression's length.
    std::uint64_t read_head() {
        const std::size_t begin = bytes_.offset();
        width_ = bytes_.byte("the width of the numbers");
        if (width_ > 3) {
            throw Fault{begin, "the width of the numbers is " + std::to_string(width_) + ", not 0 to 3", {}};
        }
        const std::size_t matrices_begin = bytes_.offset();
        matrix_count_ = bytes_.number(width_, "the number of matrices");
        leaf_count_ = bytes_.number(width_, "the number of leaves");
        const std::uint64_t leaf_bytes = bytes_.number(width_, "the size of the leaves");
        const std::uint64_t token_count = bytes_.number(width_, "the length of the expression");
        bytes_.number(width_, "the depth of the tree");  // the size of a stack that this reader does not need

        if (matrix_count_ > bytes_.left() / matrix_size) {
            throw Fault{matrices_begin,
                        std::to_string(matrix_count_) + " matrices do not fit the " + std::to_string(bytes_.left()) +
                            " bytes that are left",
                        {}};
        }
        matrices_at_ = bytes_.offset();
        matrices_ = bytes_.take(matrix_count_ * matrix_size, "the matrices");
        const std::size_t leaves_at = bytes_.offset();
        leaves_ = ByteReader(bytes_.take(leaf_bytes, "the leaves"), leaves_at);
        return token_count;
    }

    void read_union() {
        for (std::uint64_t i = 0; i < leaf_count_; ++i) read_leaf();
        if (leaf_count_ < 2) return;
        TreeNode node;
        node.op = Operator::union_;
        node.arity = static_cast<std::uint32_t>(leaf_count_);  // all leaves are operands
        node.place = tree_.nodes.front().place;
        tree_.nodes.push_back(std::move(node));
    }

    void read_expression(std::uint64_t token_count) {
        const std::size_t begin = bytes_.offset();
        ByteReader tokens(bytes_.take(token_count, "the expression"), begin);
        std::uint64_t used = 0, operands = 0;
        while (tokens.left() > 0) {
            const std::size_t at = tokens.offset();
            const std::uint8_t token = tokens.byte("a token");
            if (token == leaf_token) {
                if (used == leaf_count_) {
                    throw Fault{
                        at,
                        "the expression needs more leaves than the " + std::to_string(leaf_count_) + " there are",
                        {}};
                }
                ++used;
                ++operands;
                read_leaf();
                continue;
            }
            const auto op = operator_of(token);
            if (!op) throw Fault{at, std::to_string(token) + " is no token of an expression", "tokens are 1 to 6"};
            const std::uint32_t arity = token == not_token ? 1 : 2;
            if (operands < arity) {
                throw Fault{
                    at, "the operator has " + std::to_string(operands) + " operands, not " + std::to_string(arity), {}};
            }
            operands -= arity - 1;
            TreeNode node;
            node.op = *op;
            node.arity = arity;
            node.place = source_.place(at, object_);
            tree_.nodes.push_back(std::move(node));
        }
        if (operands != 1) {
            throw Fault{begin, "the expression leaves " + std::to_string(operands) + " operands, not 1", {}};
        }
        if (used != leaf_count_) {
            throw Fault{
                begin,
                "the expression uses " + std::to_string(used) + " of " + std::to_string(leaf_count_) + " leaves",
                {}};
        }
    }

    void read_leaf() {
        TreeNode leaf;
        leaf.place = source_.place(leaves_.offset(), object_);
        leaf.object = leaves_.name("the name of a leaf");
        const std::size_t at = leaves_.offset();
        const std::int64_t matrix = leaves_.signed_number(width_, "the number of a leaf's matrix");
        if (matrix < -1 || (matrix >= 0 && static_cast<std::uint64_t>(matrix) >= matrix_count_)) {
            throw Fault{
                at,
                "the leaf has matrix " + std::to_string(matrix) + ", but there are " + std::to_string(matrix_count_),
                {}};
        }
        if (matrix >= 0) leaf.matrix = read_matrix(static_cast<std::size_t>(matrix));
        tree_.nodes.push_back(std::move(leaf));
    }

    Matrix read_matrix(std::size_t index) const {
        const std::size_t at = index * matrix_size;
        ByteReader reader(matrices_.substr(at, matrix_size), matrices_at_ + at);
        Matrix matrix;
        for (double& element : matrix) element = reader.real("an element of a matrix");
        return without_scale(matrix);
    }

    const ByteSource& source_;
    const std::string& object_;
    ByteReader bytes_;
    ByteReader leaves_{{}, 0};
    std::string_view matrices_;
    std::size_t matrices_at_ = 0;
    unsigned width_ = 0;
    std::uint64_t matrix_count_ = 0, leaf_count_ = 0;
    Tree tree_;
};

}  // namespace

Tree read_g_tree(const GBlock& body, const ByteSource& source, const std::string& object) {
    return GTreeReader(body, source, object).read();
}

}  // namespace csgrt
