// csgrt_bench_c SCENE OBJECT [RAYS [ROUNDS]]: partitions of a million rays through a model, by C and by C++ in turn, in
// one process. Prints the median of each, and of the ratios C / C++ of the rounds: of the time that passes, and of that
// of processors, which others on the machine change less.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <functional>
#include <vector>

#include <csgrt/csgrt.h>
#include <csgrt/csgrt.hpp>

namespace {

struct Time {
    double wall = 0, processors = 0;  ///< milliseconds
};

Time time_of(const std::function<void()>& work) {
    const auto start = std::chrono::steady_clock::now();
    const std::clock_t used = std::clock();
    work();
    return {std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count(),
            1e3 * static_cast<double>(std::clock() - used) / CLOCKS_PER_SEC};
}

double median(std::vector<double> values) {
    std::ranges::nth_element(values, values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2));
    return values[values.size() / 2];
}

void expect(csgrt_status status) {
    if (status == CSGRT_OK) return;
    std::fprintf(stderr, "%s\n", csgrt_last_error());
    std::exit(status);
}

}  // namespace

int main(int argc, char** argv) {
    if (argc < 3) {
        std::fprintf(stderr, "usage: csgrt_bench_c SCENE OBJECT [RAYS [ROUNDS]]\n");
        return 2;
    }
    const int side = static_cast<int>(std::sqrt(argc > 3 ? std::atof(argv[3]) : 1e6));
    const int rounds = argc > 4 ? std::atoi(argv[4]) : 31;
    csgrt_scene* scene = nullptr;
    csgrt_model* model = nullptr;
    csgrt_renderer* c = nullptr;
    csgrt_partitions* found = nullptr;
    const char* const objects[] = {argv[2]};
    expect(csgrt_load_scene(argv[1], nullptr, &scene));
    expect(csgrt_model_create(scene, objects, 1, nullptr, &model));
    expect(csgrt_renderer_create(model, nullptr, &c));
    expect(csgrt_partitions_create(&found));

    csgrt::Renderer cpp(csgrt::load_scene(argv[1]), {argv[2]});
    csgrt::Partitions answer;
    const std::vector<csgrt::Ray> list = cpp.model().grid_of({.width = side, .height = side}).rays();
    csgrt_rays rays = CSGRT_RAYS;
    rays.list = reinterpret_cast<const csgrt_ray*>(list.data());
    rays.count = list.size();
    csgrt_partition_arrays arrays = CSGRT_PARTITION_ARRAYS;
    const auto by_c = [&] {
        expect(csgrt_renderer_partitions(c, &rays, found));
        expect(csgrt_partitions_get(found, &arrays));
    };
    const auto by_cpp = [&] { cpp.partitions(list, answer); };

    std::vector<double> c_ms, cpp_ms, wall, processors;
    by_c();  // memory comes with the first answer
    by_cpp();
    for (int i = 0; i < rounds; ++i) {
        // Who is first changes, so that neither always has the other's warm caches.
        Time in_c, in_cpp;
        if (i % 2 == 0) in_c = time_of(by_c);
        in_cpp = time_of(by_cpp);
        if (i % 2 != 0) in_c = time_of(by_c);
        c_ms.push_back(in_c.wall);
        cpp_ms.push_back(in_cpp.wall);
        wall.push_back(in_c.wall / in_cpp.wall);
        processors.push_back(in_c.processors / in_cpp.processors);
    }
    std::printf("%zu rays, %zu rows: C %.2f ms, C++ %.2f ms, ratio %.4f, of the processors' time %.4f\n", list.size(),
                arrays.row_count, median(c_ms), median(cpp_ms), median(wall), median(processors));
    csgrt_partitions_free(found);
    csgrt_renderer_free(c);
    csgrt_model_free(model);
    csgrt_scene_free(scene);
    return arrays.row_count == answer.t_in.size() ? 0 : 8;
}
