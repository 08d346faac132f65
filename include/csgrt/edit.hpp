// Edits: from one Model to the next.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <csgrt/model.hpp>

namespace csgrt {

/// Changes to a Model, all of which make the next Model at once. Colours, finishes without a light, states, lights and
/// the background change tables alone: no region or solid gets another number, and nothing is compiled. All other
/// changes compile the scene anew; programs and buffers of Renderers stay.
///
/// A path is that of a region, or the path down to one instance of any object: "/all/track@2/link.r"
/// (RegionInfo::path). All functions throw Error (usage) if a path leads nowhere, and then nothing has changed; for
/// appearances commit() throws. One thread at a time.
class CSGRT_API Edit {
public:
    explicit Edit(Model model);
    ~Edit();
    Edit(Edit&&) noexcept;
    Edit& operator=(Edit&&) noexcept;

    // Appearance of a region, or of all regions below a path, in this Model alone (see Scene::looks).

    Edit& set_color(const std::string& path, const Vec3& color);  ///< display values: red, green, blue; 0 to 1
    Edit& set_finish(const std::string& path, const Finish& finish);
    Edit& set_state(const std::string& path, State state);

    Edit& set_lights(std::vector<Light> lights);  ///< in place of Scene::lights
    Edit& set_ambient(double intensity);          ///< Scene::ambient
    Edit& set_background(const Vec3& color);      ///< Scene::background

    /// The instances whose matrix changes.
    enum class Share {
        alone,  ///< this one: combinations that have other instances are copied for it under new names
        all     ///< all that share the combination whose member it is
    };
    /// Transforms the object at the end of a path in its parent: sets the matrix of the path's last member. Throws,
    /// too, if the path has only one part: the object is then no member.
    Edit& set_matrix(const std::string& path, const Matrix& matrix, Share share = Share::alone);
    /// Gives a solid other numbers, or another type, in all of its instances.
    Edit& replace(const std::string& solid, Shape shape);
    /// Adds an object. It is rendered if it is one of the `top` objects, or a rendered combination has it as a member.
    /// Throws, too, if its name is taken.
    Edit& add(Object object, bool top = false);
    /// Adds a member to a combination: its tree becomes tree `op` member.
    Edit& add(const std::string& combination, Operator op, const std::string& object, const Matrix& matrix = identity);
    /// Removes the last member of a path, for all instances of the combination. The other operands of the operator
    /// above it stay; operands that a difference removes from it go, too. A path of one part is no longer rendered; the
    /// object stays.
    Edit& remove(const std::string& path);

    /// Makes the next Model. Throws Error: scene, usage, out_of_memory; then the edits stay unchanged.
    Model commit() const;

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace csgrt
