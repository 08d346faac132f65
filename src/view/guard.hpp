// Guard: decides who may send requests. It checks every request before its body is read.
#pragma once

#include <string>

namespace csgrt {

/// Statuses of HTTP answers.
namespace http {
inline constexpr int good = 200, bad_request = 400, forbidden = 403, not_found = 404, not_allowed = 405,
                     no_length = 411, too_large = 413, unsupported_type = 415, large_head = 431, server_error = 500,
                     other_version = 505;
}

/// A secret: 128 random bits, as 32 digits.
std::string new_token();

/// The parts of a request that show who sends it.
struct Asker {
    std::string method, path, host, content_type;
    bool has_origin = false;
    std::string origin = {};
};

/// The checks of a server's requests.
class Guard {
public:
    /// `address`: of the interface on which the server listens.
    Guard(std::string address, std::string token) : address_(std::move(address)), token_(std::move(token)) {}

    /// The status that refuses a request, or 0. A page of another site may send requests to this address, but not with
    /// the server's own Origin; a name that the site's DNS points here comes as the Host. A tunnel changes only the
    /// port.
    int refusal(const Asker& asker) const;
    /// "/TOKEN/", with which every path begins.
    std::string root() const { return "/" + token_ + "/"; }

private:
    bool is_own_host(const std::string& host) const;

    std::string address_, token_;
};

}  // namespace csgrt
