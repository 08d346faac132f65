// Instance table: finds equal instances while trees are joined.
#pragma once

#include <cstdint>
#include <cstring>
#include <vector>

#include "compile/solids/meshes/near_lookup.hpp"
#include "compile/flatten/flatten.hpp"

namespace csgrt {

/// The table numbers the instances of a scene, each once.
class InstanceTable {
public:
    explicit InstanceTable(std::size_t objects) : first_(objects, none) {}

    /// Returns the number of the instance in `all`. A new instance is appended.
    std::uint32_t number(const Instance& instance, std::vector<Instance>& all) {
        const auto next = static_cast<std::uint32_t>(all.size());
        std::uint32_t& first = first_[instance.object];
        if (first == none) {
            first = next;
            others_.push_back(none);
            all.push_back(instance);
            return next;
        }
        // The object has several instances: an instance that is not the first is looked up among the others.
        if (equal(all[first], instance)) return first;
        const std::uint64_t hash = hash_of(instance);
        const std::uint32_t last = cells_.find(hash);
        for (std::uint32_t i = last; i != none; i = others_[i])
            if (equal(all[i], instance)) return i;
        others_.push_back(last);
        cells_.exchange(hash, next);
        all.push_back(instance);
        return next;
    }

private:
    static constexpr std::uint32_t none = CellTable::none;

    static bool equal(const Instance& a, const Instance& b) {
        return a.object == b.object && a.piece == b.piece && (a.matrix == b.matrix || *a.matrix == *b.matrix);
    }
    static std::uint64_t hash_of(const Instance& instance) {
        std::uint64_t hash = (14695981039346656037u ^ instance.object) * 1099511628211u ^ instance.piece;
        for (const double value : *instance.matrix) {
            std::uint64_t bits;
            std::memcpy(&bits, &value, sizeof bits);
            hash = (hash ^ bits) * 1099511628211u;
            hash ^= hash >> 29;
        }
        return hash;
    }

    std::vector<std::uint32_t> first_;   ///< one an object: its first instance
    CellTable cells_;                    ///< of the other instances: the last of each hash
    std::vector<std::uint32_t> others_;  ///< one an instance: the previous instance of the same hash
};

}  // namespace csgrt
