#include <csgrt/viewer.hpp>

#include <sys/stat.h>

#include <atomic>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <exception>
#include <functional>
#include <map>
#include <new>
#include <string_view>
#include <utility>

#include <csgrt/error.hpp>

#include "view/guard.hpp"
#include "view/page.hpp"
#include "view/server.hpp"
#include "view/view_session.hpp"

namespace csgrt {

namespace {

constexpr std::chrono::milliseconds look{250};  ///< between two checks of the file

void answer_json(Exchange& exchange, const Json& json, int status = http::good) {
    exchange.answer(status, json_type, {json.dump(-1, ' ', false, Json::error_handler_t::replace)});
}

}  // namespace

struct Viewer::Impl {
    using Clock = std::chrono::steady_clock;

    /// The identity of a file and of its version, or the error if the file is missing.
    struct Stamp {
        int error = 0;
        mode_t kind = 0;
        dev_t device = 0;
        ino_t number = 0;
        off_t size = 0;
        std::pair<std::int64_t, std::int64_t> written = {}, changed = {};
        bool operator==(const Stamp&) const = default;
        bool is_file() const { return error == 0 && S_ISREG(kind); }
        /// The reason why the file cannot be loaded, as the end of a sentence.
        std::string fault() const {
            if (error == ENOENT) return "is not there any more";
            if (error != 0) return std::strerror(error);
            return std::string("is no file any more, but a ") + (S_ISDIR(kind)    ? "folder"
                                                                 : S_ISFIFO(kind) ? "pipe"
                                                                                  : "device");
        }
    };
    static Stamp stamp_of(const std::string& file) {
        struct stat s {};
        if (stat(file.c_str(), &s) != 0) return {.error = errno};
        return {.kind = s.st_mode & S_IFMT,
                .device = s.st_dev,
                .number = s.st_ino,
                .size = s.st_size,
                .written = {s.st_mtim.tv_sec, s.st_mtim.tv_nsec},
                .changed = {s.st_ctim.tv_sec, s.st_ctim.tv_nsec}};
    }

    const ViewerOptions options;
    const Guard guard;
    ViewSession session;
    std::map<std::string, std::function<void(const Request&, Exchange&)>, std::less<>> answers = {};
    Stamp loaded, seen;  ///< the file's stamps: when the model was read, and at the last check
    Clock::time_point next_look = {};
    std::atomic<bool> is_loading{false};
    Server server;
    std::string address;

    Impl(Model model, const Settings& settings, ViewerOptions given)
        : options(std::move(given)),
          guard(options.address, new_token()),
          session(std::move(model), settings, options),
          loaded(stamp_of(options.file)),
          seen(loaded),
          server(
              options.address, options.port, [this](const Asker& asker) { return guard.refusal(asker); },
              [this](Exchange& exchange) { answer(exchange); }) {
        if (!options.load || !loaded.is_file()) next_look = Clock::time_point::max();  // a pipe is read once
        const std::string host = reachable_address(options.address);
        address = "http://" + (host.find(':') == host.npos ? host : "[" + host + "]") + ":" +
                  std::to_string(server.port()) + guard.root();

        const auto answer_by = [this](const char* name, auto make) {
            answers[name] = [make](const Request& request, Exchange& exchange) {
                answer_json(exchange, make(request));
            };
        };
        answers["model"] = [this](const Request& request, Exchange& exchange) {
            const Json whole = session.model();
            if (!request.has("encoding")) return answer_json(exchange, whole);
            const std::string text = whole.dump(-1, ' ', false, Json::error_handler_t::replace);
            exchange.answer(http::good, "application/octet-stream", {compressed(text)});
        };
        answer_by("status", [this](const Request&) { return session.status(); });
        answer_by("parts", [this](const Request& request) { return session.parts(request); });
        answer_by("pick", [this](const Request& request) { return session.pick(request); });
        answer_by("command", [this](const Request& request) { return session.command(request); });
        answers["end"] = [this](const Request&, Exchange& exchange) {
            answer_json(exchange, Json::object());
            server.stop();
        };
        const auto send_by = [this](const char* name, void (ViewSession::*send)(const Request&, const Client&)) {
            answers[name] = [this, send](const Request& request, Exchange& exchange) {
                (session.*send)(request, {.is_wanted = [&] { return exchange.is_wanted(); },
                                          .send =
                                              [&](auto parts, auto later) {
                                                  exchange.answer(http::good, "application/octet-stream", parts, later);
                                              },
                                          .send_more = [&](std::string_view bytes) { exchange.write(bytes); }});
            };
        };
        send_by("frame", &ViewSession::frame);
        send_by("slice", &ViewSession::slice);
        send_by("exr", &ViewSession::exr);
        send_by("check", &ViewSession::check);
    }

    /// Answers a request that the guard has admitted.
    void answer(Exchange& exchange) const {
        constexpr std::string_view folder = "api/";
        const std::string_view name = std::string_view(exchange.head.path).substr(guard.root().size());
        if (name.empty()) return exchange.answer(http::good, page_type, {page_html()});
        const auto refuse = [&](int status, const char* why) { answer_json(exchange, {{"error", why}}, status); };
        const auto found = answers.find(name.substr(folder.size()));
        if (found == answers.end()) return refuse(http::not_found, "refused: nothing has this name");
        try {
            found->second(Request(exchange.body), exchange);
        } catch (const std::bad_alloc&) {
            refuse(http::server_error, "there is not enough memory for the answer");
        } catch (const Error& error) {
            refuse(error.status() == Status::usage ? http::bad_request : http::server_error, error.what());
        } catch (const std::exception& error) {
            refuse(http::server_error, error.what());
        }
    }

    void look_at_file() {
        if (is_loading || Clock::now() < next_look) return;
        next_look = Clock::now() + look;
        const Stamp now = stamp_of(options.file);
        if (now != std::exchange(seen, now) || now == loaded) return;  // the file is being written, or has not changed
        loaded = now;
        if (!now.is_file())
            return session.set_error(options.file + " " + now.fault() + ": the page shows the model as it was");
        is_loading = true;
        server.submit([this] {
            session.load_again();
            is_loading = false;
        });
    }
};

Viewer::Viewer(Model model, const Settings& settings, ViewerOptions options)
    : impl_(std::make_unique<Impl>(std::move(model), settings, std::move(options))) {}
Viewer::~Viewer() = default;
const std::string& Viewer::address() const { return impl_->address; }
void Viewer::run(const std::function<bool()>& go_on) {
    impl_->server.run([&] {
        impl_->look_at_file();
        return !go_on || go_on();
    });
}
void Viewer::stop() { impl_->server.stop(); }

}  // namespace csgrt
