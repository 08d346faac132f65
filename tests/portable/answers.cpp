// csgrt_answers SIZE FILE...: what csgrt answers, one line of text for each subject: hashes of the compiled scene and
// of every bit of its pictures (first hits and every partition) and of the partitions along rays. Subjects are the
// scenes of the files and samples of the stress suite. The native device and the reference answer; if they differ the
// line says so, and the program fails. Two builds of csgrt, say for two processors, agree if they write the same text
// for each scene that both compile to the same numbers (aarch64_test.cmake).
#include <bit>
#include <cinttypes>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

#include <csgrt/csgrt.hpp>

#include "compile/compiled_scene.hpp"
#include "compile/hash.hpp"
#include "stress/families.hpp"

namespace {

using namespace csgrt;

/// FNV-1a. Numbers by their bits: 0 and -0 differ.
class Hash {
public:
    void add(double value) { add(std::bit_cast<std::uint64_t>(value)); }
    void add(float value) { add(std::uint64_t{std::bit_cast<std::uint32_t>(value)}); }
    void add(const Vec3& v) {
        for (const double value : {v.x, v.y, v.z}) add(value);
    }
    void add(std::uint64_t bits) {
        for (int byte = 0; byte < 8; ++byte) value_ = (value_ ^ (bits >> (8 * byte) & 0xff)) * 0x100000001b3u;
    }
    std::uint64_t value() const { return value_; }

private:
    std::uint64_t value_ = 0xcbf29ce484222325u;
};

std::uint64_t hash_of(const Image& image) {
    Hash hash;
    for (std::size_t channel = 0; channel < image.channels.size(); ++channel)
        for (const float value : image.channels[channel]) hash.add(value);
    return hash.value();
}

std::uint64_t hash_of(const std::vector<RayPartitions>& rays) {
    Hash hash;
    for (const RayPartitions& ray : rays) {
        hash.add(std::uint64_t{ray.partitions.size()});
        for (const Partition& p : ray.partitions) {
            for (const double value : {p.in, p.out}) hash.add(value);
            for (const Vec3& normal : {p.in_normal, p.out_normal}) hash.add(normal);
            for (const std::uint32_t number : {p.region, p.in_solid, p.out_solid}) hash.add(std::uint64_t{number});
        }
        for (const Overlap& overlap : ray.overlaps) {
            for (const double value : {overlap.in, overlap.out}) hash.add(value);
            for (const std::uint32_t region : overlap.regions) hash.add(std::uint64_t{region});
        }
    }
    return hash.value();
}

struct Subject {
    std::string name;
    Scene scene;
    std::vector<std::string> objects;
    bool air = false;
    std::vector<Ray> rays;  ///< empty: the picture's
};

/// The hashes of one subject's answers; of a stress scene only along its rays, which are where it is hard.
struct Answers {
    std::uint64_t first_hits = 0, partitions = 0, rays = 0;
    bool operator==(const Answers&) const = default;
};

Answers ask(const Subject& subject, int size, bool reference) {
    Settings settings{.reference = reference, .device = reference ? "" : "native", .air = subject.air};
    Renderer renderer(subject.scene, subject.objects, settings);
    Answers answers;
    View view{.width = size, .height = size};
    if (subject.rays.empty()) {
        answers.partitions = hash_of(renderer.render(view));
        view.every_partition = false;
        answers.first_hits = hash_of(renderer.render(view));
    }
    view.width = view.height = size / 2;
    answers.rays = hash_of(renderer.shoot(subject.rays.empty() ? renderer.model().grid_of(view).rays() : subject.rays));
    return answers;
}

/// What a device is given.
std::uint64_t hash_of(const Subject& subject) {
    CompileOptions options;
    options.air = subject.air;
    const CompiledScene compiled = compile(subject.scene, subject.objects, options);
    return csgrt::hash_of(compiled);
}

bool tell(const Subject& subject, int size) {
    const Answers answers = ask(subject, size, false);
    const bool agree = answers == ask(subject, size, true);
    std::printf("%s: scene %016" PRIx64 " first hits %016" PRIx64 " partitions %016" PRIx64 " rays %016" PRIx64 "%s\n",
                subject.name.c_str(), hash_of(subject), answers.first_hits, answers.partitions, answers.rays,
                agree ? "" : " THE REFERENCE DIFFERS");
    std::fflush(stdout);
    return agree;
}

int run(int size, std::span<char* const> files) {
    bool agree = true;
    for (const char* file : files) {
        Subject subject;
        subject.name = std::filesystem::path(file).filename().string();
        subject.scene = load_scene(file);
        agree &= tell(subject, size);
    }
    for (const std::string& family : stress::families()) {
        for (std::uint64_t seed = 1; seed <= 3; ++seed) {
            stress::StressScene made = stress::make(family, seed);
            const std::string name = family + " " + std::to_string(seed);
            agree &= tell({name, std::move(made.scene), made.objects, made.air, made.rays}, size);
        }
    }
    return agree ? 0 : 1;
}

}  // namespace

int main(int count, char** words) {
    try {
        const int size = count > 1 ? std::atoi(words[1]) : 0;
        if (size < 2) {
            std::fprintf(stderr, "usage: csgrt_answers SIZE FILE...\n");
            return 2;
        }
        return run(size, {words + 2, words + count});
    } catch (const std::exception& error) {
        std::fprintf(stderr, "csgrt_answers: %s\n", error.what());
        return 1;
    }
}
