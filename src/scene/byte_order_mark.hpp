// Byte order mark: three bytes that editors on Windows put before a text in UTF-8. They are not a part of the text.
#pragma once

#include <string_view>

namespace csgrt {

inline constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";

}  // namespace csgrt
