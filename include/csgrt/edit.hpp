// Edits: make a new Model from a Model.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <csgrt/model.hpp>

namespace csgrt {

/// Collects changes to a Model; commit() makes the next Model with all of them. If only colours, finishes without a
/// light, states, lights and the background change, nothing is compiled, and all regions and solids keep their indices.
/// All other changes compile the scene anew. Renderers keep their programs and buffers.
///
/// A path leads to a region, or to one instance of any object: "/all/track@2/link.r" (RegionInfo::path). All functions
/// throw Error (usage) and change nothing if a path leads to no object; for appearances, commit() throws. One thread at
/// a time.
class CSGRT_API Edit {
public:
    explicit Edit(Model model);
    ~Edit();
    Edit(Edit&&) noexcept;
    Edit& operator=(Edit&&) noexcept;

    // Appearance of a region, or of all regions below a path, only in this Model (see Scene::looks).

    Edit& set_color(const std::string& path, const Vec3& color);  ///< display values: red, green, blue; 0 to 1
    Edit& set_finish(const std::string& path, const Finish& finish);
    Edit& set_state(const std::string& path, State state);

    Edit& set_lights(std::vector<Light> lights);  ///< replaces Scene::lights
    Edit& set_ambient(double intensity);          ///< Scene::ambient
    Edit& set_background(const Vec3& color);      ///< Scene::background

    /// The instances whose matrix changes.
    enum class Share {
        alone,  ///< only this one: combinations with other instances are copied under new names
        all     ///< all instances of the combination whose member changes
    };
    /// Sets the matrix of the last member of a path, which transforms the object in its parent. Throws, too, if the
    /// path has only one part, because the object is then no member.
    Edit& set_matrix(const std::string& path, const Matrix& matrix, Share share = Share::alone);
    /// Gives a solid other parameters, or another type, in all of its instances.
    Edit& replace(const std::string& solid, Shape shape);
    /// Adds an object. The object is rendered if `top` is true, or if a rendered combination has it as a member.
    /// Throws, too, if its name is already used.
    Edit& add(Object object, bool top = false);
    /// Adds a member to a combination: its tree becomes tree `op` member.
    Edit& add(const std::string& combination, Operator op, const std::string& object, const Matrix& matrix = identity);
    /// Removes the last member of a path, for all instances of the combination. The other operands of the operator
    /// above it stay. But if a difference removes operands from it, these are removed, too. The object of a path with
    /// one part stays, but is no longer rendered.
    Edit& remove(const std::string& path);

    /// Makes the next Model. Throws Error (scene, usage, out_of_memory), and keeps the edits then.
    Model commit() const;

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace csgrt
