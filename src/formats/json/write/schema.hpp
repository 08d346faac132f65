// Schema of scene files, for editors: scenes/csgrt.schema.json, made of the same descriptions as the reader.
#pragma once

#include <string>

namespace csgrt {

std::string json_schema_text();

}  // namespace csgrt
