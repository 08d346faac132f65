// Solids that triangles make.
#include "compile/packer.hpp"

namespace csgrt {

void Packer::operator()(const Bot&) { throw Error(Status::scene, "solids of type 'bot' cannot be rendered"); }

void Packer::operator()(const Ars&) { throw Error(Status::scene, "solids of type 'ars' cannot be rendered"); }

void Packer::operator()(const Nmg&) { throw Error(Status::scene, "solids of type 'nmg' cannot be rendered"); }

void Packer::operator()(const Vol&) { throw Error(Status::scene, "solids of type 'vol' cannot be rendered"); }

void Packer::operator()(const Dsp&) { throw Error(Status::scene, "solids of type 'dsp' cannot be rendered"); }

}  // namespace csgrt
