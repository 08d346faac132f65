#include <algorithm>

#include "formats/json/cells.hpp"
#include "formats/json/lists.hpp"
#include "formats/json/names.hpp"
#include "formats/json/placement.hpp"
#include "formats/json/solid_readers.hpp"

namespace csgrt {

namespace {

Matrix read_placement(const JsonNode& node, const LengthColumns& lengths) {
    const double unit = node.file().unit;
    if (!node.present()) return usual_placement(lengths, unit);
    Matrix m = read_json_matrix(node);
    for (std::size_t i = 0; i < m.size(); ++i) {
        if (is_length(lengths, i)) m[i] *= unit;
    }
    return m;
}

std::vector<std::uint8_t> read_bytes(const JsonNode& node) {
    const std::vector<std::uint16_t> cells = read_json_cells(node, 255, true);
    std::vector<std::uint8_t> bytes(cells.size());
    std::transform(cells.begin(), cells.end(), bytes.begin(),
                   [](std::uint16_t c) { return static_cast<std::uint8_t>(c); });
    return bytes;
}

}  // namespace

Shape read_json_ebm(const JsonObject& o) {
    Ebm solid;
    solid.file = o["file"].string();
    solid.width = o["width"].count();
    solid.depth = o["depth"].count();
    solid.height = o["height"].length();
    solid.matrix = read_placement(o["matrix"], ebm_lengths);
    solid.cells = read_bytes(o["cells"]);
    return solid;
}

Shape read_json_vol(const JsonObject& o) {
    Vol solid;
    solid.file = o["file"].string();
    solid.width = o["width"].count();
    solid.depth = o["depth"].count();
    solid.height = o["height"].count();
    solid.low = static_cast<std::uint8_t>(o["low"].integer(0, 255, solid.low));
    solid.high = static_cast<std::uint8_t>(o["high"].integer(0, 255, solid.high));
    solid.cell = o["cell"].lengths();
    solid.matrix = read_placement(o["matrix"], vol_lengths);
    solid.cells = read_bytes(o["cells"]);
    return solid;
}

Shape read_json_dsp(const JsonObject& o) {
    Dsp solid;
    solid.file = o["file"].string();
    solid.width = o["width"].count();
    solid.depth = o["depth"].count();
    solid.smooth = o["smooth"].boolean(solid.smooth);
    solid.cut = static_cast<Dsp::Cut>(o["cut"].choice(json_dsp_cuts, 0));
    solid.matrix = read_placement(o["matrix"], dsp_lengths);
    solid.heights = read_json_cells(o["heights"], 65535, false);
    return solid;
}

}  // namespace csgrt
