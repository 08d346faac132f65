// Shards: several threads search for equal items among millions, with the result of one thread that takes the items in
// order. Items that may be equal are in one shard, each shard is searched in order, and different shards are
// independent.
#pragma once

#include <algorithm>
#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

#include "compile/solids/meshes/near_lookup.hpp"
#include "base/parallel.hpp"

namespace csgrt {

/// The division of items into shards, by the cells in which the items are looked up.
class Shards {
public:
    static constexpr std::uint32_t count = 4096;

    /// The position of an item: number `index` of chunk `chunk`.
    struct Member {
        std::uint32_t chunk, index;
    };

    /// The items of one thread.
    class Chunk {
    public:
        void reserve(std::size_t items) { of_.reserve(items); }
        /// One dimension of an item: its value, and the size of the cells in which it is looked up. Items that may be
        /// equal differ by at most `tolerance` in each dimension; cells are far larger.
        struct Dimension {
            double value, tolerance, cell;
        };
        template <std::size_t n>
        void add(const std::array<Dimension, n>& at) {
            of_.push_back(shard_of(at));
        }
        /// Looks up the item that was added last at another position, too.
        template <std::size_t n>
        void look_also(const std::array<Dimension, n>& at) {
            joined_.emplace_back(of_.back(), shard_of(at));
        }

    private:
        friend Shards;

        /// Returns the shard of the first cell. An item near a border joins the shards of all cells that it touches
        /// into one; such items are few.
        template <std::size_t n>
        std::uint16_t shard_of(const std::array<Dimension, n>& at) {
            std::array<CellRange, n> ranges;
            for (std::size_t i = 0; i < n; ++i) ranges[i] = cells_of(at[i].value, at[i].tolerance, at[i].cell);
            std::array<std::int64_t, n> cell;
            const auto shard = [&](std::size_t corner) {
                for (std::size_t i = 0; i < n; ++i) cell[i] = corner >> i & 1 ? ranges[i].last : ranges[i].first;
                return static_cast<std::uint16_t>(mixed(cell_hash(cell)) >> 52 & (count - 1));
            };
            const std::uint16_t first = shard(0);
            for (std::size_t i = 0; i < n; ++i) {
                if (ranges[i].first == ranges[i].last) continue;
                for (std::size_t corner = 1; corner < std::size_t{1} << n; ++corner)
                    if (const std::uint16_t other = shard(corner); other != first) joined_.emplace_back(first, other);
                break;
            }
            return first;
        }

        std::vector<std::uint16_t> of_;                                ///< one an item
        std::vector<std::pair<std::uint16_t, std::uint16_t>> joined_;  ///< pairs of shards with an item in common
    };

    explicit Shards(std::size_t chunks) : chunks_(chunks) { std::iota(root_.begin(), root_.end(), std::uint16_t{0}); }

    Chunk& chunk(std::size_t number) { return chunks_[number]; }

    /// Gives an item another position, when the items are sorted: that of the only item of `other`.
    void replace(std::size_t chunk, std::size_t index, const Chunk& other) {
        touch(chunk, index);
        changed_.push_back(chunks_[chunk].of_[index] = other.of_.front());
        for (const auto& [a, b] : other.joined_) root_[root(a)] = root(b);
    }
    /// Says that an item is no longer what it was.
    void touch(std::size_t chunk, std::size_t index) { changed_.push_back(chunks_[chunk].of_[index]); }
    /// The items of all shards with an item that has changed since the last call, by chunk and arrival.
    std::vector<Member> take_changed() {
        std::array<bool, count> is_changed{};
        for (const std::uint16_t shard : std::exchange(changed_, {})) is_changed[root(shard)] = true;
        for (std::uint32_t i = 0; i < count; ++i) is_changed[i] = is_changed[root(static_cast<std::uint16_t>(i))];
        std::vector<Member> found;
        for (std::uint32_t c = 0; c < chunks_.size(); ++c)
            for (std::uint32_t i = 0; i < chunks_[c].of_.size(); ++i)
                if (is_changed[chunks_[c].of_[i]]) found.push_back({c, i});
        return found;
    }
    /// Frees the lists of members: for_each() has run.
    void forget_members() { members_ = {}; }

    /// Sorts the items by shard, then by arrival, when all chunks are complete.
    void sort() {
        for (const Chunk& chunk : chunks_)
            for (const auto& [a, b] : chunk.joined_) root_[root(a)] = root(b);
        for (std::uint32_t i = 0; i < count; ++i) root_[i] = root(static_cast<std::uint16_t>(i));
        // Chunks are put into groups, because each group needs a count for every shard.
        constexpr std::size_t most_groups = 64;
        const std::size_t group_size = std::max<std::size_t>(1, (chunks_.size() + most_groups - 1) / most_groups);
        std::vector<std::array<std::uint32_t, count>> groups((chunks_.size() + group_size - 1) / group_size);
        for_chunks(chunks_.size(), group_size, 0, [&](std::size_t first, std::size_t last, std::size_t group) {
            for (std::size_t c = first; c < last; ++c)
                for (std::uint16_t& shard : chunks_[c].of_) ++groups[group][shard = root_[shard]];
        });
        for (const auto& counts : groups)
            for (std::uint32_t shard = 0; shard < count; ++shard) first_[shard + 1] += counts[shard];
        std::partial_sum(first_.begin(), first_.end(), first_.begin());
        // The counts become the positions where a group's part of each shard begins.
        std::array<std::uint32_t, count + 1> next = first_;
        for (auto& counts : groups)
            for (std::uint32_t shard = 0; shard < count; ++shard)
                next[shard] += std::exchange(counts[shard], next[shard]);
        // Large shards come first, so that no thread begins a large shard at the end.
        for (std::uint32_t shard = 0; shard < count; ++shard)
            if (size_of(shard) > 0) by_size_.push_back(static_cast<std::uint16_t>(shard));
        std::stable_sort(by_size_.begin(), by_size_.end(), [this](auto a, auto b) { return size_of(a) > size_of(b); });
        resize_cleared(members_, first_[count]);
        for_chunks(chunks_.size(), group_size, 0, [&](std::size_t first, std::size_t last, std::size_t group) {
            for (std::size_t c = first; c < last; ++c)
                for (std::uint32_t i = 0; i < chunks_[c].of_.size(); ++i)
                    members_[groups[group][chunks_[c].of_[i]]++] = {static_cast<std::uint32_t>(c), i};
        });
    }
    /// Calls work(table, members, shard) for each shard that has members, several at once, with a table that is cleared
    /// before. Each thread has its own table, which begins as a copy of `empty`. With new memory for every shard, a
    /// seventh of the memory pages that compiling used were for these tables.
    template <class Table, class Work>
    void for_each(const Table& empty, const Work& work) const {
        constexpr std::size_t few = 8192;  // items below which threads would take longer to start
        const unsigned threads = members_.size() < few ? 1 : thread_count(0);
        std::atomic<std::size_t> next{0};
        for_chunks(threads, 1, threads, [&](std::size_t, std::size_t, std::size_t) {
            Table table = empty;
            for (std::size_t i = next++; i < by_size_.size(); i = next++) {
                const std::uint16_t shard = by_size_[i];
                table.clear();
                work(table, std::span<const Member>(members_).subspan(first_[shard], size_of(shard)), shard);
            }
        });
    }
    template <class Work>
    void for_each(const Work& work) const {
        struct None {
            void clear() {}
        };
        for_each(None{}, [&](None, std::span<const Member> members, std::size_t shard) { work(members, shard); });
    }

private:
    std::uint32_t size_of(std::size_t shard) const { return first_[shard + 1] - first_[shard]; }
    std::uint16_t root(std::uint16_t shard) const {
        while (root_[shard] != shard) shard = root_[shard];
        return shard;
    }

    std::vector<Chunk> chunks_;
    std::array<std::uint16_t, count> root_;
    std::array<std::uint32_t, count + 1> first_{};  ///< of each shard, among the members
    std::vector<std::uint16_t> by_size_;            ///< shards with members, the largest first
    std::vector<Member> members_;
    std::vector<std::uint16_t> changed_;
};

}  // namespace csgrt
