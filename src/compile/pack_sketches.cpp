// Solids that outlines make.
#include "compile/packer.hpp"

namespace csgrt {

void Packer::operator()(const Ebm&) { throw Error(Status::scene, "solids of type 'ebm' cannot be rendered"); }

void Packer::operator()(const Extrude&) { throw Error(Status::scene, "solids of type 'extrude' cannot be rendered"); }

void Packer::operator()(const Revolve&) { throw Error(Status::scene, "solids of type 'revolve' cannot be rendered"); }

}  // namespace csgrt
