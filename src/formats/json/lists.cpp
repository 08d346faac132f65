#include "formats/json/lists.hpp"

#include <cmath>

namespace csgrt {

namespace {

/// Reads each item by `fast`, which gives nothing if the item is not as it should be, and then by `slow`, which says
/// why.
template <class T, class Fast, class Slow>
std::vector<T> read_list(const JsonNode& list, Fast fast, Slow slow) {
    std::vector<T> values;
    if (!list.is_array()) {
        list.items();  // says that it is none, if it is there at all
        return values;
    }
    const JsonArray& array = std::get<JsonArray>(list.value()->data);
    values.reserve(array.size());
    for (const JsonValue& item : array) {
        T value{};
        if (!fast(item, value)) {
            value = slow(JsonNode(list.file(), &item, list.pointer() + '/' + std::to_string(values.size())));
        }
        values.push_back(value);
    }
    return values;
}

bool is_count(const JsonValue& value, double most, std::uint32_t& count) {
    const double* number = std::get_if<double>(&value.data);
    if (number == nullptr || !(*number >= 0 && *number <= most) || *number != std::trunc(*number)) return false;
    count = static_cast<std::uint32_t>(*number);
    return true;
}

/// The cells of one string.
class CellText {
public:
    CellText(const JsonNode& node, std::uint16_t most, bool marks) : node_(node), most_(most), marks_(marks) {}

    void append_to(std::vector<std::uint16_t>& cells) const {
        const std::string text = node_.string();
        for (std::size_t i = 0; i < text.size();) {
            const char c = text[i];
            if (c == ' ') {
                ++i;
            } else if (marks_ && (c == '.' || c == '#')) {
                cells.push_back(c == '#' ? most_ : std::uint16_t{0});
                ++i;
            } else {
                std::uint32_t value = 0;
                const std::size_t begin = i;
                for (; i < text.size() && text[i] >= '0' && text[i] <= '9' && value <= most_; ++i) {
                    value = 10 * value + static_cast<std::uint32_t>(text[i] - '0');
                }
                if (i == begin || value > most_) return complain(begin);
                cells.push_back(static_cast<std::uint16_t>(value));
            }
        }
    }

private:
    void complain(std::size_t at) const {
        node_.fault("character " + std::to_string(at + 1) + " begins no cell: expected numbers from 0 to " +
                        std::to_string(most_) + " with blanks between them",
                    marks_ ? "'.' stands for 0 and '#' for " + std::to_string(most_) : "");
    }

    const JsonNode& node_;
    const std::uint16_t most_;
    const bool marks_;
};

}  // namespace

std::vector<double> read_json_numbers(const JsonNode& list) {
    return read_list<double>(
        list,
        [](const JsonValue& item, double& value) {
            const double* number = std::get_if<double>(&item.data);
            if (number != nullptr) value = *number;
            return number != nullptr;
        },
        [](const JsonNode& item) { return item.number(); });
}

std::vector<std::uint32_t> read_json_counts(const JsonNode& list) {
    return read_list<std::uint32_t>(
        list, [](const JsonValue& item, std::uint32_t& value) { return is_count(item, UINT32_MAX, value); },
        [](const JsonNode& item) { return item.count(); });
}

std::vector<std::uint8_t> read_json_bytes(const JsonNode& list) {
    return read_list<std::uint8_t>(
        list,
        [](const JsonValue& item, std::uint8_t& value) {
            std::uint32_t count = 0;
            const bool is_byte = is_count(item, 255, count);
            value = static_cast<std::uint8_t>(count);
            return is_byte;
        },
        [](const JsonNode& item) { return static_cast<std::uint8_t>(item.integer(0, 255, 0)); });
}

std::vector<Vec3> read_json_vectors(const JsonNode& list, double scale) {
    return read_list<Vec3>(
        list,
        [scale](const JsonValue& item, Vec3& value) {
            const JsonArray* array = std::get_if<JsonArray>(&item.data);
            if (array == nullptr || array->size() != 3) return false;
            double numbers[3];
            for (std::size_t k = 0; k < 3; ++k) {
                const double* number = std::get_if<double>(&(*array)[k].data);
                if (number == nullptr) return false;
                numbers[k] = scale * *number;
            }
            value = {numbers[0], numbers[1], numbers[2]};
            return true;
        },
        [](const JsonNode& item) { return item.vector(); });
}

std::vector<std::array<std::uint32_t, 3>> read_json_triangles(const JsonNode& list) {
    using Triangle = std::array<std::uint32_t, 3>;
    return read_list<Triangle>(
        list,
        [](const JsonValue& item, Triangle& value) {
            const JsonArray* array = std::get_if<JsonArray>(&item.data);
            if (array == nullptr || array->size() != 3) return false;
            for (std::size_t k = 0; k < 3; ++k) {
                if (!is_count((*array)[k], UINT32_MAX, value[k])) return false;
            }
            return true;
        },
        [](const JsonNode& item) {
            const std::vector<JsonNode> corners = item.items();
            if (item.is_array() && corners.size() != 3) {
                item.fault("expected 3 indices, found " + std::to_string(corners.size()));
            }
            for (const JsonNode& corner : corners) corner.count();
            return Triangle{};
        });
}

std::vector<std::uint16_t> read_json_cells(const JsonNode& list, std::uint16_t most, bool marks) {
    std::vector<std::uint16_t> cells;
    if (list.is_string()) {
        CellText(list, most, marks).append_to(cells);
    } else if (list.present()) {
        for (const JsonNode& item : list.items()) CellText(item, most, marks).append_to(cells);
    }
    return cells;
}

}  // namespace csgrt
