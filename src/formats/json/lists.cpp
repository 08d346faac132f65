#include "formats/json/lists.hpp"

#include <cmath>

namespace csgrt {

namespace {

bool is_count(const JsonValue& value, double most, std::uint32_t& count) {
    const double* number = std::get_if<double>(&value.data);
    if (number == nullptr || !(*number >= 0 && *number <= most) || *number != std::trunc(*number)) return false;
    count = static_cast<std::uint32_t>(*number);
    return true;
}

/// Reads the cells of one string.
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

bool read_plain(const JsonValue& item, double scale, double& value) {
    const double* number = std::get_if<double>(&item.data);
    if (number != nullptr) value = scale * *number;
    return number != nullptr;
}

bool read_plain(const JsonValue& item, double scale, Vec3& value) {
    const JsonArray* array = std::get_if<JsonArray>(&item.data);
    return array != nullptr && array->size() == 3 && read_plain((*array)[0], scale, value.x) &&
           read_plain((*array)[1], scale, value.y) && read_plain((*array)[2], scale, value.z);
}

bool read_plain(const JsonValue& item, double, std::uint32_t& value) { return is_count(item, UINT32_MAX, value); }

bool read_plain(const JsonValue& item, double, std::uint8_t& value) {
    std::uint32_t count = 0;
    const bool is_byte = is_count(item, 255, count);
    value = static_cast<std::uint8_t>(count);
    return is_byte;
}

bool read_plain(const JsonValue& item, double, std::array<std::uint32_t, 3>& value) {
    const JsonArray* array = std::get_if<JsonArray>(&item.data);
    if (array == nullptr || array->size() != 3) return false;
    for (std::size_t k = 0; k < 3; ++k)
        if (!is_count((*array)[k], UINT32_MAX, value[k])) return false;
    return true;
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
