// Packer: writes one solid as geometry/<solid>.h reads it. All pack_*.cpp share this header.
#pragma once

#include <span>
#include <string>
#include <unordered_map>
#include <vector>

#include <csgrt/scene.hpp>

#include "compile/compiled_scene.hpp"
#include "compile/linear.hpp"
#include "compile/solids/pack.hpp"
#include "compile/solids/planes.hpp"
#include "compile/solids/surfaces.hpp"

namespace csgrt {

/// The packer writes one solid. pack.cpp has ell, tgc, arbs, half, tor and ehy, pack_curved.cpp other closed forms,
/// pack_sketches.cpp the solids of sketches, pack_meshes.cpp the solids of triangles.
struct Packer {
    const Matrix& matrix;
    Shapes& scene;  ///< written by solids of no fixed size (meshes, sketches, cells): see IsSmall in pack_scene.cpp
    SharedParts& shared;
    std::vector<double>& reals;  ///< of this solid, from first_real on; for solids without a fixed size of the scene
    std::vector<Plane>& planes;  ///< the faces, for the search in the table of planes
    kernel::SolidRecord record{};
    WideMatrix axes_in_world{};        ///< of the last frame
    bool is_polyhedron = false;        ///< faces in one plane are one face
    std::vector<std::string> notes{};  ///< notes on the solid

    void real(long double value) { reals.push_back(static_cast<double>(value)); }
    /// Sets center and L, the inverse of the matrix whose columns are the local axes in the world.
    void frame(const Wide& center, const WideMatrix& axes);
    void face(const Plane& plane) { planes.push_back(plane); }
    /// Adds the face through `point` that a and b span, facing away from `inside` (all before the matrix is applied).
    void face(const Wide& point, const Wide& a, const Wide& b, const Wide& inside);
    /// Adds faces of a polyhedron; several faces in one plane count once.
    void faces(std::span<const Plane> all);

    void operator()(const Ell& s);
    void operator()(const Tgc& s);
    void operator()(const Arb& s);
    void operator()(const Arbn& s);
    void operator()(const Half& s);
    void operator()(const Tor& s);
    void operator()(const Ehy& s);
    void operator()(const Part& s);
    void operator()(const Epa& s);
    void operator()(const Rpc& s);
    void operator()(const Rhc& s);
    void operator()(const Eto& s);
    void crossed(long double alpha, long double beta, long double gamma, long double determinant, long double reach);
    void operator()(const Hyp& s);
    void operator()(const Superell& s);
    void operator()(const Hrt& s);
    void operator()(const Metaball& s);
    void operator()(const Pipe& s);
    void operator()(const Cline& s);
    void operator()(const Bot& s);
    void operator()(const Ars& s);
    void operator()(const Nmg& s);
    void operator()(const Ebm& s);
    void operator()(const Vol& s);
    void operator()(const Dsp& s);
    void operator()(const Extrude& s);
    void operator()(const Revolve& s);
    void operator()(const Unsupported& s);
};

}  // namespace csgrt
