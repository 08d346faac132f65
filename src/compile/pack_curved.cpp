// Solids of a closed form.
#include "compile/packer.hpp"

namespace csgrt {

void Packer::operator()(const Part&) { throw Error(Status::scene, "solids of type 'part' cannot be rendered"); }

void Packer::operator()(const Epa&) { throw Error(Status::scene, "solids of type 'epa' cannot be rendered"); }

void Packer::operator()(const Rpc&) { throw Error(Status::scene, "solids of type 'rpc' cannot be rendered"); }

void Packer::operator()(const Rhc&) { throw Error(Status::scene, "solids of type 'rhc' cannot be rendered"); }

void Packer::operator()(const Eto&) { throw Error(Status::scene, "solids of type 'eto' cannot be rendered"); }

void Packer::operator()(const Hyp&) { throw Error(Status::scene, "solids of type 'hyp' cannot be rendered"); }

void Packer::operator()(const Superell&) { throw Error(Status::scene, "solids of type 'superell' cannot be rendered"); }

void Packer::operator()(const Hrt&) { throw Error(Status::scene, "solids of type 'hrt' cannot be rendered"); }

void Packer::operator()(const Metaball&) { throw Error(Status::scene, "solids of type 'metaball' cannot be rendered"); }

}  // namespace csgrt
