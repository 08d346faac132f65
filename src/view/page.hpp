// The text of page.html, which the build embeds.
#pragma once

#include <string>

namespace csgrt {

const std::string& page_html();

}  // namespace csgrt
