#include "formats/brlcad/points.hpp"

#include <span>
#include <string>
#include <vector>

#include "formats/brlcad/g/bytes.hpp"
#include "formats/brlcad/v5/parameters.hpp"
#include "formats/brlcad/values.hpp"

namespace csgrt {

namespace {

// Bits of the type: the values of each point besides its position, in this order.
constexpr int with_color = 1, with_scale = 2, with_normal = 4;
constexpr int last_type = with_color | with_scale | with_normal;

std::size_t numbers_of(int type) {
    return 3u + ((type & with_color) != 0 ? 3 : 0) + ((type & with_scale) != 0 ? 1 : 0) +
           ((type & with_normal) != 0 ? 3 : 0);
}

/// Adds a point. Its own scale, or else the scale of all points, is the radius of its ball. A point without a scale
/// above 0 is only counted.
void add_point(BrlcadPoints& points, int type, double scale, std::span<const double> numbers) {
    const std::size_t scale_at = (type & with_color) != 0 ? 6 : 3;
    const double radius = (type & with_scale) != 0 ? numbers[scale_at] : scale;
    if (radius > 0) {
        points.balls.push_back({{numbers[0], numbers[1], numbers[2]}, radius});
    } else {
        ++points.without_scale;
    }
}

}  // namespace

BrlcadPoints read_v5_points(Parameters& p) {
    if (p.has("count")) p.take("count");  // ignored, as BRL-CAD does: the list `data` has its own length
    const int type = p.has("type") ? p.integer("type", 0, last_type) : 0;
    const double scale = p.has("scale") ? p.number("scale") : 0;
    BrlcadPoints points;
    if (!p.has("data")) return points;
    TclList list(p.take("data"), p.store());
    std::vector<double> numbers;
    for (TclWord point; list.next(point);) {
        numbers.clear();
        TclList elements(point, p.store());
        for (TclWord element; elements.next(element);) numbers.push_back(read_number(element.text, element.offset));
        if (numbers.size() != numbers_of(type)) {
            throw Fault{point.offset,
                        "a point of type " + std::to_string(type) + " has " + std::to_string(numbers_of(type)) +
                            " numbers, not " + std::to_string(numbers.size()),
                        {}};
        }
        add_point(points, type, scale, numbers);
    }
    return points;
}

BrlcadPoints read_g_points(ByteReader& bytes) {
    const double scale = bytes.real("the points' scale");
    const std::size_t type_at = bytes.offset();
    const std::uint64_t type = bytes.number(1, "the points' type");
    if (type > last_type) throw Fault{type_at, std::to_string(type) + " is no type of points", "types are 0 to 7"};
    const std::size_t size = numbers_of(static_cast<int>(type));
    const std::uint32_t count = bytes.count(size * real_size, "the number of points");
    BrlcadPoints points;
    std::vector<double> numbers(size);
    for (std::uint32_t i = 0; i < count; ++i) {
        for (double& number : numbers) number = bytes.real("a number of a point");
        add_point(points, static_cast<int>(type), scale, numbers);
    }
    return points;
}

}  // namespace csgrt
