// A Viewer on a thread, and requests as its page sends them.
#pragma once

#include <cstring>
#include <string>
#include <thread>
#include <utility>

#include <nlohmann/json.hpp>

#include <csgrt/viewer.hpp>

#include "http_client.hpp"

namespace csgrt::test {

using nlohmann::json;

/// A frame's answer.
struct FrameAnswer {
    json head;
    std::string pixels;
};

inline FrameAnswer split_frame(const std::string& body) {
    std::uint32_t length = 0;
    std::memcpy(&length, body.data(), sizeof length);
    return {json::parse(body.substr(4, length)), body.substr(4 + length)};
}

class PageClient {
public:
    explicit PageClient(Model model, ViewerOptions options = {}, const Settings& settings = {})
        : viewer_(std::move(model), settings, std::move(options)), running_([this] { viewer_.run(); }) {
        const std::string& address = viewer_.address();
        const std::size_t slash = address.find('/', std::string("http://").size());
        host_ = address.substr(0, slash);
        root_ = address.substr(slash);
    }
    ~PageClient() { viewer_.stop(); }

    const std::string& host() const { return host_; }
    const std::string& root() const { return root_; }
    int port() const { return std::stoi(host_.substr(host_.rfind(':') + 1)); }
    HttpConnection connect(int patience_ms = 60'000) const { return HttpConnection(port(), patience_ms); }

    std::optional<HttpAnswer> post(const std::string& name, const json& body) const {
        return connect().ask("POST", root_ + "api/" + name, body.dump());
    }
    json ask(const std::string& name, const json& body = json::object()) const {
        const auto result = post(name, body);
        return result ? json::parse(result->body) : json{{"error", "no answer"}};
    }
    FrameAnswer frame(json request) const {
        const json usual = {{"page", "test"}, {"number", 1}, {"samples", 1}, {"encoding", "raw"}};
        for (const auto& [key, value] : usual.items())
            if (!request.contains(key)) request[key] = value;
        return split_frame(post("frame", request)->body);
    }

private:
    Viewer viewer_;
    std::string host_, root_;
    std::jthread running_;  ///< the last member: it ends before the Viewer goes
};

}  // namespace csgrt::test
