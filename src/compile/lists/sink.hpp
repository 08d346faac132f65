// Rows of batches that end in any order -> the caller's arrays.
#pragma once

#include <condition_variable>
#include <cstdint>
#include <map>
#include <mutex>

#include "compile/lists/rows.hpp"

namespace csgrt {

/// Who takes the rows of a list's batches.
class RowTaker {
public:
    explicit RowTaker(Fields fields, bool first_row = false) : fields_(fields), first_row_(first_row) {}
    RowTaker(const RowTaker&) = delete;
    RowTaker& operator=(const RowTaker&) = delete;
    virtual ~RowTaker() = default;

    Fields fields() const { return fields_; }
    /// Whether it takes of each ray the first row alone.
    bool first_row() const { return first_row_; }
    /// Any thread. Copies what the caller may then use again.
    virtual void put(const RowView& rows) = 0;
    /// A batch will not come: nobody waits for it any more.
    virtual void stop() {}
    /// Whether all that was put of a ray are the rows of another one, to the last bit.
    virtual bool has(std::uint64_t ray, const Partitions& rows, std::size_t other) const = 0;
    /// Calls make(), which is to put a batch; if it throws, the batch will not come.
    template <class Make>
    void guard(const Make& make) {
        try {
            make();
        } catch (...) {
            stop();
            throw;
        }
    }

private:
    const Fields fields_;
    const bool first_row_;
};

/// Puts rows in the order of the rays.
class RowSink final : public RowTaker {
public:
    /// Empties the arrays. `rays`: how many there will be. `rows` must outlive this.
    RowSink(Partitions& rows, Fields fields, std::uint64_t rays);

    /// Waits while too much is kept that earlier rays must come before; the batch that all wait for never does.
    void put(const RowView& rows) override;
    void stop() override;
    bool has(std::uint64_t ray, const Partitions& rows, std::size_t other) const override;

private:
    void append(const RowView& rows);

    Partitions& answer_;
    std::mutex mutex_;
    std::condition_variable moved_;
    std::uint64_t next_ = 0;  ///< the ray whose rows come next
    std::map<std::uint64_t, RowMemory> kept_;
    std::size_t kept_bytes_ = 0;
    bool is_stopped_ = false;
};

/// What is wanted of the first row of each ray; null: not that.
struct HitArrays {
    Array<std::int32_t>* regions = nullptr;
    Array<double>* distances = nullptr;
    Array<std::int32_t>* solids = nullptr;
    Array<Vec3>* normals = nullptr;
    Array<std::uint8_t>* hits = nullptr;  ///< 1: there is one
};

/// Takes the first row of each ray.
class HitSink final : public RowTaker {
public:
    /// Sizes the arrays, which must outlive this.
    HitSink(const HitArrays& arrays, std::uint64_t rays);

    void put(const RowView& rows) override;
    bool has(std::uint64_t ray, const Partitions& rows, std::size_t other) const override;

private:
    const HitArrays to_;
};

/// Takes the pixels of a slice: of each ray a row of them, the length of whose direction is a pixel's.
class PixelSink final : public RowTaker {
public:
    static constexpr std::int32_t nothing = -1, overlap = -2;

    /// Sizes the array, which must outlive this.
    PixelSink(Array<std::int32_t>& pixels, std::uint32_t width, std::uint64_t rays);

    void put(const RowView& rows) override;
    bool has(std::uint64_t ray, const Partitions& rows, std::size_t other) const override;

private:
    void fill(std::int32_t* line, double in, double out, std::int32_t value) const;

    Array<std::int32_t>& pixels_;
    const std::uint32_t width_;
};

}  // namespace csgrt
