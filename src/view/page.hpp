// The page of src/view/page/, which the build joins and embeds.
#pragma once

#include <string>

namespace csgrt {

const std::string& page_html();

}  // namespace csgrt
