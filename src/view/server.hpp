// Server of HTTP/1.1 for few admitted clients and any number of others. One thread reads all requests, and other
// threads answer the admitted ones. A client takes no thread while it sends or is silent. Of a client that is not
// admitted, at most most_head_bytes are kept.
#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <deque>
#include <functional>
#include <list>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/thread.hpp"
#include "view/request_head.hpp"

namespace csgrt {

inline constexpr const char* json_type = "application/json; charset=utf-8";
inline constexpr const char* page_type = "text/html; charset=utf-8";

/// Owns a file descriptor of the system, or none (-1).
class Handle {
public:
    explicit Handle(int number = -1) : number_(number) {}
    Handle(Handle&& other) noexcept : number_(std::exchange(other.number_, -1)) {}
    Handle& operator=(Handle&& other) noexcept {
        std::swap(number_, other.number_);
        return *this;
    }
    ~Handle();
    operator int() const { return number_; }

private:
    int number_;
};

/// A request, and its answer. It belongs to the thread that answers it.
class Exchange {
public:
    const RequestHead& head;
    const std::string body;

    /// False if the client has closed the connection, or the server ends.
    bool is_wanted() const;
    /// Sends all of an answer except the last `later` bytes, which write() sends. Later calls have no effect.
    void answer(int status, const char* type, std::initializer_list<std::string_view> parts, std::uint64_t later = 0);
    void write(std::string_view bytes);

private:
    friend class Server;
    Exchange(const RequestHead& of, std::string text, int socket, const std::atomic<bool>& stopping)
        : head(of), body(std::move(text)), socket_(socket), stopping_(stopping) {}

    bool is_whole() const { return has_begun_ && is_good_ && left_ == 0; }

    const int socket_;
    const std::atomic<bool>& stopping_;
    std::uint64_t left_ = 0;  ///< number of the answer's bytes that are not sent yet
    bool has_begun_ = false, is_good_ = true;
};

/// The address by which other machines reach this one if `address` stands for all of its addresses; otherwise
/// `address`.
std::string reachable_address(const std::string& address);

class Server {
public:
    /// The status that refuses a request, or 0.
    using Refusal = std::function<int(const Asker&)>;
    using Answer = std::function<void(Exchange&)>;

    /// Starts to listen. Port 0 is any free port. Throws Error (file) if this fails, or no thread is available.
    Server(const std::string& address, int port, Refusal refusal, Answer answer);
    ~Server();
    Server(const Server&) = delete;
    Server& operator=(const Server&) = delete;

    int port() const { return port_; }
    /// Serves until stop() is called or `go_on` returns false, which is called at least twenty times a second. Call
    /// run() once.
    void run(const std::function<bool()>& go_on);
    /// Ends run(). Any thread.
    void stop();
    /// Gives work to another thread. Only the thread in run() may call this.
    void submit(std::function<void()> work);

private:
    using Clock = std::chrono::steady_clock;
    enum class Phase { head, waiting, body, answered, refused };
    struct Connection {
        Handle socket;
        Clock::time_point deadline = {};
        Phase phase = Phase::head;
        bool is_admitted = false;  ///< a request of the connection was admitted
        RequestHead head = {};
        std::string bytes = {};  ///< bytes that have arrived and are not used yet
        bool is_over = false;
    };

    void accept_some();
    bool take_place();
    void receive(Connection& connection);
    void advance(Connection& connection, std::string_view more = {});
    void refuse(Connection& connection, int status);
    void answer(Connection& connection) noexcept;
    void wake();
    void take_back();
    void close_over();
    void work();
    void end_threads();

    const Refusal refusal_;
    const Answer answer_;
    Handle listener_, wake_;
    int port_ = 0;
    std::list<Connection> connections_ = {};
    std::size_t body_bytes_ = 0;  ///< total size of the bodies that arrive or are being answered
    bool accepts_ = true;
    std::atomic<bool> stopping_{false};

    std::mutex mutex_ = {};
    std::condition_variable has_work_ = {};
    std::deque<std::function<void()>> work_ = {};
    std::size_t idle_ = 0;
    bool is_ended_ = false;
    std::vector<Connection*> answered_ = {};    ///< connections that were answered since run() looked last
    std::vector<Connection*> taken_back_ = {};  ///< memory that only run() uses
    std::optional<JoinedThreads> threads_ = {};
};

}  // namespace csgrt
