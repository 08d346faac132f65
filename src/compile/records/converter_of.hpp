// The converter into the precision of the namespace CSGRT_KERNELS, made by CSGRT_MAKE_CONVERTER. The .cpp file of a
// precision defines these macros and includes this header, which has all the code.
#include "compile/records/conversions.hpp"
#include "compile/records/converter.hpp"

namespace csgrt {
namespace {

template <class T>
std::vector<std::byte> bytes_of(const T* values, std::size_t count) {
    std::vector<std::byte> bytes(count * sizeof(T));
    if (count) std::memcpy(bytes.data(), values, bytes.size());
    return bytes;
}

class Converter final : public RecordConverter {
public:
    explicit Converter(const CompiledScene& scene) : records_(scene) {}

    Tables tables() const override {
        const auto bytes = [](const auto& table) { return std::as_bytes(std::span(table)); };
        return {bytes(records_.solids), bytes(records_.reals), bytes(records_.planes), bytes(records_.inner_nodes),
                bytes(records_.nodes)};
    }
    std::vector<std::byte> frame(const kernel::Frame& f) const override {
        const k::Frame& frame = convert_frame(f);
        return bytes_of(&frame, 1);
    }
    std::vector<std::byte> lights(const std::vector<kernel::LightRecord>& lights) const override {
        const auto& records = lights_of(lights);
        return bytes_of(records.data(), records.size());
    }
    void write_rays(std::span<const kernel::RayRecord> rays, std::byte* to) const override {
        for (const kernel::RayRecord& ray : rays) {
            const k::RayRecord record = convert(ray);
            std::memcpy(to, &record, sizeof record);
            to += sizeof record;
        }
    }
    void check(std::span<const kernel::RayRecord> rays, std::uint64_t first) const override { check_rays(rays, first); }
    std::size_t ray_bytes() const override { return sizeof(k::RayRecord); }
    std::size_t boundary_bytes() const override { return sizeof(k::Boundary); }
    std::size_t overlap_bytes() const override { return sizeof(k::OverlapRecord); }
    std::size_t wide_bytes() const override { return sizeof(wide); }
    std::vector<kernel::OverlapRecord> overlap_records(const std::vector<std::byte>& bytes) const override {
        std::vector<k::OverlapRecord> own(bytes.size() / sizeof(k::OverlapRecord));
        if (!own.empty()) std::memcpy(own.data(), bytes.data(), own.size() * sizeof(k::OverlapRecord));
        std::vector<kernel::OverlapRecord> overlap_records;
        for (const k::OverlapRecord& p : own)
            overlap_records.push_back({static_cast<double>(p.in), static_cast<double>(p.out), p.ray, p.node});
        return overlap_records;
    }
    std::vector<kernel::Boundary> boundaries(const std::vector<std::byte>& bytes) const override {
        std::vector<k::Boundary> boundaries(bytes.size() / sizeof(k::Boundary));
        if (!boundaries.empty()) std::memcpy(boundaries.data(), bytes.data(), bytes.size());
        return boundaries_of(std::move(boundaries));
    }

private:
    const Records records_;
};

}  // namespace

std::unique_ptr<RecordConverter> CSGRT_MAKE_CONVERTER(const CompiledScene& scene) {
    return std::make_unique<Converter>(scene);
}

}  // namespace csgrt
