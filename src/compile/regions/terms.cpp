// Terms of trees: finds the solids that start each term, and the value of a term where one solid alone covers. layout.h
// explains terms.

#include "compile/regions/terms.hpp"

#include <algorithm>
#include <atomic>
#include <utility>

#include "base/prefetch.hpp"
#include "base/parallel.hpp"

namespace csgrt {

namespace {

/// A term of a region's tree: words [first, end) of `trees`.
struct Term {
    std::uint32_t region, first, end;
};

/// Adds the members of the unions at a tree's top, in order.
void add_terms(const std::vector<std::uint32_t>& trees, const RegionWords& record, std::uint32_t region,
               std::vector<Term>& terms) {
    const Term whole{region, record.first_word, record.first_word + record.word_count};
    if (record.word_count == 0) return;
    if (trees[whole.first] >> TREE_SHIFT != OP_UNION) return terms.push_back(whole);
    std::vector<Term> rest{whole};
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

/// The roles of solids in a term, see layout.h. A solid with several roles is undecided.
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
                // The solid has several roles: needed, removed or undecided. The list is sorted: needed comes after
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

    /// Writes a table of at least twice as many entries as needed, so that the search for a solid that is not in the
    /// table ends soon.
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

/// The value of a term where a solid alone covers a partition. unknown: the solid is in the term more than once.
enum class Alone : std::uint8_t { no, holds, unknown };

/// The lists that one thread makes for some terms.
struct TermChunk {
    std::vector<kernel::StartRecord> records;
    std::vector<std::uint32_t> starts;  ///< the solids that start each term, each once
    std::vector<Alone> alone;  ///< one for each element of `starts`: the term's value where this solid alone covers
    std::vector<std::uint32_t> ends;  ///< one a term: where the term's elements end in the lists
    std::vector<std::pair<std::uint32_t, bool>>
        leaves;                 ///< of one term: solid, and whether the term is true where the solid alone covers
    std::vector<bool> is_true;  ///< of one term, one for each word
};

/// Finds for each of the term's starts, from `first` on, whether the term holds where this solid alone covers. There
/// each operator has at least one empty operand. Linearized trees have no complements.
void add_alone(const std::vector<std::uint32_t>& trees, const Term& term, std::size_t first, TermChunk& chunk) {
    auto& leaves = chunk.leaves;
    auto& is_true = chunk.is_true;
    leaves.clear();
    is_true.assign(term.end - term.first, false);
    is_true[0] = true;
    for (std::uint32_t node = term.first; node < term.end; ++node) {  // operators are stored before their operands
        const std::uint32_t op = trees[node] >> TREE_SHIFT, right = trees[node] & TREE_MASK;
        const bool is = is_true[node - term.first];
        if (op == OP_LEAF) {
            leaves.emplace_back(right, is);
        } else {
            is_true[node + 1 - term.first] = is && (op == OP_UNION || op == OP_XOR || op == OP_DIFFERENCE);
            is_true[right - term.first] = is && (op == OP_UNION || op == OP_XOR || op == OP_REVERSE_DIFFERENCE);
        }
    }
    std::sort(leaves.begin(), leaves.end());
    auto leaf = leaves.begin();
    for (std::size_t i = first; i < chunk.starts.size(); ++i) {
        while (leaf->first != chunk.starts[i]) ++leaf;
        const auto next = leaf + 1;
        const bool is_once = next == leaves.end() || next->first != leaf->first;
        chunk.alone.push_back(!is_once ? Alone::unknown : leaf->second ? Alone::holds : Alone::no);
    }
}

/// Lists the starts of a term. `halves`: whether each solid is a half-space, which nearly every ray meets. The starts
/// of an intersection are the starts of the operand with fewer half-spaces or, if equal, with fewer leaves.
void add_starts(const std::vector<std::uint32_t>& trees, const Term& term, const std::vector<bool>& halves,
                TermChunk& chunk) {
    // A part's starts are a linked list of nodes; `next` has a link for each word of the term.
    struct Part {
        std::uint32_t first, last;
        std::uint32_t halves, leaves;
        kernel::SolidFilter needed;
    };
    const auto solid_at = [&](std::uint32_t node) { return trees[node] & TREE_MASK; };
    const std::size_t before = chunk.starts.size();
    if (term.end - term.first == 1) {
        const kernel::SolidFilter solid = kernel::filter_of(solid_at(term.first));
        chunk.records.push_back({term.region, term.first, term.end, solid, solid, NONE});
        chunk.starts.push_back(solid_at(term.first));
        chunk.alone.push_back(Alone::holds);
    } else {
        // The loop runs from the back, so that operands come before their operators. The stack has the left operand on
        // top.
        std::vector<Part> stack;
        stack.reserve(TREE_STACK);
        std::vector<std::uint32_t> next(term.end - term.first, NONE);
        kernel::SolidFilter solids{0, 0};
        for (std::uint32_t node = term.end; node-- > term.first;) {
            const std::uint32_t op = trees[node] >> TREE_SHIFT;
            if (op == OP_LEAF) {
                stack.push_back({node, node, halves[solid_at(node)], 1, kernel::filter_of(solid_at(node))});
                solids = kernel::with(solids, stack.back().needed);
                continue;
            }
            const Part left = stack.back();
            stack.pop_back();
            Part& right = stack.back();
            const kernel::SolidFilter needed = right.needed;
            if (op == OP_DIFFERENCE) {
                right = left;
            } else if (op == OP_INTERSECTION) {
                if (std::pair(left.halves, left.leaves) <= std::pair(right.halves, right.leaves)) right = left;
                right.needed = kernel::with(left.needed, needed);
            } else if (op != OP_REVERSE_DIFFERENCE) {
                next[right.last - term.first] = left.first;
                right = {right.first,
                         left.last,
                         left.halves + right.halves,
                         left.leaves + right.leaves,
                         {left.needed.even & needed.even, left.needed.odd & needed.odd}};
            }
        }
        const Part& whole = stack.back();
        chunk.records.push_back({term.region, term.first, term.end, whole.needed, solids, NONE});
        for (std::uint32_t node = whole.first; node != NONE; node = next[node - term.first])
            chunk.starts.push_back(solid_at(node));
        const auto own = chunk.starts.begin() + static_cast<std::ptrdiff_t>(before);
        std::sort(own, chunk.starts.end());
        chunk.starts.erase(std::unique(own, chunk.starts.end()), chunk.starts.end());
        add_alone(trees, term, before, chunk);
    }
    chunk.ends.push_back(static_cast<std::uint32_t>(chunk.starts.size()));
}

/// Adds to the solid's claim the value of a term of the region where the solid alone covers. Regions come in ascending
/// order.
void claim_alone(const Logic& logic, kernel::SolidRecord& solid, Alone alone, std::uint32_t region) {
    const std::uint32_t least = solid.alone & ~OVERLAP;
    if (alone == Alone::no || solid.alone == ALONE_UNKNOWN) return;
    if (alone == Alone::unknown) {
        solid.alone = ALONE_UNKNOWN;
    } else if (least == NONE) {
        solid.alone = region;
    } else if (least != region && kernel::same_rank(logic.rank_ends, least, region)) {
        solid.alone = least | OVERLAP;
    }
}

/// Gives each solid a range of a table, of the size of its count, and sets the counts to 0. Returns the size of the
/// table.
std::uint32_t lay_out(std::vector<kernel::SolidRecord>& solids, std::uint32_t kernel::SolidRecord::*first,
                      std::uint32_t kernel::SolidRecord::*count) {
    std::uint32_t total = 0;
    for (kernel::SolidRecord& solid : solids) {
        solid.*first = total;
        total += std::exchange(solid.*count, 0);
    }
    return total;
}

/// Lists the positions of solids in large terms.
void list_leaves(const std::vector<Term>& terms, Logic& logic, std::vector<kernel::SolidRecord>& solids) {
    const auto for_each = [&](const auto& call) {
        for (const Term& term : terms) {
            if (term.end - term.first <= SCANNED_WORDS) continue;
            for (std::uint32_t node = term.first; node < term.end; ++node)
                if (logic.trees[node] >> TREE_SHIFT == OP_LEAF) call(solids[logic.trees[node] & TREE_MASK], node);
        }
    };
    for_each([](kernel::SolidRecord& solid, std::uint32_t) { ++solid.leaf_count; });
    const std::size_t first = logic.trees.size();
    std::vector<std::uint32_t> leaves(
        lay_out(solids, &kernel::SolidRecord::first_leaf, &kernel::SolidRecord::leaf_count));
    for_each(
        [&](kernel::SolidRecord& solid, std::uint32_t node) { leaves[solid.first_leaf + solid.leaf_count++] = node; });
    for (kernel::SolidRecord& solid : solids) solid.first_leaf += static_cast<std::uint32_t>(first);
    logic.trees.insert(logic.trees.end(), leaves.begin(), leaves.end());
}

}  // namespace

std::uint32_t write_roles(std::vector<std::uint32_t>& trees, std::uint32_t first, std::uint32_t end) {
    const Roles roles(trees, first, end);
    if (trees.size() >= NONE) return NONE;  // a term works without a table
    const auto place = static_cast<std::uint32_t>(trees.size());
    roles.write(trees);
    return place;
}

void mark_begins(const std::vector<std::uint32_t>& trees, std::uint32_t first, std::uint32_t end,
                 std::vector<kernel::SolidRecord>& solids) {
    struct Branch {
        std::uint32_t first, end;
        std::uint32_t same, opposite;  // BEGINS_x of solids that the term needs, and of solids that it removes
    };
    std::vector<Branch> rest;
    rest.reserve(TREE_STACK);
    rest.push_back({first, end, BEGINS_AT_ENTRY, BEGINS_AT_EXIT});
    while (!rest.empty()) {
        const auto [node, node_end, same, opposite] = rest.back();
        rest.pop_back();
        const std::uint32_t op = trees[node] >> TREE_SHIFT, right = trees[node] & TREE_MASK;
        if (op == OP_LEAF) {
            std::atomic_ref(solids[right].begins).fetch_or(same, std::memory_order_relaxed);
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

std::vector<kernel::SolidRecord> list_terms(Logic& logic, const std::vector<bool>& halves) {
    kernel::SolidRecord unclaimed{};
    unclaimed.alone = NONE;
    std::vector<kernel::SolidRecord> solids(halves.size(), unclaimed);
    std::vector<Term> terms;
    terms.reserve(logic.regions.size());
    for (std::uint32_t region = 0; region < logic.regions.size(); ++region)
        add_terms(logic.trees, logic.regions[region], region, terms);

    constexpr std::size_t chunk_size = 1024;
    std::vector<TermChunk> chunks((terms.size() + chunk_size - 1) / chunk_size);
    for_chunks(terms.size(), chunk_size, 0, [&](std::size_t first, std::size_t last, std::size_t number) {
        TermChunk& chunk = chunks[number];
        chunk.records.reserve(last - first);
        chunk.ends.reserve(last - first);
        for (std::size_t i = first; i < last; ++i) {
            mark_begins(logic.trees, terms[i].first, terms[i].end, solids);
            add_starts(logic.trees, terms[i], halves, chunk);
        }
        for (const std::uint32_t solid : chunk.starts)
            std::atomic_ref(solids[solid].start_count).fetch_add(1, std::memory_order_relaxed);
    });

    resize_cleared(logic.starts, lay_out(solids, &kernel::SolidRecord::first_start, &kernel::SolidRecord::start_count));
    for (TermChunk& chunk : chunks) {
        std::uint32_t i = 0;
        for (std::size_t term = 0; term < chunk.records.size(); ++term) {
            kernel::StartRecord& record = chunk.records[term];
            const std::uint32_t words = record.end_word - record.first_word;
            if (words > PLAIN_WORDS) record.roles = write_roles(logic.trees, record.first_word, record.end_word);
            logic.has_large_terms = logic.has_large_terms || words > SCANNED_WORDS;
            for (; i < chunk.ends[term]; ++i) {
                constexpr std::size_t soon = 16;
                if (i + soon < chunk.starts.size()) prefetch_line(&solids[chunk.starts[i + soon]]);
                kernel::SolidRecord& solid = solids[chunk.starts[i]];
                logic.starts[solid.first_start + solid.start_count++] = record;
                claim_alone(logic, solid, chunk.alone[i], record.region);
            }
        }
    }
    if (logic.has_large_terms) list_leaves(terms, logic, solids);
    return solids;
}

}  // namespace csgrt
