#include "truth_file.hpp"

#include <algorithm>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "base/fnv1a.hpp"
#include "base/parallel.hpp"
#include "compile/compiled_scene.hpp"
#include "report.hpp"

namespace csgrt::bench {
namespace {

constexpr char magic[] = "CSGTRUTH";
constexpr std::size_t rays_a_piece = 2048;
constexpr std::size_t header_bytes = 8 + 4 + 4 + 8, ray_bytes = 2 + 4 + 8, stretch_bytes = 4 + 4 * 8;

template <class T>
void put(std::string& bytes, const T& value) {
    static_assert(std::is_trivially_copyable_v<T>);
    bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}
/// Takes a value off the front; the caller has seen that it is there.
template <class T>
T next(std::string_view& bytes) {
    T value;
    std::memcpy(&value, bytes.data(), sizeof value);
    bytes.remove_prefix(sizeof value);
    return value;
}

std::uint64_t checksum(std::string_view bytes) {
    Fnv1a hash;
    hash.add_text(bytes);
    return hash.state();
}

std::string file_name(const std::string& workload, std::size_t rays, std::size_t piece) {
    std::string name = workload;
    for (char& c : name)
        if (c == ' ' || c == '/') c = '_';
    return name + "-" + std::to_string(rays) + "-" + std::to_string(piece) + ".truth";
}

}  // namespace

std::string to_bytes(const std::vector<TrueRay>& rays, std::uint64_t key) {
    std::string bytes(magic);
    put(bytes, truth_version);
    put(bytes, static_cast<std::uint32_t>(rays.size()));
    put(bytes, key);
    for (const TrueRay& ray : rays) {
        put(bytes, ray.verdict);
        put(bytes, ray.first_verdict);
        put(bytes, static_cast<std::uint32_t>(ray.sequence.size()));
        put(bytes, ray.speed);
        for (std::size_t i = 0; i < ray.sequence.size(); ++i) {
            const Stretch& s = ray.sequence[i];
            put(bytes, s.region);
            for (const double value : {s.in, s.out, ray.in_unit[i], ray.out_unit[i]}) put(bytes, value);
        }
    }
    put(bytes, checksum(bytes));
    return bytes;
}

std::optional<std::vector<TrueRay>> from_bytes(const std::string& bytes, std::uint64_t key, std::string& fault) {
    const auto refuse = [&](const char* why) {
        fault = why;
        return std::nullopt;
    };
    std::string_view rest = bytes;
    if (rest.substr(0, 8) != magic) return refuse("it is no file of the chart's truth");
    if (rest.size() < header_bytes + 8) return refuse("it is cut off");
    rest.remove_prefix(8);
    if (next<std::uint32_t>(rest) != truth_version) return refuse("another version of csgrt_chart made it");
    const auto count = next<std::uint32_t>(rest);
    const bool is_ours = next<std::uint64_t>(rest) == key;
    std::string_view last = rest.substr(rest.size() - 8);
    if (next<std::uint64_t>(last) != checksum(std::string_view(bytes).substr(0, bytes.size() - 8)))
        return refuse("it is cut off or damaged");
    if (!is_ours) return refuse("it was made of other scenes or rays");
    rest.remove_suffix(8);
    std::vector<TrueRay> rays(count <= rest.size() / ray_bytes ? count : 0);
    for (TrueRay& ray : rays) {
        if (rest.size() < ray_bytes) return refuse("it is damaged");
        ray.verdict = next<TrueRay::Verdict>(rest);
        ray.first_verdict = next<TrueRay::Verdict>(rest);
        const auto stretches = next<std::uint32_t>(rest);
        ray.speed = next<double>(rest);
        if (stretches > rest.size() / stretch_bytes) return refuse("it is damaged");
        for (std::uint32_t i = 0; i < stretches; ++i) {
            Stretch s;
            s.region = next<std::uint32_t>(rest);
            s.in = next<double>(rest);
            s.out = next<double>(rest);
            ray.sequence.push_back(s);
            ray.in_unit.push_back(next<double>(rest));
            ray.out_unit.push_back(next<double>(rest));
        }
    }
    if (rays.size() != count || !rest.empty()) return refuse("it is damaged");
    return rays;
}

/// Rays of one task, or all rays of several.
struct TruthMaker::Piece {
    std::size_t first_task, last_task;  ///< behind the last
    std::size_t first_ray, rays;        ///< of the first task; of all tasks
    std::uint64_t key = 0;
};

TruthMaker::TruthMaker(const ChartWorkload& workload, const std::string& folder, unsigned threads)
    : workload_(workload), folder_(folder), threads_(threads) {
    const std::vector<Task>& tasks = workload.tasks;
    truth_.resize(tasks.size());
    for (std::size_t task = 0; task < tasks.size();) {
        const std::size_t all = tasks[task].rays.size();
        if (all >= rays_a_piece) {
            for (std::size_t ray = 0; ray < all; ray += rays_a_piece)
                pieces_.push_back({task, task + 1, ray, std::min(rays_a_piece, all - ray)});
            ++task;
            continue;
        }
        Piece piece{task, task, 0, 0};
        while (task < tasks.size() && piece.rays + tasks[task].rays.size() <= rays_a_piece)
            piece.rays += tasks[task++].rays.size();
        piece.last_task = task;
        pieces_.push_back(piece);
    }
    if (folder_.empty()) return;
    std::error_code error;
    std::filesystem::create_directories(folder_, error);
    if (error) throw Error(Status::file, folder_ + ": cannot be made: " + error.message());
    std::vector<std::uint64_t> hashes(tasks.size());
    for_chunks(tasks.size(), 1, threads_, [&](std::size_t task, std::size_t, std::size_t) {
        Fnv1a hash;
        const CompiledScene compiled = compile(tasks[task].scene, tasks[task].objects);
        hash.add(compiled.hash);
        for (const std::uint32_t end : compiled.rank_ends) hash.add(end);
        hashes[task] = hash.state();
    });
    for (Piece& piece : pieces_) {
        Fnv1a hash;
        hash.add(truth_version);
        for (std::size_t task = piece.first_task; task < piece.last_task; ++task) {
            hash.add(hashes[task]);
            const auto begin = tasks[task].rays.begin() + static_cast<std::ptrdiff_t>(piece.first_ray);
            const std::size_t count = std::min(piece.rays, tasks[task].rays.size() - piece.first_ray);
            hash.add_all(std::vector<Ray>(begin, begin + static_cast<std::ptrdiff_t>(count)));
        }
        piece.key = hash.state();
    }
}
TruthMaker::~TruthMaker() = default;

std::vector<std::vector<TrueRay>> TruthMaker::made(const Piece& piece) {
    const std::size_t tasks = piece.last_task - piece.first_task;
    std::vector<std::vector<TrueRay>> truth(tasks);
    if (tasks == 1) {  // one thread for each 64 rays
        const Task& task = workload_.tasks[piece.first_task];
        if (judged_task_ != piece.first_task) judge_.emplace(task.scene, task.objects, threads_);
        judged_task_ = piece.first_task;
        const auto begin = task.rays.begin() + static_cast<std::ptrdiff_t>(piece.first_ray);
        truth[0] = judge_->true_rays({begin, begin + static_cast<std::ptrdiff_t>(piece.rays)});
        return truth;
    }
    for_chunks(tasks, 1, threads_, [&](std::size_t i, std::size_t, std::size_t) {
        const Task& task = workload_.tasks[piece.first_task + i];
        truth[i] = Judge(task.scene, task.objects, 1).true_rays(task.rays);
    });
    return truth;
}

Progress TruthMaker::make(Clock::time_point end) {
    Progress progress;
    for (std::vector<TrueRay>& task : truth_) task.clear();
    for (const Piece& piece : pieces_) progress.all += piece.rays;
    for (std::size_t i = 0; i < pieces_.size(); ++i) {
        const Piece& piece = pieces_[i];
        const std::string path = folder_.empty() ? "" : folder_ + "/" + file_name(workload_.name, progress.all, i);
        std::optional<std::vector<TrueRay>> rays;
        if (std::ifstream in(path, std::ios::binary); !path.empty() && in) {
            const std::string bytes((std::istreambuf_iterator<char>(in)), {});
            std::string fault;
            rays = from_bytes(bytes, piece.key, fault);
            if (!rays) std::fprintf(stderr, "%s: %s; it is made anew\n", path.c_str(), fault.c_str());
        }
        if (!rays) {
            if (Clock::now() >= end) continue;  // later pieces may be there
            rays.emplace();
            for (std::vector<TrueRay>& task : made(piece))
                std::move(task.begin(), task.end(), std::back_inserter(*rays));
            if (!path.empty()) write_whole(to_bytes(*rays, piece.key), path);
        }
        progress.done += rays->size();
        auto next_ray = rays->begin();
        for (std::size_t task = piece.first_task; task < piece.last_task; ++task) {
            const std::size_t count = std::min(piece.rays, workload_.tasks[task].rays.size() - piece.first_ray);
            std::move(next_ray, next_ray + static_cast<std::ptrdiff_t>(count), std::back_inserter(truth_[task]));
            next_ray += static_cast<std::ptrdiff_t>(count);
        }
    }
    return progress;
}

}  // namespace csgrt::bench
