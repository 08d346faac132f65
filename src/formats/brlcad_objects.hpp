// The objects of a database while it is read: their names are unique, and found quickly.
#pragma once

#include <cstddef>
#include <string>
#include <unordered_map>
#include <vector>

#include <csgrt/scene.hpp>

#include "formats/source.hpp"

namespace csgrt {

class BrlcadObjects {
public:
    explicit BrlcadObjects(Findings& findings) : findings_(findings) {}

    /// Keeps the object; a second one of a name is a finding at `offset` and is dropped.
    void add(Object object, std::size_t offset);

    /// The object of that name, or nullptr. Valid until the next `add`.
    Object* find(const std::string& name);

    /// All objects in the order in which they came; leaves none.
    std::vector<Object> take() { return std::move(objects_); }

private:
    Findings& findings_;
    std::vector<Object> objects_;
    std::unordered_map<std::string, std::size_t> index_;
};

}  // namespace csgrt
