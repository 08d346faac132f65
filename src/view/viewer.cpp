#include <csgrt/viewer.hpp>

#include <httplib.h>

#include <sys/socket.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <exception>
#include <filesystem>
#include <optional>
#include <string_view>
#include <thread>
#include <utility>

#include <csgrt/error.hpp>

#include "view/functions.hpp"
#include "view/guard.hpp"
#include "view/page.hpp"
#include "view/studio.hpp"

namespace csgrt {

namespace {

constexpr std::size_t most_bytes = 1'000'000;  ///< of a request
constexpr std::size_t piece = 120'000;         ///< of an answer, of which the library makes copies
/// Each connection has a thread until it is quiet. Those of slow clients wait for it, and take none from others.
constexpr std::size_t threads = 64;
constexpr int reading_seconds = 5, writing_seconds = 10, quiet_seconds = 1;
constexpr std::chrono::milliseconds tick{100}, look{250};
constexpr int bad_request = 400, too_large = 413, server_error = 500;
/// Debian's library would pack "application/json" by Brotli at its slowest, which takes seconds, wherever a browser
/// lets it. It does not pack this type, nor what comes by a provider of a given length.
constexpr const char* json_type = "application/json; charset=utf-8";
constexpr const char* bytes_type = "application/octet-stream";

std::string text_of(const Json& json) { return json.dump(-1, ' ', false, Json::error_handler_t::replace); }

void refuse(httplib::Response& response, int status, const std::string& why) {
    response.status = status;
    response.set_content(text_of({{"error", why}}), json_type);
}

}  // namespace

struct Viewer::Impl {
    /// When a file was written, and how long it is; empty while it is not there.
    struct Stamp {
        std::filesystem::file_time_type time = {};
        std::uintmax_t size = 0;
        bool operator==(const Stamp&) const = default;
    };
    static std::optional<Stamp> stamp_of(const std::string& file) {
        std::error_code error;
        Stamp stamp{std::filesystem::last_write_time(file, error), 0};
        if (!error) stamp.size = std::filesystem::file_size(file, error);
        return error ? std::nullopt : std::optional(stamp);
    }

    ViewerOptions options;
    Guard guard;
    std::string address = {};
    Studio studio;
    std::optional<Stamp> loaded = {};  ///< of the file that the model is of
    std::atomic<bool> stopping{false};
    httplib::Server server = {};

    Impl(Model model, const Settings& settings, ViewerOptions given)
        : options(std::move(given)),
          guard(options.address, new_token()),
          studio(std::move(model), settings, options),
          loaded(stamp_of(options.file)) {
        server.new_task_queue = [] { return new httplib::ThreadPool(threads); };
        server.set_payload_max_length(most_bytes);
        server.set_read_timeout(reading_seconds);
        server.set_write_timeout(writing_seconds);
        server.set_keep_alive_timeout(quiet_seconds);
        server.set_keep_alive_max_count(1'000'000);
        server.set_tcp_nodelay(true);
        server.set_socket_options([](socket_t socket) {  // the library's own let another process take the same port
            const int yes = 1;
            setsockopt(socket, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
        });
        server.set_default_headers({{"Cache-Control", "no-store"},
                                    {"X-Content-Type-Options", "nosniff"},
                                    {"Referrer-Policy", "no-referrer"},
                                    {"Content-Security-Policy",
                                     "default-src 'none'; script-src 'unsafe-inline'; style-src 'unsafe-inline'; "
                                     "connect-src 'self'; img-src data: blob:"}});
        server.set_pre_routing_handler(
            [this](const httplib::Request& request, httplib::Response& response) { return admit(request, response); });
        server.set_exception_handler([](const httplib::Request&, httplib::Response& response, std::exception_ptr why) {
            try {
                std::rethrow_exception(why);
            } catch (const std::exception& error) {
                refuse(response, server_error, error.what());
            }
        });
        server.set_error_handler([](const httplib::Request&, httplib::Response& response) {
            if (response.status == too_large) refuse(response, too_large, "the request has more than 1 MB");
            if (response.body.empty()) refuse(response, response.status, "refused");
        });
        server.Get(guard.root(), [](const httplib::Request&, httplib::Response& response) {
            response.set_content_provider(page_html().size(), "text/html; charset=utf-8",
                                          [](std::size_t begin, std::size_t length, httplib::DataSink& sink) {
                                              return sink.write(page_html().data() + begin, length);
                                          });
        });
        answer_json("model", [this](const Request&) { return studio.model(); });
        answer_json("status", [this](const Request&) { return studio.status(); });
        answer_json("pick", [this](const Request& request) { return studio.pick(request); });
        answer_json("command", [this](const Request& request) { return studio.command(request); });
        answer_json("end", [this](const Request&) {
            stopping = true;
            return Json::object();
        });
        answer("slice", [this](const Request& request, httplib::Response& response) {
            response.set_content(studio.slice(request), bytes_type);
        });
        answer("exr", [this](const Request& request, httplib::Response& response) {
            response.set_content(studio.exr(request), bytes_type);
        });
        answer("frame", [this](const Request& request, httplib::Response& response) { send_frame(request, response); });
        listen();
    }

    httplib::Server::HandlerResponse admit(const httplib::Request& request, httplib::Response& response) const {
        const int status = guard.refusal({.method = request.method,
                                          .path = request.path,
                                          .host = request.get_header_value("Host"),
                                          .content_type = request.get_header_value("Content-Type"),
                                          .has_origin = request.has_header("Origin"),
                                          .origin = request.get_header_value("Origin")});
        if (status == 0) return httplib::Server::HandlerResponse::Unhandled;
        refuse(response, status, "refused: the address that csgrt printed is needed, whole");
        response.set_header("Connection", "close");  // its body was not read
        return httplib::Server::HandlerResponse::Handled;
    }

    template <class Handle>
    void answer(const char* name, const Handle& handle) {
        server.Post(
            guard.root() + "api/" + name, [handle](const httplib::Request& request, httplib::Response& response) {
                try {
                    handle(Request(request.body), response);
                } catch (const Error& error) {
                    refuse(response, error.status() == Status::usage ? bad_request : server_error, error.what());
                }
            });
    }
    template <class Handle>
    void answer_json(const char* name, const Handle& handle) {
        answer(name, [handle](const Request& request, httplib::Response& response) {
            response.set_content(text_of(handle(request)), json_type);
        });
    }

    /// The head of the answer goes before the picture is drawn: only then the library tells whether a client is there.
    void send_frame(const Request& request, httplib::Response& response) {
        response.set_chunked_content_provider(
            bytes_type, [this, frame = studio.frame(request)](std::size_t, httplib::DataSink& sink) mutable {
                frame.draw([&] { return !stopping && sink.is_writable(); },
                           [&](std::string_view bytes) {
                               for (; !bytes.empty(); bytes.remove_prefix(std::min(piece, bytes.size())))
                                   if (!sink.write(bytes.data(), std::min(piece, bytes.size()))) return;
                           });
                sink.done();
                return true;
            });
    }

    void listen() {
        const bool is_v6 = options.address.find(':') != std::string::npos;
        int port = options.port;
        if (port == 0)
            port = server.bind_to_any_port(options.address);
        else if (!server.bind_to_port(options.address, port))
            port = -1;
        if (port < 0)
            throw Error(Status::file, "cannot listen on " + options.address +
                                          (options.port == 0 ? ": is it an address of this machine?"
                                                             : " port " + std::to_string(options.port) +
                                                                   ": another program may have it"));
        address = "http://" + (is_v6 ? "[" + options.address + "]" : options.address) + ":" + std::to_string(port) +
                  guard.root();
    }

    void run(const std::function<bool()>& go_on) {
        const std::jthread ending([&](const std::stop_token& over) {
            while (!over.stop_requested()) {
                if (go_on && !go_on()) stopping = true;
                if (stopping && server.is_running()) return server.stop();
                std::this_thread::sleep_for(tick);
            }
        });
        const std::jthread watching([&](const std::stop_token& over) {
            if (!options.load || options.file.empty()) return;
            auto seen = loaded;
            while (!over.stop_requested()) {
                std::this_thread::sleep_for(look);
                const auto now = stamp_of(options.file);
                const bool is_quiet = now == std::exchange(seen, now);  // or it is being written
                if (!is_quiet || !now || now == loaded) continue;
                loaded = now;
                studio.load_again();
            }
        });
        server.listen_after_bind();
        stopping = true;
    }
};

Viewer::Viewer(Model model, const Settings& settings, ViewerOptions options)
    : impl_(std::make_unique<Impl>(std::move(model), settings, std::move(options))) {}
Viewer::~Viewer() = default;
const std::string& Viewer::address() const { return impl_->address; }
void Viewer::run(const std::function<bool()>& go_on) { impl_->run(go_on); }
void Viewer::stop() { impl_->stopping = true; }

}  // namespace csgrt

namespace {

void serve(const csgrt::Model& model, const csgrt::Settings& settings, const csgrt::ViewerOptions& options,
           const std::function<void(const std::string&)>& listening, const std::function<bool()>& go_on) {
    csgrt::Viewer viewer(model, settings, options);
    listening(viewer.address());
    viewer.run(go_on);
}

}  // namespace

extern "C" const csgrt::ViewFunctions csgrt_view_functions = {serve};
