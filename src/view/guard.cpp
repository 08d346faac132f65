#include "guard.hpp"

#include <algorithm>
#include <random>
#include <string_view>

namespace csgrt {

namespace {

bool is_loopback(std::string_view address) {
    return address == "127.0.0.1" || address == "::1" || address == "localhost";
}

/// Is the host an IP address? A name is not safe, because anybody's name can point to this machine.
bool is_number(std::string_view host) {
    const bool is_v6 = host.find(':') != host.npos;
    return !host.empty() && host.find_first_not_of(is_v6 ? "0123456789abcdefABCDEF:." : "0123456789.") == host.npos;
}

/// The host without port and brackets, for texts such as "127.0.0.1:8000" or "[::1]:8000". Empty for other texts.
std::string_view without_port(std::string_view host) {
    std::string_view name = host, rest;
    if (host.starts_with('[')) {
        const std::size_t end = host.find(']');
        if (end == host.npos) return {};
        name = host.substr(1, end - 1);
        rest = host.substr(end + 1);
    } else if (const std::size_t colon = host.find(':'); colon != host.npos) {
        name = host.substr(0, colon);
        rest = host.substr(colon);
    }
    const bool has_port = rest.size() > 1 && rest[0] == ':' && rest.find_first_not_of("0123456789", 1) == rest.npos;
    return rest.empty() || has_port ? name : std::string_view{};
}

}  // namespace

std::string new_token() {
    std::random_device random;
    std::string token;
    constexpr std::size_t digits = 32;
    while (token.size() < digits) token += "0123456789abcdef"[random() % 16];
    return token;
}

bool Guard::is_own_host(const std::string& host) const {
    const std::string_view name = without_port(host);
    if (name.empty()) return false;
    return is_loopback(name) || name == address_ || (!is_loopback(address_) && is_number(name));
}

int Guard::refusal(const Asker& asker) const {
    if (!is_own_host(asker.host)) return http::forbidden;
    if (asker.has_origin && asker.origin != "http://" + asker.host) return http::forbidden;
    if (!asker.path.starts_with(root())) return http::not_found;
    const std::string_view rest = std::string_view(asker.path).substr(root().size());
    if (rest.empty()) return asker.method == "GET" ? 0 : http::not_allowed;
    if (!rest.starts_with("api/")) return http::not_found;
    if (asker.method != "POST") return http::not_allowed;
    // A form on another site's page cannot send this type.
    return asker.content_type.starts_with("application/json") ? 0 : http::unsupported_type;
}

}  // namespace csgrt
