// Model: a compiled scene, which Renderers draw, and which can trace single rays itself.
#pragma once

#include <algorithm>
#include <compare>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <csgrt/partitions.hpp>
#include <csgrt/scene.hpp>
#include <csgrt/settings.hpp>
#include <csgrt/view.hpp>

namespace csgrt {

struct CompiledScene;  // of the library

/// A list in chunks, which its copies share until one of them changes an element. So a Model shares with the Model that
/// it was edited from what the edit left alone. Elements stay in place as long as a copy of the list does.
template <class T>
class SharedList {
public:
    using value_type = T;
    static constexpr std::size_t chunk_size = 256;  ///< elements

    class const_iterator {
    public:
        using value_type = T;
        using difference_type = std::ptrdiff_t;
        using iterator_category = std::random_access_iterator_tag;
        using pointer = const T*;
        using reference = const T&;

        const_iterator() = default;
        const_iterator(const SharedList& list, difference_type at) : list_(&list), at_(at) {}
        reference operator*() const { return (*list_)[static_cast<std::size_t>(at_)]; }
        pointer operator->() const { return &**this; }
        reference operator[](difference_type n) const { return *(*this + n); }
        const_iterator& operator+=(difference_type n) { return at_ += n, *this; }
        const_iterator& operator-=(difference_type n) { return at_ -= n, *this; }
        const_iterator& operator++() { return *this += 1; }
        const_iterator& operator--() { return *this -= 1; }
        const_iterator operator++(int) { return {*list_, at_++}; }
        const_iterator operator--(int) { return {*list_, at_--}; }
        friend const_iterator operator+(const_iterator a, difference_type n) { return a += n; }
        friend const_iterator operator+(difference_type n, const_iterator a) { return a += n; }
        friend const_iterator operator-(const_iterator a, difference_type n) { return a -= n; }
        friend difference_type operator-(const_iterator a, const_iterator b) { return a.at_ - b.at_; }
        friend bool operator==(const_iterator a, const_iterator b) { return a.at_ == b.at_; }
        friend auto operator<=>(const_iterator a, const_iterator b) { return a.at_ <=> b.at_; }

    private:
        const SharedList* list_ = nullptr;
        difference_type at_ = 0;
    };
    using iterator = const_iterator;

    SharedList() = default;
    explicit SharedList(std::size_t size) : chunks_((size + chunk_size - 1) / chunk_size), size_(size) {}

    std::size_t size() const noexcept { return size_; }
    bool empty() const noexcept { return size_ == 0; }
    const T& operator[](std::size_t i) const noexcept { return (*chunks_[i / chunk_size])[i % chunk_size]; }
    const T& front() const noexcept { return (*this)[0]; }
    const T& back() const noexcept { return (*this)[size_ - 1]; }
    const_iterator begin() const noexcept { return {*this, 0}; }
    const_iterator end() const noexcept { return {*this, static_cast<std::ptrdiff_t>(size_)}; }
    operator std::vector<T>() const { return {begin(), end()}; }

    /// An element for changing: no copy shares its chunk any more. Several threads may change different chunks.
    T& own(std::size_t i) {
        Chunk& chunk = chunks_[i / chunk_size];
        if (!chunk)
            chunk = std::make_shared<std::vector<T>>(std::min(chunk_size, size_ - i / chunk_size * chunk_size));
        else if (chunk.use_count() > 1)
            chunk = std::make_shared<std::vector<T>>(*chunk);
        return (*chunk)[i % chunk_size];
    }
    std::size_t chunk_count() const noexcept { return chunks_.size(); }
    /// The elements of a chunk, whose address tells whether lists share it.
    std::span<const T> chunk(std::size_t number) const noexcept { return *chunks_[number]; }

private:
    using Chunk = std::shared_ptr<std::vector<T>>;
    std::vector<Chunk> chunks_;  ///< null: not made yet
    std::size_t size_ = 0;
};

/// One region of the compiled model.
struct RegionInfo {
    /// "/top/.../region": the members on the way down, by their names. No other region has the same path, and edits
    /// of other regions do not change it: it is the key of the region in a later Model.
    std::string path = {};
    Fastgen fastgen = Fastgen::none;  ///< None, plate or volume, as in FASTGEN.
    int region_id = 0;                ///< BRL-CAD's number of the region, which is not its index.
    int air = 0;                      ///< BRL-CAD's number of the air; other than 0: a region of air.
    int material_id = 0;              ///< BRL-CAD's number of the material.
    int los = 0;                      ///< BRL-CAD's attribute los, percent; kept for conversion.
    Vec3 color{1, 1, 1};              ///< Display values: red, green, blue; 0 to 1.
    Finish finish = {};
    State state = State::shown;  ///< Whether pictures show it.
    Box bounds = {};             ///< Millimetres; as BRL-CAD computes it, so not always tight.
};

/// One solid of the compiled model.
struct SolidInfo {
    std::string name = {};    ///< Name of the object.
    std::string type = {};    ///< BRL-CAD's name of the type: ell, tgc, arb8, and so on.
    std::uint32_t piece = 0;  ///< Index, from 0, among the solids into which csgrt cuts a pipe.
};

/// An object in a tree: a member of a combination, or an object that is rendered.
struct ChildInfo {
    std::string path = {};    ///< The way down to it, "/top/.../name": what Edit and placement_of() take.
    std::string name = {};    ///< The last part of the path.
    std::string object = {};  ///< The object's name, which several members may have.
    std::string type = {};    ///< "combination", "region", or BRL-CAD's name of the solid's type: ell, tgc, and so on.
    /// What joins it to the children before it, as BRL-CAD lists a tree; a union for the first.
    Operator op = Operator::union_;
};

/// A compiled scene. It never changes, so any number of threads and Renderers may use it. Copies share the compiled
/// model. A child of fork() may use a Model of its parent.
class CSGRT_API Model {
public:
    /// Validates and compiles `scene`, and keeps it for edits (see Edit). `objects` are names, or paths such as
    /// "all.g/tor.r", whose object has the transform and the attributes of this instance; none: the scene's top
    /// objects. Of the settings, only air, skip_unsupported, display_shading, max_instances, the tolerance and
    /// `threads` have an effect. Throws Error: scene, usage.
    explicit Model(Scene scene, const std::vector<std::string>& objects = {}, const Settings& settings = {});

    // The references are valid as long as any copy of the Model.

    /// The box around the boxes of all regions, in millimetres; low > high if no region is bounded.
    const Box& bounds() const;
    /// The regions. Partitions::region_ids are indices into this list.
    const SharedList<RegionInfo>& regions() const;
    /// The index of the region that has a path; -1: none has.
    std::int32_t region(const std::string& path) const;
    /// The indices of the region at a path and of all regions below it. "/": of all. None if the path leads to none.
    std::vector<std::uint32_t> regions(const std::string& path) const;
    /// The solids. Partitions::in_solids are indices into this list.
    const SharedList<SolidInfo>& solids() const;
    /// A solid's type and parameters in the world: those of its object after all matrices above it. None if the type
    /// has lists of points, triangles, curves or cells, or if the matrices give the solid a form that its type does not
    /// have, as a torus that is scaled along one axis. Throws Error (usage) if there is no such solid.
    std::optional<Shape> solid(std::size_t index) const;
    /// Faults that the scene's reader tolerated, objects that were left out, and other notes, each once per object and
    /// reason. The attribute csgrt:warnings of pictures has the first warnings.
    const std::vector<Warning>& warnings() const;
    /// Millimetres: boundaries along a ray that are closer than this count as one. See Settings::tolerance_rule.
    double tolerance() const;
    /// The scene with all edits. A Model compiled from it is the same as this one.
    Scene scene() const;

    // The next functions tell the positions of regions, and of all objects above and below them. They take a path as
    // Edit does, and throw Error (usage) if it leads to no object.

    /// The matrix of a path's last member, in its parent: what Edit::set_matrix() sets.
    Matrix matrix_of(const std::string& path) const;
    /// The product of all matrices on the way down a path: from the object's coordinates to the world's. Edit::move()
    /// multiplies it.
    Matrix placement_of(const std::string& path) const;
    /// The members of a combination, in the order of its tree; of a solid none. "/": the objects that are rendered.
    std::vector<ChildInfo> children(const std::string& path = "/") const;

    /// The rays of a whole view in double precision, one for each pixel. Throws Error (usage).
    RayGrid grid_of(const View& view) const;
    /// The ray of a pixel of the picture, counted from its top left. Throws Error (usage).
    Ray ray_of(const View& view, int column, int row) const {
        const PixelRectangle part = view.part.value_or(PixelRectangle{});
        return grid_of(view).ray(part.left + column, part.top + row);
    }

    /// The hit at a pixel, counted from the top left. It has the bits of a picture in double precision. Computed on the
    /// calling thread, as are the next five functions. Throws Error: usage, out_of_memory.
    Pick pick(const View& view, int column, int row) const;

    // The next five functions do the same as a Renderer's, but only on the calling thread, for single rays and short
    // lists. Their answers have the bits of a Renderer in double precision with the settings of the Model. They use the
    // native device's kernels, or the reference if these are missing. They throw Error (usage, out_of_memory).

    void partitions(const Rays& rays, Partitions& answer, Fields fields = {}, const RayRanges& ranges = {}) const;
    void cast_rays(const Rays& rays, Hits& answer, Fields fields = {}, const RayRanges& ranges = {}) const;
    void occluded(const Rays& rays, Array<std::uint8_t>& answer, const RayRanges& ranges = {}) const;
    void region_at(std::span<const Vec3> points, Array<std::int32_t>& answer) const;
    void slice(const Slice& slice, Array<std::int32_t>& answer) const;

private:
    friend class Renderer;
    friend class Edit;
    friend const CompiledScene& compiled_scene(const Model& model);
    struct Impl;
    explicit Model(std::shared_ptr<const Impl> impl) : impl_(std::move(impl)) {}
    std::shared_ptr<const Impl> impl_;
};

}  // namespace csgrt
