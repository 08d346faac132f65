// The schema of scene files, for editors: scenes/csgrt.schema.json, made from the descriptions that the reader goes
// over.
#pragma once

#include <string>

namespace csgrt {

std::string json_schema_text();

}  // namespace csgrt
