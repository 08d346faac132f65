// From one Model to the next.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <csgrt/model.hpp>

namespace csgrt {

/// Changes to a Model, all of which make the next Model at once. Colours, finishes without a light, states, lights and
/// the background change tables alone: no region or solid gets another number, and nothing is compiled. The others
/// compile the scene anew; programs and buffers of Renderers stay.
///
/// A path is that of a region, or the way down to any object in its place: "/all/track@2/link.r" (RegionInfo::path).
/// All throw Error (usage) where a path leads nowhere, and then nothing has changed; about looks commit() does. One
/// thread at a time.
class CSGRT_API Edit {
public:
    explicit Edit(Model model);
    ~Edit();
    Edit(Edit&&) noexcept;
    Edit& operator=(Edit&&) noexcept;

    // Looks of a region, or of all regions below a path, here alone (see Scene::looks).

    Edit& set_color(const std::string& path, const Vec3& color);  ///< display values: red, green, blue; 0 to 1
    Edit& set_finish(const std::string& path, const Finish& finish);
    Edit& set_state(const std::string& path, State state);

    Edit& set_lights(std::vector<Light> lights);  ///< in place of Scene::lights
    Edit& set_ambient(double intensity);          ///< Scene::ambient
    Edit& set_background(const Vec3& color);      ///< Scene::background

    /// Whose places a matrix changes.
    enum class Share {
        alone,  ///< this one's: combinations that have other places are copied for it under new names
        all     ///< those of all that share the combination whose leg it is
    };
    /// Places the object at the end of a path in its parent: the matrix of the path's last leg. Throws, too, if the
    /// path has one part, which no leg places.
    Edit& set_matrix(const std::string& path, const Matrix& matrix, Share share = Share::alone);
    /// Gives a solid other numbers, or another type, in all of its places.
    Edit& replace(const std::string& solid, Shape shape);
    /// Adds an object. It is rendered if it is one of the `top` objects, or a leg leads to it. Throws, too, if its name
    /// is taken.
    Edit& add(Object object, bool top = false);
    /// Adds a leg to a combination: its tree becomes tree `op` leg.
    Edit& add(const std::string& combination, Operator op, const std::string& object, const Matrix& matrix = identity);
    /// Removes the last leg of a path, for all that share the combination. Of the operator above it the other operands
    /// stay; what a difference took away from it goes, too. A path of one part is no longer rendered; the object stays.
    Edit& remove(const std::string& path);

    /// The next Model. Throws Error: scene, usage, out_of_memory; then the edits stay as they are.
    Model commit() const;

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace csgrt
