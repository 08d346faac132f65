// Schema of scene files, for editors: scenes/csgrt.schema.json. It is made from the same descriptions as the reader.
#pragma once

#include <string>

namespace csgrt {

std::string json_schema_text();

}  // namespace csgrt
