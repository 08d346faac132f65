// Row receivers: copy the rows of batches, which arrive in any order, into the caller's arrays.
#pragma once

#include <condition_variable>
#include <cstdint>
#include <map>
#include <mutex>

#include "rays/rows.hpp"

namespace csgrt {

/// The receiver of the rows of a list's batches.
class RowReceiver {
public:
    explicit RowReceiver(Fields fields, bool first_row = false) : fields_(fields), first_row_(first_row) {}
    RowReceiver(const RowReceiver&) = delete;
    RowReceiver& operator=(const RowReceiver&) = delete;
    virtual ~RowReceiver() = default;

    Fields fields() const { return fields_; }
    /// Whether the receiver takes only the first row of each ray.
    bool first_row() const { return first_row_; }
    /// Copies a batch's rows; then the caller may use the memory again. Any thread.
    virtual void put(const RowView& rows) = 0;
    /// Called when a batch will not arrive, so that no thread waits for it.
    virtual void stop() {}
    /// Whether the rows that were received for `ray` are equal to the rows of ray `other` in `rows`, to the last bit.
    virtual bool has(std::uint64_t ray, const Partitions& rows, std::size_t other) const = 0;
    /// Calls make(), which has to put a batch. If make() throws, calls stop().
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

/// The collector writes rows to the caller's arrays in the order of the rays.
class RowCollector final : public RowReceiver {
public:
    /// Empties the arrays. `rays`: the number of rays of the list. `rows` must outlive the object.
    RowCollector(Partitions& rows, Fields fields, std::uint64_t rays);

    /// Copies the rows. Rows whose earlier rays are missing are kept; if too many are kept, the call waits. The batch
    /// that comes next in order never waits.
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

/// Arrays for the first row of each ray; null: the array is not wanted.
struct HitArrays {
    Array<std::int32_t>* regions = nullptr;
    Array<double>* distances = nullptr;
    Array<std::int32_t>* solids = nullptr;
    Array<Vec3>* normals = nullptr;
    Array<std::uint8_t>* hits = nullptr;  ///< 1: the ray has a row
};

/// The collector takes the first row of each ray.
class HitCollector final : public RowReceiver {
public:
    /// Resizes the arrays, which must outlive the object.
    HitCollector(const HitArrays& arrays, std::uint64_t rays);

    void put(const RowView& rows) override;
    bool has(std::uint64_t ray, const Partitions& rows, std::size_t other) const override;

private:
    const HitArrays to_;
};

/// The collector fills the pixels of a slice: each ray is a row of pixels, and its direction has the length of a pixel.
class PixelCollector final : public RowReceiver {
public:
    static constexpr std::int32_t nothing = -1, overlap = -2;

    /// Resizes the array, which must outlive the object.
    PixelCollector(Array<std::int32_t>& pixels, std::uint32_t width, std::uint64_t rays);

    void put(const RowView& rows) override;
    bool has(std::uint64_t ray, const Partitions& rows, std::size_t other) const override;

private:
    void fill(std::int32_t* line, double in, double out, std::int32_t value) const;

    Array<std::int32_t>& pixels_;
    const std::uint32_t width_;
};

}  // namespace csgrt
