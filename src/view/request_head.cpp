#include "request_head.hpp"

#include <algorithm>
#include <charconv>
#include <limits>
#include <string>
#include <utility>

namespace csgrt {

namespace {

std::string lower(std::string_view text) {
    std::string letters(text);
    for (char& c : letters)
        if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
    return letters;
}

std::string_view trimmed(std::string_view text) {
    constexpr std::string_view blanks = " \t";
    const std::size_t begin = std::min(text.find_first_not_of(blanks), text.size());
    return text.substr(begin, text.find_last_not_of(blanks) + 1 - begin);
}

/// Has the text only characters that are allowed in a header's name or a method?
bool is_word(std::string_view text) {
    return !text.empty() && std::ranges::all_of(text, [](char c) {
        return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
               std::string_view("!#$%&'*+-.^_`|~").find(c) != std::string_view::npos;
    });
}

/// Has the text no character that some reader takes for the end of a line?
bool is_plain(std::string_view text) { return text.find_first_of(std::string_view("\0\r\n", 3)) == text.npos; }

bool read_length(std::string_view text, std::uint64_t& length) {
    if (text.empty() || text.find_first_not_of("0123456789") != text.npos) return false;
    if (std::from_chars(text.data(), text.data() + text.size(), length).ec != std::errc())
        length = std::numeric_limits<std::uint64_t>::max();
    return true;
}

}  // namespace

int read_request_head(std::string_view text, RequestHead& head) {
    const auto next_line = [&text] {
        const std::size_t end = text.find("\r\n");
        const std::string_view line = text.substr(0, end);
        text.remove_prefix(end == text.npos ? text.size() : end + 2);
        return line;
    };
    const std::string_view first = next_line();
    const std::size_t one = first.find(' '), two = first.rfind(' ');
    if (one == two || !is_plain(first) || !is_word(first.substr(0, one))) return http::bad_request;
    const std::string_view target = first.substr(one + 1, two - one - 1), version = first.substr(two + 1);
    if (!version.starts_with("HTTP/")) return http::bad_request;
    if (version != "HTTP/1.1" && version != "HTTP/1.0") return http::other_version;
    head.method = first.substr(0, one);
    head.path = target.substr(0, target.find('?'));
    head.is_last = version == "HTTP/1.0";

    bool has_host = false;
    for (std::string_view line = next_line(); !line.empty(); line = next_line()) {
        const std::size_t colon = line.find(':');
        if (colon == line.npos || !is_word(line.substr(0, colon)) || !is_plain(line)) return http::bad_request;
        const std::string name = lower(line.substr(0, colon));
        const std::string_view value = trimmed(line.substr(colon + 1));
        if (name == "host") {
            if (std::exchange(has_host, true)) return http::bad_request;
            head.host = value;
        } else if (name == "origin") {
            if (std::exchange(head.has_origin, true)) return http::bad_request;
            head.origin = value;
        } else if (name == "content-length") {
            if (std::exchange(head.has_length, true) || !read_length(value, head.length)) return http::bad_request;
        } else if (name == "content-type") {
            head.content_type = value;
        } else if (name == "transfer-encoding") {
            head.is_in_pieces = true;
        } else if (name == "expect") {
            head.waits = lower(value) == "100-continue";
        } else if (name == "connection" && lower(value).find("close") != std::string::npos) {
            head.is_last = true;
        }
    }
    return 0;
}

int body_refusal(const RequestHead& head) {
    if (head.is_in_pieces || (head.method == "POST" && !head.has_length)) return http::no_length;
    return head.length > most_body_bytes ? http::too_large : 0;
}

}  // namespace csgrt
