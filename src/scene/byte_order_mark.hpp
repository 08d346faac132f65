// Byte order mark: editors on Windows put it before a text in UTF-8. It is not a part of the text.
#pragma once

#include <string_view>

namespace csgrt {

inline constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";

}  // namespace csgrt
