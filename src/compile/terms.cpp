// Trees -> their terms: which solids start each, and what becomes of it when others cover a partition, too. layout.h
// says what a term is.

#include "compile/terms.hpp"

#include <algorithm>

#include "parallel.hpp"

namespace csgrt {

namespace {

/// A term of a region's tree: words [first, end) of `trees`.
struct Term {
    std::uint32_t region, first, end;
};

/// The members of the unions at a tree's top, in order.
void add_terms(const std::vector<std::uint32_t>& trees, const kernel::RegionRecord& record, std::uint32_t region,
               std::vector<Term>& terms) {
    std::vector<Term> rest{{region, record.first_word, record.first_word + record.word_count}};
    while (!rest.empty()) {
        const Term term = rest.back();
        rest.pop_back();
        if (trees[term.first] >> TREE_SHIFT == OP_UNION) {
            const std::uint32_t right = trees[term.first] & TREE_MASK;
            rest.push_back({region, right, term.end});
            rest.push_back({region, term.first + 1, right});
        } else {
            terms.push_back(term);
        }
    }
}

/// Solids and what they are to a term, see layout.h. A solid is undecided wherever it is not one thing alone.
class Roles {
public:
    Roles(const std::vector<std::uint32_t>& trees, std::uint32_t first, std::uint32_t end) : trees_(trees) {
        std::vector<Part> rest{{first, end, Place::needed}};
        while (!rest.empty()) {
            const Part part = rest.back();
            rest.pop_back();
            const std::uint32_t op = trees_[part.first] >> TREE_SHIFT, right = trees_[part.first] & TREE_MASK;
            const auto descend = [&](Place left_place, Place right_place) {
                rest.push_back({right, part.end, right_place});
                rest.push_back({part.first + 1, right, left_place});
            };
            if (op == OP_LEAF) {
                entries_.push_back({right, part.place == Place::needed ? ROLE_NEEDED : ROLE_BLOCKS});
            } else if (part.place == Place::needed && op == OP_INTERSECTION) {
                descend(Place::needed, Place::needed);
            } else if (part.place == Place::needed && op == OP_DIFFERENCE) {
                descend(Place::needed, Place::removed);
            } else if (part.place == Place::needed && op == OP_REVERSE_DIFFERENCE) {
                descend(Place::removed, Place::needed);
            } else if (part.place == Place::removed && op == OP_UNION) {
                descend(Place::removed, Place::removed);
            } else {
                if (part.place == Place::needed) needs_undecided_ = true;
                for (std::uint32_t node = part.first; node < part.end; ++node)
                    if (trees_[node] >> TREE_SHIFT == OP_LEAF)
                        entries_.push_back({trees_[node] & TREE_MASK, ROLE_UNDECIDED});
            }
        }
        std::sort(entries_.begin(), entries_.end());
        std::size_t kept = 0;
        for (const auto& [solid, role] : entries_) {
            if (kept > 0 && entries_[kept - 1].first == solid) {
                // Needed, removed or undecided, and not always the same. Sorted: what is needed comes after what is
                // removed.
                if (entries_[kept - 1].second == role) continue;
                needs_undecided_ = needs_undecided_ || role == ROLE_NEEDED || entries_[kept - 1].second == ROLE_NEEDED;
                entries_[kept - 1].second = ROLE_UNDECIDED;
            } else {
                entries_[kept++] = {solid, role};
            }
        }
        entries_.resize(kept);
    }

    /// A table twice as large as its entries at least, so that what is not in it is soon found not to be.
    void write(std::vector<std::uint32_t>& words) const {
        std::uint32_t bits = 1, needed = 0;
        while ((1u << bits) < 2 * entries_.size()) ++bits;
        for (const auto& [solid, role] : entries_) needed += role == ROLE_NEEDED;
        const std::size_t table = words.size() + ROLES_HEADER;
        words.push_back(32 - bits);
        words.push_back(needs_undecided_ ? NONE : needed);
        words.resize(table + (1u << bits), NONE);
        for (const auto& [solid, role] : entries_) {
            std::uint32_t place = kernel::place_of_role(solid, 32 - bits);
            while (words[table + place] != NONE) place = (place + 1) & ((1u << bits) - 1);
            words[table + place] = role << TREE_SHIFT | solid;
        }
    }

private:
    enum class Place { needed, removed };
    struct Part {
        std::uint32_t first, end;
        Place place;
    };

    const std::vector<std::uint32_t>& trees_;
    std::vector<std::pair<std::uint32_t, std::uint32_t>> entries_;  // solid, role
    bool needs_undecided_ = false;
};

/// The record of a term, and the leaves that start it, ascending; positions in `trees`.
struct TermStarts {
    kernel::StartRecord record;
    std::vector<std::uint32_t> leaves;
};
TermStarts starts_of(const std::vector<std::uint32_t>& trees, const Term& term) {
    struct Part {
        std::vector<std::uint32_t> leaves;
        kernel::SolidFilter needed;
    };
    if (term.end - term.first == 1) {
        const kernel::SolidFilter solid = kernel::filter_of(trees[term.first] & TREE_MASK);
        return {{term.region, term.first, term.end, solid, solid, NONE}, {term.first}};
    }
    // From the back, so that operands come before their operators: the way back is a stack, left operand on top.
    std::vector<Part> stack;
    kernel::SolidFilter solids{0, 0};
    for (std::uint32_t node = term.end; node-- > term.first;) {
        const std::uint32_t op = trees[node] >> TREE_SHIFT;
        if (op == OP_LEAF) {
            stack.push_back({{node}, kernel::filter_of(trees[node] & TREE_MASK)});
            solids = kernel::with(solids, stack.back().needed);
            continue;
        }
        Part left = std::move(stack.back());
        stack.pop_back();
        Part& right = stack.back();
        if (op == OP_DIFFERENCE) {
            right = std::move(left);
        } else if (op == OP_INTERSECTION) {
            right.needed = kernel::with(left.needed, right.needed);
            if (left.leaves.size() <= right.leaves.size()) right.leaves = std::move(left.leaves);
        } else if (op != OP_REVERSE_DIFFERENCE) {
            right.needed = {left.needed.even & right.needed.even, left.needed.odd & right.needed.odd};
            if (left.leaves.size() > right.leaves.size()) std::swap(left.leaves, right.leaves);
            right.leaves.insert(right.leaves.end(), left.leaves.begin(), left.leaves.end());
        }
    }
    std::sort(stack.back().leaves.begin(), stack.back().leaves.end());
    return {{term.region, term.first, term.end, stack.back().needed, solids, NONE}, std::move(stack.back().leaves)};
}

/// Gives each solid its part of a table: `for_each(call)` calls call(solid, entry), in order, the same each time.
template <class Entry, class ForEach>
void fill_table(std::vector<kernel::SolidRecord>& solids, std::uint32_t kernel::SolidRecord::* first,
                std::uint32_t kernel::SolidRecord::* count, std::vector<Entry>& table, const ForEach& for_each) {
    for_each([&](std::uint32_t solid, const Entry&) { ++(solids[solid].*count); });
    std::uint32_t total = 0;
    for (kernel::SolidRecord& solid : solids) {
        solid.*first = total;
        total += solid.*count;
        solid.*count = 0;
    }
    table.resize(total);
    for_each([&](std::uint32_t solid, const Entry& entry) {
        table[solids[solid].*first + solids[solid].*count] = entry;
        ++(solids[solid].*count);
    });
}

}  // namespace

std::uint32_t write_roles(std::vector<std::uint32_t>& trees, std::uint32_t first, std::uint32_t end) {
    const Roles roles(trees, first, end);
    if (trees.size() >= NONE) return NONE;  // it does without
    const auto place = static_cast<std::uint32_t>(trees.size());
    roles.write(trees);
    return place;
}

void mark_begins(const std::vector<std::uint32_t>& trees, std::uint32_t first, std::uint32_t end,
                 std::vector<kernel::SolidRecord>& solids) {
    struct Branch {
        std::uint32_t first, end;
        std::uint32_t same, opposite;  // BEGINS_x of solids that the term needs there, and of those that it is without
    };
    std::vector<Branch> rest{{first, end, BEGINS_AT_ENTRY, BEGINS_AT_EXIT}};
    while (!rest.empty()) {
        const auto [node, node_end, same, opposite] = rest.back();
        rest.pop_back();
        const std::uint32_t op = trees[node] >> TREE_SHIFT, right = trees[node] & TREE_MASK;
        if (op == OP_LEAF) {
            solids[right].begins |= same;
        } else if (op == OP_NOT) {
            rest.push_back({node + 1, node_end, opposite, same});
        } else if (op == OP_XOR) {
            rest.push_back({node + 1, right, same | opposite, same | opposite});
            rest.push_back({right, node_end, same | opposite, same | opposite});
        } else {
            rest.push_back(op == OP_REVERSE_DIFFERENCE ? Branch{node + 1, right, opposite, same}
                                                       : Branch{node + 1, right, same, opposite});
            rest.push_back(op == OP_DIFFERENCE ? Branch{right, node_end, opposite, same}
                                               : Branch{right, node_end, same, opposite});
        }
    }
}

void list_terms(CompiledScene& compiled) {
    const auto solid_at = [&](std::uint32_t node) { return compiled.trees[node] & TREE_MASK; };
    std::vector<Term> terms;
    for (std::uint32_t region = 0; region < compiled.regions.size(); ++region)
        add_terms(compiled.trees, compiled.regions[region], region, terms);
    for (const Term& term : terms) mark_begins(compiled.trees, term.first, term.end, compiled.solids);
    std::vector<TermStarts> starts(terms.size());
    constexpr std::size_t chunk = 1024;
    for_chunks(terms.size(), chunk, 0, [&](std::size_t first, std::size_t last, std::size_t) {
        for (std::size_t i = first; i < last; ++i) starts[i] = starts_of(compiled.trees, terms[i]);
    });
    for (std::size_t i = 0; i < terms.size(); ++i) {
        if (terms[i].end - terms[i].first <= PLAIN_WORDS) continue;
        starts[i].record.roles = write_roles(compiled.trees, terms[i].first, terms[i].end);
    }
    std::vector<std::size_t> last;
    fill_table(compiled.solids, &kernel::SolidRecord::first_start, &kernel::SolidRecord::start_count, compiled.starts,
               [&](const auto& call) {
                   last.assign(compiled.solids.size(), terms.size());
                   for (std::size_t i = 0; i < terms.size(); ++i)
                       for (const std::uint32_t node : starts[i].leaves) {
                           const std::uint32_t solid = solid_at(node);
                           if (last[solid] == i) continue;
                           last[solid] = i;
                           call(solid, starts[i].record);
                       }
               });
    fill_table(compiled.solids, &kernel::SolidRecord::first_leaf, &kernel::SolidRecord::leaf_count, compiled.leaves,
               [&](const auto& call) {
                   for (const Term& term : terms) {
                       if (term.end - term.first <= SCANNED_WORDS) continue;
                       compiled.has_large_terms = true;
                       for (std::uint32_t node = term.first; node < term.end; ++node)
                           if (compiled.trees[node] >> TREE_SHIFT == OP_LEAF) call(solid_at(node), node);
                   }
               });
}

}  // namespace csgrt
