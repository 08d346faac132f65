// Request head of HTTP/1.1, with the parts that a page's server needs. It may come from anybody.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

#include "view/guard.hpp"

namespace csgrt {

inline constexpr std::size_t most_head_bytes = 16'384;  ///< includes the empty line at the end
inline constexpr std::size_t most_body_bytes = 1'000'000;

struct RequestHead : Asker {
    bool is_last = false;       ///< the client asks to close the connection after the answer
    bool waits = false;         ///< the client sends the body only after "100 Continue"
    bool has_length = false;    ///< Content-Length is given
    std::uint64_t length = 0;   ///< the body's; 2^64 - 1 for a larger one
    bool is_in_pieces = false;  ///< the body has a transfer coding, which marks its end
};

/// Reads a head with its empty line. Returns 0, or the status that refuses the request.
int read_request_head(std::string_view text, RequestHead& head);
/// The status that refuses the body, or 0. Only bodies with a length are accepted, as csgrt's page sends them.
int body_refusal(const RequestHead& head);

}  // namespace csgrt
