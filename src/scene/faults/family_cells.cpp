#include <algorithm>
#include <cmath>

#include "scene/faults/families.hpp"

namespace csgrt {

namespace {

void check_placement(Faults& faults, const Matrix& m) {
    const auto far = std::find_if(m.begin(), m.end(), [](double x) { return !(std::abs(x) <= Limits::length); });
    if (far != m.end()) {
        faults.push_back("the matrix has a number that is not finite, or far too large: " + number_text(*far) + "; " +
                         length_limit());
    } else if (m[12] != 0 || m[13] != 0 || m[14] != 0 || m[15] != 1) {
        faults.push_back("the matrix must end in the row 0 0 0 1");
    } else if (dependent({m[0], m[4], m[8]}, {m[1], m[5], m[9]}, {m[2], m[6], m[10]})) {
        faults.push_back("the matrix is singular: it flattens the cells");
    }
}

/// Adds a fault and returns false unless the number of cells is the product of the sizes.
bool check_count(Faults& faults, const std::vector<std::uint32_t>& size, std::size_t cells, const std::string& what) {
    std::uint64_t product = 1;
    std::string text;
    for (const std::uint32_t extent : size) {
        if (extent == 0) {
            faults.push_back("width, depth and height must be greater than 0");
            return false;
        }
        product = product > UINT64_MAX / extent ? UINT64_MAX : product * extent;
        text += (text.empty() ? "" : " x ") + std::to_string(extent);
    }
    if (product > Limits::cells) {
        faults.push_back("it is " + text + " " + what + " large; at most " + std::to_string(Limits::cells) +
                         " are supported");
    } else if (product != cells) {
        faults.push_back(text + " are " + std::to_string(product) + " " + what + ", found " + std::to_string(cells));
    }
    return product <= Limits::cells && product == cells;
}

}  // namespace

void check_further(Faults& faults, const Ebm& s) {
    check_placement(faults, s.matrix);
    if (check_count(faults, {s.width, s.depth}, s.cells.size(), "cells") &&
        std::all_of(s.cells.begin(), s.cells.end(), [](std::uint8_t c) { return c == 0; })) {
        faults.push_back("none of its cells is solid");
    }
}

void check_further(Faults& faults, const Vol& s) {
    for (const double side : {s.cell.x, s.cell.y, s.cell.z}) {
        if (side > 0) continue;
        faults.push_back("the sides of a cell must be greater than 0");
        break;
    }
    check_placement(faults, s.matrix);
    if (s.low > s.high) {
        faults.push_back("the lowest value of a solid cell must not be greater than the highest");
    } else if (check_count(faults, {s.width, s.depth, s.height}, s.cells.size(), "cells") &&
               std::none_of(s.cells.begin(), s.cells.end(),
                            [&](std::uint8_t c) { return c >= s.low && c <= s.high; })) {
        faults.push_back("none of its cells is solid");
    }
}

void check_further(Faults& faults, const Dsp& s) {
    check_placement(faults, s.matrix);
    if (s.width == 1 || s.depth == 1) {
        faults.push_back("a terrain needs two heights or more along each side");
    } else if (check_count(faults, {s.width, s.depth}, s.heights.size(), "heights") &&
               std::all_of(s.heights.begin(), s.heights.end(), [](std::uint16_t height) { return height == 0; })) {
        faults.push_back("all of its heights are 0: there is no volume");
    }
}

}  // namespace csgrt
