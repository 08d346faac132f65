// Description of the request of a measure. The sentences are in the C++ header, too (tests/form/requests_test.cpp).
#pragma once

#include <csgrt/measure.hpp>

#include "form/names.hpp"

namespace csgrt {

inline constexpr NameOf<MeasuredKind> measured_kind_names[] = {{"all", MeasuredKind::all},
                                                               {"assembly", MeasuredKind::assembly},
                                                               {"material", MeasuredKind::material},
                                                               {"region", MeasuredKind::region}};

}  // namespace csgrt

namespace csgrt::form {

template <>
inline constexpr auto of<MeasureRequest> = Form{
    plain("measure_request"),
    optional("rel_error", &MeasureRequest::rel_error, number, positive(),
             "Half of the interval of a volume, relative to the volume, that each region shall reach.",
             {.concern = Concern::work,
              .name = "--rel-error",
              .value = "X",
              .absent = "0.01",
              .expected = "a number greater than 0, such as 0.001"}),
    optional("abs_error", &MeasureRequest::abs_error, number, not_negative(),
             "Half of the interval of a volume, in mm^3, that is enough for each region in any case.",
             {.concern = Concern::work,
              .name = "--abs-error",
              .value = "MM3",
              .absent = "a billionth of the relative error of the model's volume",
              .expected = "a volume in mm^3, 0 or more"}),
    optional("time", &MeasureRequest::time, number, not_negative(),
             "Seconds after which no more rays are traced; the first rays, some 50,000, always are.",
             {.concern = Concern::work,
              .name = "--time",
              .value = "S",
              .absent = "no limit",
              .expected = "a number of seconds, 0 or more"}),
    optional("rays", &MeasureRequest::rays, Amount{1, MeasureRequest::most_rays},
             "Rays through the whole model to trace, in place of errors to reach.",
             {.concern = Concern::work, .name = "--rays", .value = "N", .absent = "the errors count"}),
    optional("seed", &MeasureRequest::seed, amount, "Seed of the random numbers.",
             {.concern = Concern::work, .name = "--seed", .value = "N", .absent = "1"}),
    optional("densities", &MeasureRequest::densities, special,
             "Densities of the regions; if empty, there are no masses."),
    optional("walls", &MeasureRequest::walls, flag, "The smallest wall of each region is searched.",
             {.concern = Concern::work, .name = "--walls"}),
    optional("wall_limit", &MeasureRequest::wall_limit, number, not_negative(),
             "Millimetres: regions with a thinner wall are counted.",
             {.concern = Concern::work,
              .name = "--wall-limit",
              .value = "MM",
              .absent = "none is",
              .expected = "a length in millimetres, 0 or more"}),
    optional(
        "grid", &MeasureRequest::grid, List{count, 3, 3},
        "Cells along x, y and z of a grid over the box of what is measured, in each of which volumes are measured, "
        "too.",
        {.concern = Concern::work,
         .name = "--grid",
         .value = "NX,NY,NZ",
         .absent = "no grid",
         .expected = "three whole numbers of 1 or more with commas between them, such as 20,20,10"}),
};

}  // namespace csgrt::form
