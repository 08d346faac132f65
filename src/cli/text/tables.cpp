#include "tables.hpp"

#include <array>
#include <bit>
#include <cmath>
#include <numbers>

#include "partitions.hpp"
#include "scene/vector.hpp"

namespace csgrt::cli {

static_assert(std::endian::native == std::endian::little, "append_bytes swaps no bytes");

std::string npy_header(std::string_view type, std::span<const std::uint64_t> shape) {
    constexpr std::size_t alignment = 64, most_digits = 20;
    std::string sides;
    for (const std::uint64_t side : shape) sides += std::to_string(side) + ", ";
    std::string text = "{'descr': " + std::string(type) + ", 'fortran_order': False, 'shape': (" + sides + "), }";
    constexpr std::size_t before = 10;  // bytes: the magic number, the version and the header's length
    const std::size_t longest = before + text.size() - sides.size() + shape.size() * (most_digits + 2) + 1;
    const std::size_t length = (longest + alignment - 1) / alignment * alignment - before;
    text.resize(length - 1, ' ');
    return std::string("\x93NUMPY\x01\x00", 8) + static_cast<char>(length % 256) + static_cast<char>(length / 256) +
           text + '\n';
}

void append_field(std::string& out, std::string_view text) {
    if (text.find_first_of(",\"\r\n") == text.npos) {
        out += text;
        return;
    }
    out += '"';
    for (const char c : text) {
        if (c == '"') out += c;
        out += c;
    }
    out += '"';
}

RowTable::RowTable(const Model& model, RowFormat format) : format_(format) {
    for (const RegionInfo& region : model.regions()) {
        std::string& name = names_.emplace_back();
        append_field(name, std::string_view(region.path).substr(region.path.rfind('/') + 1));
        append_field(name += ',', region.path);
        name += ',' + std::to_string(region.region_id);
        los_.push_back(region.los);
    }
}

std::string RowTable::header(std::uint64_t rows) const {
    if (format_ == RowFormat::csv)
        return "ray,reg_name,path_name,reg_id,x_in,y_in,z_in,d_in,x_out,y_out,z_out,d_out,los,scaled_los,obliq_in,"
               "obliq_out\n";
    if (format_ == RowFormat::binary) return {};
    return npy_header(
        "[('ray', '<i8'), ('region_id', '<i4'), ('in_solid', '<i4'), ('out_solid', '<i4'), ('t_in', '<f8'), "
        "('t_out', '<f8'), ('in_normal', '<f8', (3,)), ('out_normal', '<f8', (3,))]",
        std::span(&rows, 1));
}

void RowTable::append(std::string& out, std::uint64_t number, const Ray& ray, const Partitions& rows,
                      std::size_t i) const {
    const auto end = static_cast<std::size_t>(rows.ray_splits[i + 1]);
    for (auto row = static_cast<std::size_t>(rows.ray_splits[i]); row < end; ++row) {
        if (format_ == RowFormat::csv) {
            append_csv(out, number, ray, rows, row);
            continue;
        }
        const Vec3 &in = rows.in_normals[row], &out_of = rows.out_normals[row];
        append_bytes<std::uint64_t>(out, std::span(&number, 1));
        append_bytes<std::int32_t>(out, std::array{rows.region_ids[row], rows.in_solids[row], rows.out_solids[row]});
        append_bytes<double>(
            out, std::array{rows.t_in[row], rows.t_out[row], in.x, in.y, in.z, out_of.x, out_of.y, out_of.z});
    }
}

void RowTable::append_csv(std::string& out, std::uint64_t number, const Ray& ray, const Partitions& rows,
                          std::size_t row) const {
    const double unit_length = length(ray.direction), t_in = rows.t_in[row], t_out = rows.t_out[row];
    const Vec3 along = unit(ray.direction);
    const auto field = [&out](double value) { append_shortest(out += ',', value); };
    const auto point = [&](double t) {  // x, y, z and nirt's d, a coordinate that falls along the ray
        const auto coordinate = [t](double o, double d) { return d == 0 ? o : o + t * d; };
        field(coordinate(ray.origin.x, ray.direction.x));
        field(coordinate(ray.origin.y, ray.direction.y));
        field(coordinate(ray.origin.z, ray.direction.z));
        field(0 - (dot(along, ray.origin) + t * unit_length));
    };
    const auto obliquity = [&](double t, std::int32_t solid, const Vec3& normal) {
        if (solid >= 0 && std::isfinite(t))
            field(std::atan2(length(cross(along, normal)), std::abs(dot(along, normal))) * 180 / std::numbers::pi);
        else
            out += ',';
    };
    const auto region = static_cast<std::size_t>(rows.region_ids[row]);
    const double los = (t_out - t_in) * unit_length;
    (out += std::to_string(number) + ',') += names_[region];
    point(t_in);
    point(t_out);
    field(los);
    field(los_[region] == 0 ? 0 : los * los_[region] / 100);
    obliquity(t_in, rows.in_solids[row], rows.in_normals[row]);
    obliquity(t_out, rows.out_solids[row], rows.out_normals[row]);
    out += '\n';
}

}  // namespace csgrt::cli
