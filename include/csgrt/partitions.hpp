// Partitions: the parts of a ray and the regions that hold them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <new>
#include <type_traits>
#include <utility>
#include <vector>

#include <csgrt/rays.hpp>
#include <csgrt/vector.hpp>

namespace csgrt {

/// A part of a ray that one region holds.
struct Partition {
    double in = 0, out = 0;                     ///< distances t along the ray; in may be negative, both infinite
    Vec3 in_normal = {}, out_normal = {};       ///< unit vectors, outward from the region
    std::uint32_t region = 0;                   ///< index into Model::regions()
    std::uint32_t in_solid = 0, out_solid = 0;  ///< solids on whose surfaces the boundaries are: indices into
                                                ///< Model::solids()
};

/// A part of a ray that several regions of the same rank claim. Ranks are, from the first: solid regions, FASTGEN's
/// plates, FASTGEN's volumes, air. A region of an earlier rank gets a part before a region of a later rank, and this is
/// no overlap. Of several regions of the same rank, the first one in the model gets the partition.
struct Overlap {
    double in = 0, out = 0;                   ///< as in Partition
    std::vector<std::uint32_t> regions = {};  ///< indices into Model::regions(), ascending
};

/// All partitions and overlaps along one ray, in the order of distance, except partitions that end at t < 0.
/// Neighbouring partitions of one region are joined. If the ray starts inside a region, the first partition has a
/// negative `in`, where the region begins. The same holds for overlaps.
struct RayPartitions {
    std::vector<Partition> partitions = {};
    std::vector<Overlap> overlaps = {};
};

/// The fields of an answer to a list of rays, besides regions and distances.
struct Fields {
    bool solids = false;    ///< The solids on whose surfaces the boundaries are.
    bool normals = false;   ///< Unit normals at the boundaries, outward from the region.
    bool overlaps = false;  ///< The parts of rays that several regions claim.
    /// False: regions that pictures do not show (State) are left out. First hits never have them.
    bool hidden = true;
};

/// An array of numbers in memory of malloc. It grows without a copy if the system can move pages, and keeps its memory
/// until it is destroyed. Values that resize() adds are undefined.
template <class T>
class Array {
    static_assert(std::is_trivially_copyable_v<T>);

public:
    Array() = default;
    Array(Array&& other) noexcept
        : data_(std::exchange(other.data_, nullptr)),
          size_(std::exchange(other.size_, 0)),
          room_(std::exchange(other.room_, 0)) {}
    Array& operator=(Array&& other) noexcept {
        std::swap(data_, other.data_);
        std::swap(size_, other.size_);
        std::swap(room_, other.room_);
        return *this;
    }
    ~Array() { std::free(data_); }

    T* data() noexcept { return data_; }
    const T* data() const noexcept { return data_; }
    std::size_t size() const noexcept { return size_; }
    bool empty() const noexcept { return size_ == 0; }
    T* begin() noexcept { return data_; }
    T* end() noexcept { return data_ + size_; }
    const T* begin() const noexcept { return data_; }
    const T* end() const noexcept { return data_ + size_; }
    T& operator[](std::size_t i) noexcept { return data_[i]; }
    const T& operator[](std::size_t i) const noexcept { return data_[i]; }

    /// Throws std::bad_alloc, and changes nothing then.
    void resize(std::size_t size) {
        if (size > room_) {
            const std::size_t room = size > room_ + room_ / 2 ? size : room_ + room_ / 2;
            void* const data = std::realloc(static_cast<void*>(data_), room * sizeof(T));
            if (!data) throw std::bad_alloc();
            data_ = static_cast<T*>(data);
            room_ = room;
        }
        size_ = size;
    }

private:
    T* data_ = nullptr;
    std::size_t size_ = 0, room_ = 0;
};

/// The partitions and overlaps along a list of rays, as arrays. A row is one partition; neighbouring partitions of one
/// region are one row. Ray i has the rows [ray_splits[i], ray_splits[i + 1]), in order of distance. Rows are cut at the
/// ray's range: a cut has the range's limit as its distance, -1 as its solid and zeros as its normal. Rows outside the
/// range are left out. If the range is one point, the answer has the row that begins or goes on at the point, and not
/// the row that ends there.
struct Partitions {
    Array<std::int64_t> ray_splits = {};                  ///< (rays + 1)
    Array<std::int32_t> region_ids = {};                  ///< (rows), indices into Model::regions()
    Array<double> t_in = {}, t_out = {};                  ///< (rows), distances in lengths of the ray's direction
    Array<std::int32_t> in_solids = {}, out_solids = {};  ///< (rows), if asked for: indices into Model::solids()
    Array<Vec3> in_normals = {}, out_normals = {};  ///< (rows), if asked for: unit vectors, outward from the region
    // If asked for: parts of rays that several regions of one rank claim (see Overlap), in the same form.
    Array<std::int64_t> overlap_splits = {};              ///< (rays + 1)
    Array<double> overlap_t_in = {}, overlap_t_out = {};  ///< (overlaps)
    Array<std::int64_t> overlap_region_splits = {};       ///< (overlaps + 1)
    Array<std::int32_t> overlap_region_ids = {};          ///< all claimants of an overlap, ascending
};

/// The hit that a picture shows at a pixel, and the partitions along the pixel's ray.
struct Pick {
    std::int32_t region = -1, solid = -1;  ///< indices into Model::regions() and solids(); -1: nothing
    double t = 0;                          ///< distance along the ray, in lengths of its direction
    Vec3 point = {}, normal = {};          ///< millimetres; a unit vector, outward from the region
    Ray ray = {};
    RayPartitions along = {};  ///< partitions of all regions, also hidden ones; as in Renderer::shoot()
};

/// The first hits of a list of rays: for each ray, the first row of its Partitions without hidden regions.
struct Hits {
    Array<double> t_hit = {};             ///< (rays), distances in lengths of the ray's direction; infinity: no hit
    Array<std::int32_t> region_ids = {};  ///< (rays), indices into Model::regions(); -1: no hit
    /// (rays), if asked for: the solid whose surface is hit, an index into Model::solids(); -1: no hit, or the range
    /// begins inside the region.
    Array<std::int32_t> solid_ids = {};
    Array<Vec3> normals = {};  ///< (rays), if asked for: unit vectors, outward from the region; zeros where solid is -1
};

}  // namespace csgrt
