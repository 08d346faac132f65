#include "formats/brlcad/v5/tree.hpp"

#include <algorithm>
#include <optional>
#include <utility>
#include <vector>

#include "formats/brlcad/values.hpp"

namespace csgrt {

namespace {

constexpr std::string_view blanks = " \t\r\n\v\f";

std::optional<Operator> operator_of(std::string_view token) {
    if (token == "u") return Operator::union_;
    if (token == "n" || token == "+") return Operator::intersection;
    if (token == "-") return Operator::difference;
    if (token == "^") return Operator::xor_;
    if (token == "!") return Operator::not_;
    return std::nullopt;
}

/// Reads the text in one pass: an operator is put on `open_` when its node starts and into the tree when its node ends.
class TreeReader {
public:
    TreeReader(const TclWord& word, const TextSource& source, const std::string& object, TclStore& store)
        : word_(word), source_(source), object_(object), store_(store) {}

    Tree read() {
        skip_blanks();
        if (at_end() || word_.text.substr(at_) == "none") return {};
        start_node();
        while (!open_.empty()) {
            skip_blanks();
            if (at_end() || peek() == '}') {
                end_operator();
            } else if (peek() == '{') {
                ++at_;
                start_node();
            } else {
                fail(at_, "an operand must stand in braces");
            }
        }
        skip_blanks();
        if (!at_end()) fail(at_, "the tree should end here, but goes on");
        return std::move(tree_);
    }

private:
    /// An operand: its first node in the tree, or the empty set. The tree has no nodes for the empty set, because an
    /// operator with an empty operand is simplified at once.
    struct Operand {
        std::size_t first;
        bool empty;
    };
    struct OpenNode {
        Operator op;  ///< leaf: G or X, which add no node of their own
        std::size_t at;
        std::vector<Operand> operands{};
    };

    bool at_end() const { return at_ >= word_.text.size(); }
    char peek() const { return word_.text[at_]; }
    [[noreturn]] void fail(std::size_t at, std::string message, std::string suggestion = {}) const {
        throw Fault{word_.offset_at(at), std::move(message), std::move(suggestion)};
    }
    /// Skips blanks, and the backslash that continues a line.
    void skip_blanks() {
        while (!at_end()) {
            const std::string_view rest = word_.text.substr(at_);
            const bool continued = rest.starts_with("\\\n") || rest.starts_with("\\\r\n");
            if (blanks.find(rest[0]) == std::string_view::npos && !continued) return;
            ++at_;
        }
    }

    void start_node() {
        skip_blanks();
        const std::size_t begin = at_;
        at_ = std::min(word_.text.find_first_of(" \t\r\n\v\f{}\\", begin), word_.text.size());
        const std::string_view token = word_.text.substr(begin, at_ - begin);
        if (token == "l") {
            const std::size_t first = tree_.nodes.size();
            read_leaf();
            end_node({first, false});
        } else if (token == "N") {
            end_node({tree_.nodes.size(), true});
        } else if (token == "G" || token == "X") {
            open_.push_back({Operator::leaf, begin});
        } else if (const auto op = operator_of(token)) {
            open_.push_back({*op, begin});
        } else {
            fail(begin, token.empty() ? "a node is empty" : quoted(token) + " is no operator",
                 "a node starts with l (an object) or one of the operators u n + - ^ ! G X N");
        }
    }

    void end_operator() {
        const OpenNode node = std::move(open_.back());
        open_.pop_back();
        const bool one = node.op == Operator::not_ || node.op == Operator::leaf;
        const std::size_t expected = one ? 1 : 2;
        if (node.operands.size() != expected) {
            fail(node.at, "the operator has " + std::to_string(node.operands.size()) + " operands, not " +
                              std::to_string(expected));
        }
        const Operand left = node.operands.front(), right = node.operands.back();
        if (left.empty || right.empty) return end_node(combined_with_nothing(node, left, right));
        if (node.op == Operator::leaf) return end_node(left);
        TreeNode out;
        out.op = node.op;
        out.arity = static_cast<std::uint32_t>(expected);
        out.place = source_.place(word_.offset_at(node.at), object_);
        tree_.nodes.push_back(std::move(out));
        end_node({left.first, false});
    }

    /// The result of an operator if at least one operand is the empty set.
    Operand combined_with_nothing(const OpenNode& node, const Operand& left, const Operand& right) {
        if (node.op == Operator::not_) {
            fail(node.at, "the complement of nothing is all space, which no region can hold");
        }
        const bool needs_left = node.op == Operator::difference, needs_both = node.op == Operator::intersection;
        if (needs_both || (needs_left && left.empty)) {
            tree_.nodes.resize(left.first);
            return {left.first, true};
        }
        return {left.first, left.empty && right.empty};
    }

    /// Ends a node: its closing brace makes it an operand of the operator around it.
    void end_node(const Operand& operand) {
        if (open_.empty()) return;
        skip_blanks();
        if (at_end()) fail(open_.back().at, "the node is never closed");
        if (peek() != '}') fail(at_, "the node should end here, but goes on");
        ++at_;
        open_.back().operands.push_back(operand);
    }

    /// Reads the part of a leaf behind the l, up to the brace that ends the node (or the end of the text, if the leaf
    /// is the whole tree).
    void read_leaf() {
        const std::size_t end = open_.empty() ? word_.text.size() : closing_brace();
        TclWord body = word_;
        body.text = word_.text.substr(at_, end - at_);
        body.offset = word_.offset_at(at_);
        TclList elements(body, store_);
        TclWord name, matrix, extra;
        if (!elements.next(name)) fail(end, "the leaf names no object");
        TreeNode leaf;
        leaf.object = tcl_name(name);
        leaf.place = source_.place(name.offset, object_);
        if (elements.next(matrix)) leaf.matrix = read_matrix(matrix);
        if (elements.next(extra)) {
            throw Fault{extra.offset, "a leaf is a name and at most a matrix, but this one goes on", {}};
        }
        tree_.nodes.push_back(std::move(leaf));
        at_ = end;
    }

    std::size_t closing_brace() const {
        std::size_t depth = 1;
        for (std::size_t at = at_; at < word_.text.size(); ++at) {
            const char c = word_.text[at];
            if (c == '\\') ++at;
            if (c == '{') ++depth;
            if (c == '}' && --depth == 0) return at;
        }
        fail(at_, "the leaf is never closed");
    }

    Matrix read_matrix(const TclWord& word) {
        if (word.text == "I") return identity;
        Matrix matrix{};
        TclList elements(word, store_);
        TclWord element;
        for (std::size_t i = 0; i < matrix.size(); ++i) {
            if (!elements.next(element)) {
                throw Fault{elements.offset(), "the matrix has " + std::to_string(i) + " numbers, not 16", {}};
            }
            matrix[i] = read_number(element.text, element.offset);
        }
        if (elements.next(element)) throw Fault{element.offset, "the matrix has more than 16 numbers", {}};
        return without_scale(matrix);
    }

    const TclWord& word_;
    const TextSource& source_;
    const std::string& object_;
    TclStore& store_;
    std::size_t at_ = 0;
    std::vector<OpenNode> open_;
    Tree tree_;
};

}  // namespace

Tree read_v5_tree(const TclWord& word, const TextSource& source, const std::string& object, TclStore& store) {
    return TreeReader(word, source, object, store).read();
}

}  // namespace csgrt
