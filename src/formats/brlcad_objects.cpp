#include "formats/brlcad_objects.hpp"

#include <utility>

namespace csgrt {

void BrlcadObjects::add(Object object, std::size_t offset) {
    const std::string name = name_of(object);
    const auto [found, is_new] = index_.try_emplace(name, objects_.size());
    if (!is_new) {
        const Place& first = place_of(objects_[found->second]);
        const std::string where = first.line > 0 ? "on line " + std::to_string(first.line)
                                                 : "at byte " + std::to_string(first.offset);
        findings_.add(offset, name, "this name is taken by the object " + where,
                      "rename one of them: combinations refer to objects by name");
        return;
    }
    objects_.push_back(std::move(object));
}

Object* BrlcadObjects::find(const std::string& name) {
    const auto found = index_.find(name);
    return found == index_.end() ? nullptr : &objects_[found->second];
}

}  // namespace csgrt
