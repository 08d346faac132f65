#include "server.hpp"

#include <fcntl.h>
#include <netdb.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <poll.h>
#include <sys/eventfd.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <new>
#include <utility>

#include <csgrt/error.hpp>

namespace csgrt {

namespace {

constexpr std::size_t places = 512, most_threads = 64;
constexpr std::size_t most_bytes_of_bodies = 8 * most_body_bytes;  // parsed JSON takes up to 40 times as much
constexpr std::size_t bytes_at_once = 262'144;  // bytes of an answer between two checks whether the server ends
constexpr std::chrono::milliseconds tick{50};
/// The times after which a client is dropped: while it sends a head or a body, while it sends no request, while it
/// takes no byte of its answer, and after it was refused.
constexpr std::chrono::seconds for_head{5}, for_body{30}, without_request{60}, without_taking{10}, to_notice{2};

const char* sentence_of(int status) {
    switch (status) {
        case http::bad_request:
            return "refused: this is no request of HTTP/1.1";
        case http::no_length:
            return "refused: the request does not say how long it is (Content-Length)";
        case http::too_large:
            return "the request has more than 1 MB: looks of many single parts are to be looks of what is above them";
        case http::large_head:
            return "refused: the head of the request has more than 16 kB";
        default:
            return "refused: the address that csgrt view printed is needed, whole, with the slash at its end. Each "
                   "csgrt view has an address of its own, and no other after it has ended";
    }
}

std::string head_of(int status, const char* type, std::uint64_t length, bool is_last) {
    return "HTTP/1.1 " + std::to_string(status) + (status < 400 ? " OK" : " Refused") + "\r\nContent-Type: " + type +
           "\r\nContent-Length: " + std::to_string(length) + (is_last ? "\r\nConnection: close" : "") +
           "\r\nCache-Control: no-store\r\nX-Content-Type-Options: nosniff\r\nReferrer-Policy: no-referrer\r\n"
           "Content-Security-Policy: default-src 'none'; script-src 'unsafe-inline'; style-src 'unsafe-inline'; "
           "connect-src 'self'; img-src data: blob:\r\n\r\n";
}

bool again() { return errno == EAGAIN || errno == EWOULDBLOCK || errno == EINTR; }

using Addresses = std::unique_ptr<addrinfo, void (*)(addrinfo*)>;
Addresses addresses_of(const std::string& host, int port, int type, int flags) {
    addrinfo wanted{}, *found = nullptr;
    wanted.ai_socktype = type;
    wanted.ai_flags = flags | AI_NUMERICSERV;
    const bool is_known = getaddrinfo(host.c_str(), std::to_string(port).c_str(), &wanted, &found) == 0;
    return {is_known ? found : nullptr, freeaddrinfo};
}

/// Makes a socket that listens. Empty if no address works.
Handle listening(const std::string& address, int port) {
    const Addresses all = addresses_of(address, port, SOCK_STREAM, AI_PASSIVE);
    for (const addrinfo* one = all.get(); one; one = one->ai_next) {
        Handle made(socket(one->ai_family, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0));
        const int yes = 1;
        setsockopt(made, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
        if (bind(made, one->ai_addr, one->ai_addrlen) == 0 && listen(made, SOMAXCONN) == 0) return made;
    }
    return Handle();
}

int port_of(int socket) {
    sockaddr_storage name{};
    socklen_t length = sizeof name;
    if (getsockname(socket, reinterpret_cast<sockaddr*>(&name), &length) != 0) return 0;
    return ntohs(name.ss_family == AF_INET6 ? reinterpret_cast<const sockaddr_in6&>(name).sin6_port
                                            : reinterpret_cast<const sockaddr_in&>(name).sin_port);
}

/// This machine's address on the route to the machine `other`. No packet is sent.
std::string own_address(const char* other, const char* otherwise) {
    const Addresses to = addresses_of(other, 9, SOCK_DGRAM, AI_NUMERICHOST);
    if (!to) return otherwise;
    const Handle udp(socket(to->ai_family, SOCK_DGRAM | SOCK_CLOEXEC, 0));
    sockaddr_storage own{};
    socklen_t length = sizeof own;
    auto* const name = reinterpret_cast<sockaddr*>(&own);
    char text[NI_MAXHOST] = {};
    return connect(udp, to->ai_addr, to->ai_addrlen) == 0 && getsockname(udp, name, &length) == 0 &&
                   getnameinfo(name, length, text, sizeof text, nullptr, 0, NI_NUMERICHOST) == 0
               ? text
               : otherwise;
}

}  // namespace

std::string reachable_address(const std::string& address) {
    // These addresses are reserved for documentation, so the route to them is the route to other machines.
    if (address == "0.0.0.0") return own_address("192.0.2.1", "127.0.0.1");
    if (address == "::") return own_address("2001:db8::1", "::1");
    return address;
}

Handle::~Handle() {
    if (number_ >= 0) close(number_);
}

// ---- An answer ----

bool Exchange::is_wanted() const {
    if (stopping_ || !is_good_) return false;
    char byte = 0;
    const ssize_t count = recv(socket_, &byte, 1, MSG_PEEK | MSG_DONTWAIT);
    return count > 0 || (count < 0 && again());
}

void Exchange::answer(int status, const char* type, std::initializer_list<std::string_view> parts,
                      std::uint64_t later) {
    if (std::exchange(has_begun_, true)) {
        is_good_ = false;
        return;
    }
    std::uint64_t length = later;
    for (const std::string_view part : parts) length += part.size();
    std::string begin = head_of(status, type, length, head.is_last);
    left_ = begin.size() + length;
    for (const std::string_view part : parts) {
        if (begin.size() + part.size() < bytes_at_once) {
            begin += part;
            continue;
        }
        write(std::exchange(begin, {}));
        write(part);
    }
    write(begin);
}

void Exchange::write(std::string_view bytes) {
    const std::uint64_t at_start = left_;
    auto last = std::chrono::steady_clock::now();
    while (is_good_ && !bytes.empty()) {
        // When the server ends, a short answer is still sent: it may tell a page that its frame was cancelled.
        if (stopping_ && at_start > bytes_at_once) break;
        const ssize_t count =
            send(socket_, bytes.data(), std::min(bytes.size(), bytes_at_once), MSG_NOSIGNAL | MSG_DONTWAIT);
        if (count > 0) {
            bytes.remove_prefix(static_cast<std::size_t>(count));
            left_ -= static_cast<std::uint64_t>(count);
            last = std::chrono::steady_clock::now();
            continue;
        }
        if (!again() || stopping_ || std::chrono::steady_clock::now() - last > without_taking) break;
        pollfd wanted{socket_, POLLOUT, 0};
        poll(&wanted, 1, static_cast<int>(tick.count()));
    }
    is_good_ = is_good_ && bytes.empty();
}

// ---- Threads that compute answers ----

void Server::work() {
    std::unique_lock lock(mutex_);
    for (;;) {
        ++idle_;
        has_work_.wait(lock, [this] { return is_ended_ || !work_.empty(); });
        --idle_;
        if (is_ended_) return;
        const std::function<void()> next = std::move(work_.front());
        work_.pop_front();
        lock.unlock();
        next();
        lock.lock();
    }
}

void Server::submit(std::function<void()> work) {
    const std::lock_guard lock(mutex_);
    work_.push_back(std::move(work));
    // If no other thread is available, the existing threads do the work.
    if (idle_ < work_.size() && threads_->size() < most_threads) threads_->add([this] { this->work(); });
    has_work_.notify_one();
}

void Server::end_threads() {
    {
        const std::lock_guard lock(mutex_);
        is_ended_ = true;
        work_.clear();
    }
    has_work_.notify_all();
    threads_.reset();
}

void Server::answer(Connection& connection) noexcept {
    connection.is_over = true;
    try {
        Exchange exchange(connection.head, connection.bytes.substr(0, connection.head.length), connection.socket,
                          stopping_);
        connection.bytes.erase(0, connection.head.length);
        answer_(exchange);
        connection.is_over = connection.head.is_last || !exchange.is_whole();
    } catch (const std::bad_alloc&) {
    }
    const std::lock_guard lock(mutex_);
    answered_.push_back(&connection);
    wake();
}

// ---- The thread that reads requests ----

Server::Server(const std::string& address, int port, Refusal refusal, Answer answer)
    : refusal_(std::move(refusal)),
      answer_(std::move(answer)),
      listener_(listening(address, port)),
      wake_(eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK)) {
    if (listener_ < 0 || wake_ < 0)
        throw Error(Status::file, "cannot listen on " + address +
                                      (port == 0 ? ": is it an address of this machine?"
                                                 : " port " + std::to_string(port) + ": another program may have it"));
    port_ = port_of(listener_);
    answered_.reserve(places);
    taken_back_.reserve(places);
    if (!threads_.emplace().add([this] { work(); }))
        throw Error(Status::file, "the page gets no thread to answer with: are there threads to be had?");
}

Server::~Server() { end_threads(); }

void Server::wake() {
    const std::uint64_t one = 1;
    static_cast<void>(!write(wake_, &one, sizeof one));
}

void Server::stop() {
    stopping_ = true;
    wake();
}

void Server::run(const std::function<bool()>& go_on) {
    std::vector<pollfd> files;
    std::vector<Connection*> whose;
    files.reserve(places + 2);
    whose.reserve(places);
    while (!stopping_ && (!go_on || go_on())) {
        take_back();
        files = {{wake_, POLLIN, 0}, {accepts_ ? listener_ : -1, POLLIN, 0}};
        whose.clear();
        for (Connection& connection : connections_)
            if (connection.phase != Phase::answered && connection.phase != Phase::waiting) {
                files.push_back({connection.socket, POLLIN, 0});
                whose.push_back(&connection);
            }
        accepts_ = true;
        if (poll(files.data(), files.size(), static_cast<int>(tick.count())) > 0) {
            for (std::size_t i = 0; i < whose.size(); ++i)
                if (files[i + 2].revents) receive(*whose[i]);
            if (files[1].revents) accept_some();
        }
        close_over();
    }
    stopping_ = true;
    end_threads();
    connections_.clear();
}

void Server::take_back() {
    std::uint64_t count = 0;
    static_cast<void>(!read(wake_, &count, sizeof count));
    {
        const std::lock_guard lock(mutex_);
        taken_back_.swap(answered_);
    }
    for (Connection* const one : taken_back_) {
        body_bytes_ -= one->head.length;
        one->phase = Phase::head;
        one->deadline = Clock::now() + without_request;
        if (!one->is_over) advance(*one);
    }
    taken_back_.clear();
    for (Connection& connection : connections_)
        if (connection.phase == Phase::waiting) advance(connection);
}

void Server::close_over() {
    const auto now = Clock::now();
    std::erase_if(connections_, [&](const Connection& one) {
        const bool is_late = one.phase != Phase::answered && now > one.deadline;
        if (one.phase == Phase::answered || (!one.is_over && !is_late)) return false;
        if (one.phase == Phase::body) body_bytes_ -= one.head.length;
        return true;
    });
}

/// Closes a connection to make place: the slowest one that was not admitted, or else the one that was silent for
/// longest. False: all connections are being answered.
bool Server::take_place() {
    const auto is_better = [](const Connection& a, const Connection& b) {
        return std::pair(a.is_admitted, a.deadline) < std::pair(b.is_admitted, b.deadline);
    };
    Connection* slowest = nullptr;
    for (Connection& one : connections_) {
        const bool may_go = one.phase == Phase::refused || one.phase == Phase::head;
        if (may_go && (!slowest || is_better(one, *slowest))) slowest = &one;
    }
    if (!slowest) return false;
    connections_.remove_if([&](const Connection& one) { return &one == slowest; });
    return true;
}

void Server::accept_some() {
    constexpr int at_once = 64;
    for (int i = 0; i < at_once; ++i) {
        Handle made(accept4(listener_, nullptr, nullptr, SOCK_CLOEXEC | SOCK_NONBLOCK));
        if (made < 0) {
            const bool is_full = errno == EMFILE || errno == ENFILE || errno == ENOBUFS || errno == ENOMEM;
            if (is_full && !take_place()) accepts_ = false;  // no connection is accepted until the next tick
            if (!is_full && errno != ECONNABORTED && errno != EINTR) return;
            if (!accepts_) return;
            continue;
        }
        if (connections_.size() >= places && !take_place()) continue;
        const int yes = 1;
        setsockopt(made, IPPROTO_TCP, TCP_NODELAY, &yes, sizeof yes);
        try {
            connections_.push_back({.socket = std::move(made), .deadline = Clock::now() + for_head});
        } catch (const std::bad_alloc&) {
        }
    }
}

void Server::receive(Connection& connection) {
    std::array<char, most_head_bytes> chunk{};
    const ssize_t count = recv(connection.socket, chunk.data(), chunk.size(), 0);
    if (count <= 0) {
        connection.is_over = count == 0 || !again();
        return;
    }
    if (connection.phase == Phase::refused) return;  // closing now would lose the answer
    if (connection.phase == Phase::head && connection.bytes.empty())
        connection.deadline = std::min(connection.deadline, Clock::now() + for_head);
    advance(connection, {chunk.data(), static_cast<std::size_t>(count)});
}

void Server::advance(Connection& connection, std::string_view more) try {
    std::string& bytes = connection.bytes;
    bytes += more;
    RequestHead& head = connection.head;
    if (connection.phase == Phase::head) {
        constexpr std::string_view empty_line = "\r\n\r\n";
        const std::size_t end = std::string_view(bytes).substr(0, most_head_bytes).find(empty_line);
        if (end == bytes.npos) {
            if (bytes.size() >= most_head_bytes) refuse(connection, http::large_head);
            return;
        }
        head = {};
        int status = read_request_head(std::string_view(bytes).substr(0, end + empty_line.size()), head);
        if (status == 0) status = refusal_(head);
        if (status == 0) {
            connection.is_admitted = true;
            status = body_refusal(head);
        }
        if (status != 0) return refuse(connection, status);
        bytes.erase(0, end + empty_line.size());
        connection.phase = Phase::waiting;
        connection.deadline = Clock::now() + for_body;
    }
    if (connection.phase == Phase::waiting) {
        if (body_bytes_ > 0 && body_bytes_ + head.length > most_bytes_of_bodies) return;
        body_bytes_ += head.length;
        connection.phase = Phase::body;
        connection.deadline = Clock::now() + for_body;
        if (head.waits && bytes.size() < head.length) {
            constexpr std::string_view go = "HTTP/1.1 100 Continue\r\n\r\n";
            static_cast<void>(send(connection.socket, go.data(), go.size(), MSG_NOSIGNAL));
        }
    }
    if (connection.phase == Phase::body && bytes.size() >= head.length) {
        submit([this, &connection] { answer(connection); });
        connection.phase = Phase::answered;
    }
} catch (const std::bad_alloc&) {
    connection.is_over = true;
}

/// Sends a refusal, as a page to who types an address. Further bytes of the client are discarded until it has seen the
/// refusal.
void Server::refuse(Connection& connection, int status) {
    const bool is_page = connection.head.method == "GET";
    const std::string sentence = sentence_of(status);
    const std::string why = is_page
                                ? "<!doctype html><html lang=\"en\"><meta charset=\"utf-8\"><title>csgrt</title><p>" +
                                      sentence + ".</p></html>"
                                : R"({"error":")" + sentence + "\"}";
    const std::string text = head_of(status, is_page ? page_type : json_type, why.size(), true) + why;
    static_cast<void>(send(connection.socket, text.data(), text.size(), MSG_NOSIGNAL));
    shutdown(connection.socket, SHUT_WR);
    connection.phase = Phase::refused;
    connection.deadline = Clock::now() + to_notice;
    connection.bytes = {};
}

}  // namespace csgrt
