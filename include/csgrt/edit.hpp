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
/// A part that moves, or is removed from a union, is compiled by itself as long as the model's extent stays; solids
/// may get other indices, as may regions after a removal. All other changes compile the scene anew. The next Model is
/// always the Model that would be compiled from its scene, to the last bit. Renderers keep their programs and buffers.
///
/// A path leads to a region, or to one instance of any object: "/all/track@2/link.r" (RegionInfo::path). "/" names all
/// where a function says so. All functions throw Error (usage) and change nothing if a path leads to no object; for the
/// paths of appearances, commit() throws. One thread at a time.
class CSGRT_API Edit {
public:
    explicit Edit(Model model);
    ~Edit();
    Edit(Edit&&) noexcept;
    Edit& operator=(Edit&&) noexcept;

    // Appearance of a region, of all regions below a path, or by "/" of all regions, only in this Model (see
    // Scene::looks). Throws, too, for a colour or another value that a scene must not have.

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
    /// Sets the matrix of the last member of a path, which transforms the object in its parent. If the path has only
    /// one part, sets the matrix of a rendered object (Scene::top_matrices).
    Edit& set_matrix(const std::string& path, const Matrix& matrix, Share share = Share::alone);
    /// Moves the object at the end of a path in the world: its placement becomes `matrix` times Model::placement_of().
    /// "/": moves all that is rendered. Throws, too, if a matrix above the object cannot be inverted.
    Edit& move(const std::string& path, const Matrix& matrix, Share share = Share::alone);
    /// Gives a solid other parameters, or another type, in all of its instances. With a matrix other than the identity
    /// the solid's name becomes that of a combination of the moved solid, which can be replaced again.
    Edit& replace(const std::string& solid, Shape shape, const Matrix& matrix = identity);
    /// Adds an object. The object is rendered if `top` is true, or if a rendered combination has it as a member.
    /// Throws, too, if its name is already used.
    Edit& add(Object object, bool top = false);
    /// Renders an object that the scene has and that is not rendered by its name: one that was removed, or a member in
    /// a place of its own. Throws, too, if it is rendered already.
    Edit& add_top(const std::string& object, const Matrix& matrix = identity);
    /// Adds a member to a combination: its tree becomes tree `op` member.
    Edit& add(const std::string& combination, Operator op, const std::string& object, const Matrix& matrix = identity);
    /// Removes the last member of a path, for all instances of the combination. The other operands of the operator
    /// above it stay. But if a difference removes operands from it, these are removed, too. The object of a path with
    /// one part stays, but is no longer rendered; add_top() brings it back.
    Edit& remove(const std::string& path);
    /// Removes the last member of a path, as remove() does, and deletes its object, and all below it that nothing else
    /// uses. Throws, too, if another combination uses the object, or it is rendered by another path.
    Edit& erase(const std::string& path);

    /// Makes the next Model. Throws Error (scene, usage, out_of_memory), and keeps the edits then.
    Model commit() const;

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace csgrt
