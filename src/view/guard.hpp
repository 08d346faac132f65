// Guard: decides who may send requests. It checks every request before its body is read.
#pragma once

#include <string>

namespace csgrt {

/// Status codes of HTTP answers.
namespace http {
inline constexpr int good = 200, bad_request = 400, forbidden = 403, not_found = 404, not_allowed = 405,
                     no_length = 411, too_large = 413, unsupported_type = 415, large_head = 431, server_error = 500,
                     other_version = 505;
}

/// A secret: 128 random bits, as 32 hexadecimal digits.
std::string new_token();

/// The parts of a request that tell who sends it.
struct Asker {
    std::string method, path, host, content_type;
    bool has_origin = false;
    std::string origin = {};
};

/// Checks requests to a server.
class Guard {
public:
    /// `address`: the address on which the server listens.
    Guard(std::string address, std::string token) : address_(std::move(address)), token_(std::move(token)) {}

    /// The status that refuses a request, or 0. A page of another site may send requests to this address, but their
    /// Origin is the other site's. If the other site's DNS points its name here, the Host is that name. A tunnel
    /// changes only the port.
    int refusal(const Asker& asker) const;
    /// "/TOKEN/", the beginning of every path.
    std::string root() const { return "/" + token_ + "/"; }

private:
    bool is_own_host(const std::string& host) const;

    std::string address_, token_;
};

}  // namespace csgrt
