// A client of HTTP/1.1 that sends what it is told, right or wrong, and says what came.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <netinet/in.h>
#include <sys/socket.h>
#include <sys/time.h>
#include <unistd.h>

namespace csgrt::test {

using Headers = std::vector<std::pair<std::string, std::string>>;

struct HttpAnswer {
    int status = 0;
    std::map<std::string, std::string> headers = {};  ///< by names in small letters
    std::string body = {};
};

/// A connection to a port of this machine.
class HttpConnection {
public:
    explicit HttpConnection(int port, int patience_ms = 60'000)
        : port_(port), socket_(socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0)) {
        sockaddr_in address{};
        address.sin_family = AF_INET;
        address.sin_port = htons(static_cast<std::uint16_t>(port));
        address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
        const timeval patience{patience_ms / 1000, patience_ms % 1000 * 1000};
        setsockopt(socket_, SOL_SOCKET, SO_RCVTIMEO, &patience, sizeof patience);
        setsockopt(socket_, SOL_SOCKET, SO_SNDTIMEO, &patience, sizeof patience);
        is_open_ = connect(socket_, reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0;
    }
    HttpConnection(HttpConnection&& other) noexcept
        : port_(other.port_), socket_(std::exchange(other.socket_, -1)), is_open_(other.is_open_) {}
    HttpConnection& operator=(HttpConnection&&) = delete;
    ~HttpConnection() {
        if (socket_ >= 0) close(socket_);
    }

    bool is_open() const { return is_open_; }
    /// False: the other end has closed, or takes nothing.
    bool send(std::string_view bytes) {
        while (is_open_ && !bytes.empty()) {
            const ssize_t count = ::send(socket_, bytes.data(), bytes.size(), MSG_NOSIGNAL);
            is_open_ = count > 0;
            if (is_open_) bytes.remove_prefix(static_cast<std::size_t>(count));
        }
        return is_open_;
    }
    /// The next answer; none where the other end closes, or is silent, before its end.
    std::optional<HttpAnswer> receive() {
        constexpr std::string_view empty_line = "\r\n\r\n";
        while (come_.find(empty_line) == come_.npos)
            if (!take()) return std::nullopt;
        HttpAnswer answer;
        std::string_view head = std::string_view(come_).substr(0, come_.find(empty_line) + 2);
        const std::size_t body = head.size() + 2;
        answer.status = std::stoi(std::string(head.substr(head.find(' ') + 1)));
        for (head.remove_prefix(head.find("\r\n") + 2); !head.empty(); head.remove_prefix(head.find("\r\n") + 2)) {
            const std::size_t colon = head.find(": ");
            std::string name(head.substr(0, colon));
            for (char& c : name) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
            answer.headers[name] = head.substr(colon + 2, head.find("\r\n") - colon - 2);
        }
        const std::size_t length = std::stoull(answer.headers["content-length"]);
        while (come_.size() < body + length)
            if (!take()) return std::nullopt;
        answer.body = come_.substr(body, length);
        come_.erase(0, body + length);
        return answer;
    }
    /// A request that is right but for what is given.
    std::optional<HttpAnswer> ask(const std::string& method, const std::string& path, const std::string& body = {},
                                  const Headers& headers = {}) {
        send(text_of(method, path, body.size(), headers) + body);
        return receive();
    }
    /// The head of such a request.
    std::string text_of(const std::string& method, const std::string& path, std::size_t length,
                        const Headers& headers = {}) const {
        std::string text = method + " " + path + " HTTP/1.1\r\n";
        Headers all = {{"Host", "127.0.0.1:" + std::to_string(port_)}, {"Content-Type", "application/json"}};
        if (method == "POST") all.emplace_back("Content-Length", std::to_string(length));
        for (const auto& [name, value] : headers)
            std::erase_if(all, [&name = name](const auto& other) { return other.first == name; });
        all.insert(all.end(), headers.begin(), headers.end());
        for (const auto& [name, value] : all) text.append(name).append(": ").append(value).append("\r\n");
        return text + "\r\n";
    }
    int socket_number() const { return socket_; }

private:
    bool take() {
        char bytes[65'536];
        const ssize_t count = recv(socket_, bytes, sizeof bytes, 0);
        is_open_ = count > 0;
        if (is_open_) come_.append(bytes, static_cast<std::size_t>(count));
        return is_open_;
    }

    int port_, socket_;
    bool is_open_ = false;
    std::string come_ = {};  ///< and was not read yet
};

}  // namespace csgrt::test
