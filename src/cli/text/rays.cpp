#include "rays.hpp"

#include <cstring>
#include <type_traits>

#include "scene/range.hpp"
#include "cli/values.hpp"

namespace csgrt::cli {

namespace {

template <class Item>
constexpr bool is_ray = std::is_same_v<Item, Ray>;

template <class Item>
constexpr std::size_t numbers_of_item = sizeof(Item) / sizeof(double);

template <class Item>
constexpr const char* form_of =
    is_ray<Item> ? "a ray is six numbers: ox oy oz dx dy dz" : "a point is three numbers: x y z";

}  // namespace

template <class Item>
ItemReader<Item>::ItemReader(const std::string& path) : lines_(path, LineReader::Passes::several) {
    std::string_view line;
    Item item;
    while (lines_.next(line))
        if (parse(line, item)) ++count_;
    if (!findings_.empty()) throw Error(Status::file, findings_.take());
    lines_.rewind();
}

template <class Item>
bool ItemReader<Item>::next(std::vector<Item>& items, std::size_t limit) {
    items.clear();
    std::string_view line;
    Item item;
    while (items.size() < limit && lines_.next(line))
        if (parse(line, item)) items.push_back(item);
    return !items.empty();
}

/// Reads a line. False: it holds no item, because it is blank or a comment, or because it is wrong, which becomes a
/// finding.
template <class Item>
bool ItemReader<Item>::parse(std::string_view line, Item& item) {
    split(line.substr(0, line.find('#')), words_);
    if (words_.empty()) return false;
    constexpr const char* names[] = {"ox", "oy", "oz", "dx", "dy", "dz"};
    const auto found = [&](int column, const std::string& fault, const char* form = form_of<Item>) {
        findings_.add(lines_.finding(column, fault, form));
        return false;
    };
    double numbers[numbers_of_item<Item>];
    for (std::size_t i = 0; i < std::size(numbers); ++i) {
        const std::string name = names[i] + (is_ray<Item> ? 0 : 1);
        if (i == words_.size())
            return found(words_.back().column + static_cast<int>(words_.back().text.size()), name + " is missing");
        auto number = parse_number(words_[i].text);
        if (!number) return found(words_[i].column, name + ": " + number_fault(words_[i].text));
        numbers[i] = *number;
    }
    if (words_.size() > std::size(numbers))
        return found(words_[std::size(numbers)].column,
                     is_ray<Item> ? "more than six numbers" : "more than three numbers");
    std::memcpy(&item, numbers, sizeof item);
    if constexpr (is_ray<Item>) {
        if (item.direction == Vec3{})
            return found(words_[3].column, "the direction is 0 0 0", "a ray needs a direction");
        bool in_direction = false;
        if (const std::string fault = ray_fault(item.origin, item.direction, in_direction); !fault.empty())
            return found(words_[in_direction ? 3 : 0].column, fault);
    } else if (const double far = largest(item); far > Limits::ray_origin) {
        return found(words_[0].column, "it has the coordinate " + number_text(far) + ", and " +
                                           number_text(Limits::ray_origin) + " mm is the farthest");
    }
    return true;
}

template class ItemReader<Ray>;
template class ItemReader<Vec3>;

}  // namespace csgrt::cli
