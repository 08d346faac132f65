// Which keys the objects of a scene file may have. The reader refuses all others, and a test holds the schema
// (scenes/csgrt.schema.json, one definition a form, under the form's name) against this table.
#pragma once

#include <string_view>
#include <vector>

namespace csgrt {

struct JsonKey {
    std::string_view name;
    bool required = false;
};

/// One kind of JSON object.
struct JsonForm {
    std::string_view name;
    std::vector<JsonKey> keys;
};

/// The form of that name; it must exist.
const JsonForm& json_form(std::string_view name);

const std::vector<JsonForm>& json_forms();

/// The forms whose name is also the value of a solid's "type".
const std::vector<std::string_view>& json_solid_types();

/// What "units" may say.
const std::vector<std::string_view>& json_units();

}  // namespace csgrt
