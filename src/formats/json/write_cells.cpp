#include <algorithm>

#include "formats/json/cells.hpp"
#include "formats/json/names.hpp"
#include "formats/json/write_solid.hpp"
#include "scene/vector.hpp"

namespace csgrt {

namespace {

using nlohmann::ordered_json;

/// A string a row of `width` cells. Cells of 0 and 255 alone are a picture of '.' and '#'; `marks` allows that.
template <class Cell>
ordered_json json_of_cells(const std::vector<Cell>& cells, std::size_t width, bool marks) {
    const bool picture = marks && std::all_of(cells.begin(), cells.end(), [](Cell c) { return c == 0 || c == 255; });
    if (width == 0 || width > cells.size()) width = std::max<std::size_t>(cells.size(), 1);
    ordered_json rows = ordered_json::array();
    for (std::size_t begin = 0; begin < cells.size();) {
        std::string row;
        for (const std::size_t end = begin + std::min(width, cells.size() - begin); begin < end; ++begin) {
            if (picture) {
                row += cells[begin] == 0 ? '.' : '#';
            } else {
                row += (row.empty() ? "" : " ") + std::to_string(cells[begin]);
            }
        }
        rows.push_back(std::move(row));
    }
    return rows;
}

void add_placement(ordered_json& json, const Matrix& m, const LengthColumns& lengths, JsonUnit& unit) {
    if (same_bits(m, usual_placement(lengths, unit.millimetres()))) return;
    ordered_json matrix = ordered_json::array();
    for (std::size_t i = 0; i < m.size(); ++i) {
        matrix.push_back(is_length(lengths, i) ? unit.length(m[i]) : unit.number(m[i]));
    }
    json["matrix"] = std::move(matrix);
}

void add_file(ordered_json& json, const std::string& file) {
    if (!file.empty()) json["file"] = file;
}

}  // namespace

ordered_json SolidToJson::operator()(const Ebm& s) const {
    ordered_json json = {{"type", "ebm"}, {"width", s.width}, {"depth", s.depth}, {"height", unit.length(s.height)}};
    add_placement(json, s.matrix, ebm_lengths, unit);
    add_file(json, s.file);
    json["cells"] = json_of_cells(s.cells, s.width, true);
    return json;
}

ordered_json SolidToJson::operator()(const Vol& s) const {
    ordered_json json = {
        {"type", "vol"}, {"width", s.width}, {"depth", s.depth}, {"height", s.height}, {"cell", unit.lengths(s.cell)},
        {"low", s.low}};
    if (s.high != Vol().high) json["high"] = s.high;
    add_placement(json, s.matrix, vol_lengths, unit);
    add_file(json, s.file);
    json["cells"] = json_of_cells(s.cells, s.width, true);
    return json;
}

ordered_json SolidToJson::operator()(const Dsp& s) const {
    ordered_json json = {{"type", "dsp"}, {"width", s.width}, {"depth", s.depth}};
    if (s.smooth) json["smooth"] = true;
    if (s.cut != Dsp::Cut::adaptive) json["cut"] = json_dsp_cuts.at(static_cast<std::size_t>(s.cut));
    add_placement(json, s.matrix, dsp_lengths, unit);
    add_file(json, s.file);
    json["heights"] = json_of_cells(s.heights, s.width, false);
    return json;
}

}  // namespace csgrt
