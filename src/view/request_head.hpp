// Request head of HTTP/1.1, as far as a page's server needs it. Anybody may send it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

#include "view/guard.hpp"

namespace csgrt {

inline constexpr std::size_t most_head_bytes = 16'384;  ///< with the empty line at its end
inline constexpr std::size_t most_body_bytes = 1'000'000;

struct RequestHead : Asker {
    bool is_last = false;       ///< the client asks to close the connection after the answer
    bool waits = false;         ///< it sends its body when it gets "continue"
    bool has_length = false;    ///< Content-Length was given,
    std::uint64_t length = 0;   ///< of the body, or 2^64 - 1 for a larger one
    bool is_in_pieces = false;  ///< the body has a coding that marks its end
};

/// Reads a head with its empty line. Returns 0, or the status that refuses it.
int read_request_head(std::string_view text, RequestHead& head);
/// The status that refuses the body, or 0: every request of csgrt's page has a length.
int body_refusal(const RequestHead& head);

}  // namespace csgrt
