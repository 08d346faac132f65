// A scene in Python: a Renderer with its Model, and the edits that wait for commit().
#pragma once

#include <unistd.h>

#include <atomic>
#include <mutex>
#include <optional>
#include <thread>

#include "values.hpp"

namespace csgrt::python {

/// The memory of an answer whose arrays are gone, for the next: new memory costs a twentieth of the time of a call.
struct Spare {
    std::mutex mutex = {};
    std::unique_ptr<Partitions> answer = {};
    std::unique_ptr<Partitions> take() {
        const std::lock_guard lock(mutex);
        return answer ? std::move(answer) : std::make_unique<Partitions>();
    }
};

/// Calls of several threads wait for each other, and none of them holds the GIL meanwhile.
class LiveScene {
public:
    /// Takes what is in `source`. It compiles the scene without the GIL.
    LiveScene(Scene& source, std::vector<std::string> objects, const Settings& settings);

    // What is known without a computation. A Model is shared and never changes.

    nb::list region_rows() const;
    nb::list solid_rows() const;
    nb::list warning_rows();
    Box bounds() const { return model().bounds(); }
    double tolerance() const { return model().tolerance(); }
    const std::string& units() const { return units_; }
    const std::string& title() const { return title_; }
    const Camera& camera() const { return camera_; }

    // Lists of rays and points. `ranges` has a pair for each ray, in place of near and far.

    nb::dict partitions(const Doubles& rays, RayRange range, const std::optional<Doubles>& ranges, Fields fields);
    nb::dict cast_rays(const Doubles& rays, RayRange range, const std::optional<Doubles>& ranges, Fields fields);
    nb::object occluded(const Doubles& rays, RayRange range, const std::optional<Doubles>& ranges);
    nb::object region_at(const Doubles& points);
    nb::object slice(const Vec3& normal, double offset, std::pair<int, int> pixels, bool hidden);

    /// The channels of a picture (channels, height, width) and their names.
    nb::tuple render(const View& view);
    nb::tuple pick(const View& view, int column, int row);
    nb::object rays_of(const View& view);
    nb::dict verify(std::size_t rays, std::uint64_t seed);

    // Edits. Those that take a source look for its first object of the kind that they need.

    void set_color(const std::string& path, const Vec3& color);
    void set_finish(const std::string& path, const Scene& source);
    void set_state(const std::string& path, const std::string& state);
    void set_matrix(const std::string& path, const Matrices& matrix, bool all);
    void replace(const std::string& solid, const Scene& source);
    void add(const Scene& source, const std::string& top);
    void add_leg(const std::string& combination, const std::string& op, const std::string& object,
                 const Matrices& matrix);
    void remove(const std::string& path);
    void commit();
    void discard();

    void save(const std::string& path);

private:
    void require_own_process() const;
    Model model() const {
        require_own_process();
        return renderer_->model();
    }
    /// Runs what computes. An exception that a signal has left is Python's to see.
    template <class Call>
    void run(const Call& call);
    template <class Call>
    void edit(const Call& call);

    Settings settings_;
    std::vector<std::string> objects_;
    std::string units_, title_;
    Camera camera_;
    std::optional<Renderer> renderer_;
    std::optional<Edit> edit_;
    std::mutex computing_, editing_;
    std::shared_ptr<Spare> spare_ = std::make_shared<Spare>();
    std::atomic<std::thread::id> computes_ = {};  ///< the thread that holds `computing_`
    pid_t process_ = getpid();
};

}  // namespace csgrt::python
