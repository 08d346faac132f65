#include "all.hpp"

#include <stdexcept>
#include <string>
#include <variant>

#include "cylinders.hpp"
#include "ehy.hpp"
#include "ell.hpp"
#include "epa.hpp"
#include "eto.hpp"
#include "half.hpp"
#include "hrt.hpp"
#include "hyp.hpp"
#include "metaball.hpp"
#include "part.hpp"
#include "polyhedron.hpp"
#include "superell.hpp"
#include "tgc.hpp"
#include "tor.hpp"

namespace csgrt::oracle {

namespace {

template <class Other>
ImplicitSolid implicit(const Other& shape, const QAffine&) {
    throw std::invalid_argument(std::string("the oracle knows no solid of type ") + type_name(shape));
}

}  // namespace

ImplicitSolid implicit(const Shape& shape, const QAffine& place) {
    return std::visit([&](const auto& s) { return implicit(s, place); }, shape);
}
ImplicitSolid implicit(const Shape& shape, const Matrix& matrix) { return implicit(shape, to_affine(matrix)); }

}  // namespace csgrt::oracle
