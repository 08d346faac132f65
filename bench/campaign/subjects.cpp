#include "subjects.hpp"

#include <algorithm>
#include <filesystem>
#include <optional>

#include <csgrt/scene_io.hpp>

#include "stress/families.hpp"
#include "stress/random.hpp"
#include "oracle/scene_judge.hpp"
#include "integration/stress/expected.hpp"

namespace csgrt::campaign {
namespace {

class StressSubject final : public Subject {
public:
    explicit StressSubject(const Item& item) : item_(item), made_(stress::make(item.family, item.seed)) {}

    const Scene& scene() const override { return made_.scene; }
    const std::vector<std::string>& objects() const override { return made_.objects; }
    void prepare(const Renderer& renderer, std::size_t count) override {
        renumbering_.emplace(renderer, made_.objects);
        fused_ = renderer.statistics().tolerance;
        const std::size_t times = (count + made_.rays.size() - 1) / made_.rays.size();
        if (times > 1) made_ = stress::make(item_.family, item_.seed, times);
        expected_.emplace(made_, true);
    }
    std::vector<Ray> rays(std::size_t count) override {
        first_ += shot_;
        shot_ = std::min(count, made_.rays.size() - first_);
        const auto begin = made_.rays.begin() + static_cast<std::ptrdiff_t>(first_);
        return {begin, begin + static_cast<std::ptrdiff_t>(shot_)};
    }
    Verdict judge(std::size_t i, RayPartitions& found) override {
        renumbering_->apply(found);
        const Verdict verdict = judge_by(*expected_, i, found);
        if (verdict.wrong.empty()) return verdict;
        if (!slow_) slow_.emplace(made_);
        return judge_by(*slow_, i, found);
    }

private:
    Verdict judge_by(const test::ExpectedAnswers& answers, std::size_t i, const RayPartitions& found) const {
        const test::Expected expected = answers(first_ + i);
        if (expected.tie) return {true, {}, 0};
        const test::Compared compared = test::compare(found, expected, made_.rays[first_ + i], fused_);
        Verdict verdict{false, {}, compared.worst};
        if (!compared.overlaps) verdict.wrong = "other overlaps";
        if (compared.worst > 1) verdict.wrong = "an end is " + std::to_string(compared.worst) + " times too far off";
        if (!compared.regions) verdict.wrong = "other regions";
        return verdict;
    }

    const Item item_;
    stress::StressScene made_;
    std::optional<test::Renumbering> renumbering_;
    std::optional<test::ExpectedAnswers> expected_, slow_;  ///< with the filter; in 113 bits throughout
    std::size_t first_ = 0, shot_ = 0;
    double fused_ = 0;
};

/// Rays through the model's box, in turn: from all sides; along the axes; from within; from far away; with directions
/// of other lengths; along the axes through whole millimetres, where many models have their faces and edges.
class SceneSubject final : public Subject {
public:
    explicit SceneSubject(const Item& item) : scene_(load_scene(item.path)), random_(item.seed) {}

    const Scene& scene() const override { return scene_; }
    const std::vector<std::string>& objects() const override { return objects_; }
    void prepare(const Renderer& renderer, std::size_t) override {
        regions_ = renderer.model().regions();
        slack_ = renderer.statistics().tolerance;
        oracle_.emplace(scene_, objects_, true, true);
        judge_.emplace(*oracle_, regions_, slack_);
        if (!judge_->unknown_regions().empty()) throw Error(Status::scene, judge_->unknown_regions());
        box_ = renderer.model().bounds();
        if (!(box_.low.x <= box_.high.x && std::isfinite(box_.high.x - box_.low.x))) box_ = {{-1, -1, -1}, {1, 1, 1}};
    }
    std::vector<Ray> rays(std::size_t count) override {
        rays_.clear();
        const Vec3 &low = box_.low, &high = box_.high;
        const double size = std::hypot(high.x - low.x, high.y - low.y, high.z - low.z);
        for (std::size_t i = 0; i < count; ++i) {
            Vec3 through{random_.between(low.x, high.x), random_.between(low.y, high.y),
                         random_.between(low.z, high.z)};
            Vec3 d = i % 6 == 1 || i % 6 == 5 ? random_.axis() : random_.direction();
            if (i % 6 == 5) through = {std::round(through.x), std::round(through.y), std::round(through.z)};
            double back = 2 * size;
            if (i % 6 == 2) back = 0;
            if (i % 6 == 3) back *= random_.power_of_ten(1, 5);
            const Vec3 origin{through.x - back * d.x, through.y - back * d.y, through.z - back * d.z};
            const double length = i % 6 == 4 ? random_.power_of_ten(-3, 3) : 1;
            rays_.push_back({origin, {length * d.x, length * d.y, length * d.z}});
        }
        return rays_;
    }
    Verdict judge(std::size_t i, RayPartitions& found) override {
        const Verdict verdict = judge_by(*judge_, i, found);
        if (verdict.wrong.empty()) return verdict;
        if (!slow_judge_) {
            slow_oracle_.emplace(scene_, objects_, true);
            slow_judge_.emplace(*slow_oracle_, regions_, slack_);
        }
        return judge_by(*slow_judge_, i, found);
    }

private:
    Verdict judge_by(const oracle::SceneJudge& judge, std::size_t i, const RayPartitions& found) const {
        std::size_t ties = 0;
        Verdict verdict;
        verdict.wrong = judge.judge(rays_[i], found, ties);
        verdict.tie = ties > 0;
        return verdict;
    }

    const Scene scene_;
    const std::vector<std::string> objects_ = {};
    stress::Random random_;
    std::vector<RegionInfo> regions_;
    double slack_ = 0;
    std::optional<oracle::SceneOracle> oracle_, slow_oracle_;  ///< with the filter; in 113 bits throughout
    std::optional<oracle::SceneJudge> judge_, slow_judge_;
    Box box_;
    std::vector<Ray> rays_;
};

constexpr std::uint64_t scenes_of_a_family = 84;

std::vector<std::string> files_in(const std::string& folder, const std::string& extension) {
    std::vector<std::string> files;
    if (!std::filesystem::is_directory(folder)) return files;
    for (const auto& entry : std::filesystem::directory_iterator(folder))
        if (entry.path().extension() == extension && !entry.path().string().ends_with(".schema.json"))
            files.push_back(entry.path().string());
    std::sort(files.begin(), files.end());
    return files;
}

}  // namespace

std::unique_ptr<Subject> Item::make() const {
    if (path.empty()) return std::make_unique<StressSubject>(*this);
    return std::make_unique<SceneSubject>(*this);
}

std::vector<Item> items(const Choice& choice) {
    std::vector<Item> all;
    const auto wanted = [&](const std::string& family) {
        return choice.only.empty() || std::find(choice.only.begin(), choice.only.end(), family) != choice.only.end();
    };
    // A file is several pieces of work, so that threads can share it; but its judge is built for each.
    const auto add_files = [&](const std::string& family, const std::vector<std::string>& files, double share,
                               double cost) {
        if (!wanted(family)) return;
        const std::uint64_t pieces = choice.threads > 4 ? 8 : 2;
        for (const std::string& file : files) {
            const std::string name = std::filesystem::path(file).filename().string();
            const double part = name == "blobs.json" || name == "sketches.json" ? 0.1 : 1;
            for (std::uint64_t piece = 0; piece < pieces; ++piece)
                all.push_back({family, name, file, piece, part * share / static_cast<double>(pieces), cost / part});
        }
    };
    add_files("models", files_in(choice.models, ".asc"), 4, 8);
    for (const std::string& family : stress::families())
        for (std::uint64_t seed = 0; seed < scenes_of_a_family && wanted(family); ++seed) {
            // Up to 10^5 nodes, 10^4 segments on a ray.
            const bool large = family == "deep_trees" || family == "depth";
            all.push_back({family, family + " " + std::to_string(seed), {}, seed, large ? 2e-4 : 1});
        }
    add_files("scenes", files_in(choice.scenes, ".json"), 2, 2);
    return all;
}

}  // namespace csgrt::campaign
