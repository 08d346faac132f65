// csgrt view as a process: who attacks it, from outside and with the secret, what surrounds it, and how it ends.
#include <algorithm>
#include <atomic>
#include <chrono>
#include <random>
#include <thread>

#include "cli/command.hpp"
#include "page_client.hpp"
#include "sanitized.hpp"

using namespace csgrt::test;
using namespace command_test;
using namespace std::chrono_literals;

namespace {

using Clock = std::chrono::steady_clock;

class ViewProcess {
public:
    /// Waits until it has printed its address, or has ended.
    explicit ViewProcess(const std::vector<std::string>& more = {},
                         const std::vector<std::pair<std::string, std::string>>& environment = {}) {
        std::vector<std::string> words = {"view", folder_.write("balls.asc", two_balls), "--device", "native"};
        words.insert(words.end(), more.begin(), more.end());
        child_ = start(words, "/dev/null", folder_ / "out", folder_ / "err", 0, {}, 0, environment);
        const auto late = Clock::now() + 60s;
        while (!contains(address_ = read_file(folder_ / "out"), "\n") && Clock::now() < late) {
            int status = 0;
            if (waitpid(child_, &status, WNOHANG) == child_) {
                ended_ = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
                return;
            }
            std::this_thread::sleep_for(5ms);
        }
        address_.pop_back();
        const std::size_t slash = address_.find('/', std::string("http://").size());
        port_ = std::stoi(address_.substr(address_.rfind(':') + 1));
        root_ = address_.substr(slash);
        host_ = address_.substr(7, slash - 7);
    }
    ViewProcess(const ViewProcess&) = delete;
    ViewProcess& operator=(const ViewProcess&) = delete;
    ~ViewProcess() {
        if (ended_ < 0) end(SIGKILL);
    }

    bool is_up() const { return ended_ < 0; }
    pid_t process() const { return child_; }
    const std::string& address() const { return address_; }
    const std::string& host() const { return host_; }
    std::string root() const { return root_; }
    std::string api(const std::string& name) const { return root_ + "api/" + name; }
    HttpConnection connect(int patience_ms = 60'000) const { return HttpConnection(port_, patience_ms); }
    std::string printed_errors() const { return read_file(folder_ / "err"); }

    /// Asks as the owner does, by a connection of its own.
    int status() const {
        const auto answer = connect().ask("POST", api("status"), "{}");
        return answer ? answer->status : 0;
    }
    json frame(int size, int samples = 1, const std::string& page = "a") const {
        const json view = json::parse(connect().ask("POST", api("model"), "{}")->body)["view"];
        return {{"view", view}, {"width", size}, {"height", size},   {"samples", samples},
                {"page", page}, {"number", 1},   {"encoding", "raw"}};
    }
    std::string request(const std::string& name, const json& body) const {
        const std::string text = body.dump();
        return connect().text_of("POST", api(name), text.size()) + text;
    }
    long kilobytes() const {
        const std::string status = read_file("/proc/" + std::to_string(child_) + "/status");
        return std::atol(status.substr(status.find("VmRSS:") + 6).c_str());
    }
    int end(int signal) {
        kill(child_, signal);
        return ended_ = wait_for(child_);
    }
    int status_at_end() const { return ended_; }

private:
    Folder folder_;
    pid_t child_ = -1;
    int ended_ = -1, port_ = 0;
    std::string address_, root_, host_;
};

/// Whether the memory has stayed within so many megabytes.
bool is_within(const ViewProcess& view, long before, long megabytes) {
#ifdef CSGRT_SANITIZED  // they keep what is free
    return view.status() == 200;
#endif
    CAPTURE(before, view.kilobytes());
    return view.kilobytes() < before + megabytes * 1024;
}

std::string deep(std::size_t levels) {
    return R"({"view":{"camera":{},"looks":)" + std::string(levels, '[') + std::string(levels, ']') + "}}";
}

}  // namespace

TEST_CASE("view: heads and bodies without end are refused, and take no memory", "[view][promise:page]") {
    NEEDS_COMMAND();
    const ViewProcess view;
    REQUIRE(view.is_up());
    REQUIRE(view.status() == 200);
    const long before = view.kilobytes();
    const std::string get = "GET / HTTP/1.1\r\n", post = "POST " + view.api("model") +
                                                         " HTTP/1.1\r\nHost: " + view.host() +
                                                         "\r\nContent-Type: application/json\r\n";
    std::string headers;
    while (headers.size() < 1'000'000) headers += "A: a\r\n";
    const std::string letters(1'000'000, 'a');
    const auto refused = [&](const std::string& begin, const std::string& then) {
        auto stranger = view.connect();
        stranger.send(begin);
        for (int i = 0; i < 64 && stranger.send(then); ++i) {
        }
        const auto answer = stranger.receive();
        return answer ? answer->status : 0;
    };
    CHECK(refused("GET /", letters) == 431);
    CHECK(refused(get + "A: ", letters) == 431);
    CHECK(refused(get, headers) == 431);
    CHECK(refused(post + "Transfer-Encoding: chunked\r\n\r\n", "f4240\r\n" + letters + "\r\n") == 411);
    CHECK(refused(post + "\r\n", letters) == 411);
    CHECK(refused(post + "Content-Length: 520000000\r\n\r\n", letters) == 413);
    CHECK(refused(post + "Content-Length: 99999999999999999999999\r\n\r\n", letters) == 413);
    CHECK(is_within(view, before, 8));
    CHECK(view.status() == 200);
}

TEST_CASE("view: JSON that is nested without end is refused", "[view][promise:page]") {
    NEEDS_COMMAND();
    const ViewProcess view;
    REQUIRE(view.is_up());
    const auto status = [&](const std::string& body) {
        const auto answer = view.connect().ask("POST", view.api("command"), body);
        return answer ? answer->status : 0;
    };
    for (const std::size_t levels : {20u, 60'000u, 400'000u}) CHECK(status(deep(levels)) == 400);
    CHECK(status(std::string(100'000, '[')) == 400);
    CHECK(status(R"({"view":{"camera":)" + std::string(100'000, '[') + std::string(100'000, ']') + "}}") == 400);
    CHECK(view.status() == 200);
}

TEST_CASE("view: however many strangers are slow, the owner is answered", "[view][promise:page]") {
    NEEDS_COMMAND();
    const ViewProcess view;
    REQUIRE(view.is_up());
    REQUIRE(view.status() == 200);
    const long before = view.kilobytes();
    const auto start = Clock::now();
    std::vector<HttpConnection> strangers;
    for (int i = 0; i < 600; ++i) {  // more than there are places
        strangers.push_back(view.connect());
        strangers.back().send(i % 2 ? "G" : "GET / HTTP/1.1\r\nA: ");
    }
    const auto asked = Clock::now();
    CHECK(view.status() == 200);
    CHECK(Clock::now() - asked < 1s);
    CHECK(is_within(view, before, 64));
    // A byte every now and then is no way to stay.
    while (strangers.back().is_open() && Clock::now() - start < 20s) {
        std::this_thread::sleep_for(200ms);
        strangers.back().send("a");
    }
    CHECK(Clock::now() - start < 15s);
}

TEST_CASE("view: 2,000 requests that are forged, slow, deep, endless or cut, among 200 strangers",
          "[view][promise:page]") {
    NEEDS_COMMAND();
    const ViewProcess view;
    REQUIRE(view.is_up());
    const std::string frame = view.request("frame", view.frame(9));
    for (int i = 0; i < 50; ++i) view.connect().send(frame);  // threads and their memory come now
    REQUIRE(view.status() == 200);
    const long before = view.kilobytes();
    std::mt19937 random(20'261'128);
    std::vector<HttpConnection> strangers;
    for (int i = 0; i < 200; ++i) {
        strangers.push_back(view.connect());
        strangers.back().send("POST ");
    }
    for (int i = 0; i < 2000; ++i) {
        auto one = view.connect(200);
        switch (random() % 5) {
            case 0: {  // forged
                const std::vector<Headers> headers = {
                    {}, {{"Host", "evil.example"}}, {{"Origin", "null"}}, {{"Host", ""}}};
                const std::string path = random() % 2 ? view.api("model") : "/" + std::string(32, '0') + "/api/model";
                const Headers& chosen = headers[random() % headers.size()];
                const auto answer = one.ask("POST", path, "{}", chosen);
                REQUIRE(answer);
                CHECK((answer->status == 200) == (path == view.api("model") && chosen.empty()));
                break;
            }
            case 1: {  // slow
                strangers[random() % strangers.size()].send("a");
                one.send(frame.substr(0, random() % 40));
                break;
            }
            case 2:
                one.send(view.connect().text_of("POST", view.api("command"), 12'000) + deep(6000));
                break;
            case 3:
                one.send("POST /" + std::string(random() % 200'000, 'a'));
                break;
            default:
                one.send(frame.substr(0, random() % frame.size()));
        }
        if (i % 100 == 0) {
            const auto asked = Clock::now();
            CHECK(view.status() == 200);
            CHECK(Clock::now() - asked < 1s);
        }
    }
    CHECK(is_within(view, before, 64));
}

TEST_CASE("view: 64 pages that poll, and 64 that wait for frames, leave a 65th its turn", "[view][promise:page]") {
    NEEDS_COMMAND();
    const ViewProcess view;
    REQUIRE(view.is_up());
    std::vector<HttpConnection> pages;
    for (int i = 0; i < 64; ++i) pages.push_back(view.connect());
    for (int round = 0; round < 3; ++round) {
        for (HttpConnection& page : pages) CHECK(page.ask("POST", view.api("status"), "{}")->status == 200);
        CHECK(view.status() == 200);
    }
    for (int i = 0; i < 64; ++i) pages[i].send(view.request("frame", view.frame(96, 1, std::to_string(i))));
    CHECK(view.connect().ask("POST", view.api("frame"), view.frame(96, 1, "last").dump())->body.size() > 96 * 96 * 4);
    for (HttpConnection& page : pages) CHECK(page.receive()->body.size() > 96 * 96 * 4);
}

TEST_CASE("view: pages that wait for large frames share memory", "[view][promise:page]") {
    NEEDS_COMMAND();
    const ViewProcess view;
    REQUIRE(view.is_up());
    CHECK(view.connect().ask("POST", view.api("frame"), view.frame(2000).dump())->status == 200);
    const long before = view.kilobytes();
    std::atomic<int> left = 60, whole = 0;
    std::vector<std::jthread> pages;
    const json request = view.frame(2000);
    for (int i = 0; i < 60; ++i)
        pages.emplace_back([&, own = request, i]() mutable {
            own["page"] = std::to_string(i);
            const auto answer = view.connect().ask("POST", view.api("frame"), own.dump());
            whole += answer && answer->body.size() > 2000 * 2000 * 4;
            --left;
        });
    long most = before;
    for (; left > 0; std::this_thread::sleep_for(5ms)) most = std::max(most, view.kilobytes());
    CHECK(whole == 60);
    CAPTURE(before, most);
#ifndef CSGRT_SANITIZED
    CHECK(most < before + 256 * 1024);  // two Renderers have memory for a picture, and four answers
#endif
}

TEST_CASE("view: an export ends when its page leaves, and at a signal", "[view][promise:page]") {
    NEEDS_COMMAND();
    for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
        ViewProcess view;
        REQUIRE(view.is_up());
        const json large = view.frame(4000, 16);
        for (const char* kind : {"exr", "slice"}) {
            json request = large;
            request.update({{"center", {0, 0, 0}}, {"right", {0.01, 0, 0}}, {"up", {0, 0.01, 0}}});
            view.connect(300).ask("POST", view.api(kind), request.dump());  // leaves
            CHECK(view.connect(5000).ask("POST", view.api("frame"), view.frame(16).dump()));
        }
        auto waiting = view.connect();
        waiting.send(view.request("exr", large));
        std::this_thread::sleep_for(300ms);
        const auto start = Clock::now();
        CHECK(view.end(signal) == 130);
        CHECK(Clock::now() - start < 2s);
    }
}

TEST_CASE("view: the browser gets the address by a file that nobody else can read", "[view][promise:page]") {
    NEEDS_COMMAND();
    const Folder folder;
    const std::string program = folder.write("xdg-open",
                                             "#!/bin/sh\n{ echo \"$@\"; stat -c %a \"${1%/*}\"; cat \"$1\"; } > "
                                             "\"$TOLD.new\"; mv \"$TOLD.new\" \"$TOLD\"\n");
    fs::permissions(program, fs::perms::owner_all);
    const std::string told = folder / "told";
    ViewProcess view({"--open"}, {{"PATH", (folder / "") + ":" + std::getenv("PATH")}, {"TOLD", told}});
    REQUIRE(view.is_up());
    const std::string children =
        "/proc/" + std::to_string(view.process()) + "/task/" + std::to_string(view.process()) + "/children";
    for (int i = 0; i < 1000 && (!fs::exists(told) || !read_file(children).empty()); ++i)
        std::this_thread::sleep_for(10ms);
    CHECK(read_file(children).empty());
    std::ifstream lines(told);
    std::string arguments, mode, text;
    std::getline(lines, arguments);
    std::getline(lines, mode);
    std::getline(lines, text, '\0');
    CHECK(!contains(arguments, view.root().substr(1, 8)));
    CHECK(mode == "700");
    CHECK(contains(text, "url=" + view.address()));
    CHECK(view.end(SIGTERM) == 130);
    CHECK(!fs::exists(arguments));
}

TEST_CASE("view: with all interfaces, the address can be opened, and others are told of", "[view][promise:page]") {
    NEEDS_COMMAND();
    const ViewProcess view({"--address", "0.0.0.0"});
    REQUIRE(view.is_up());
    CHECK(!view.host().starts_with("0.0.0.0"));
    CHECK(contains(view.printed_errors(), "warning: other machines can connect"));
    CHECK(view.connect().ask("POST", view.api("status"), "{}", {{"Host", view.host()}})->status == 200);
    const ViewProcess own;
    CHECK(own.printed_errors() == "");
}

TEST_CASE("view: a thread that is not to be had: the page answers all the same, or csgrt says so",
          "[view][promise:page]") {
    NEEDS_COMMAND();
    const char* library = std::getenv("CSGRT_FAIL_LIBRARY");
    if (library == nullptr) {
        WARN("CSGRT_FAIL_LIBRARY names no library: skipped");
        return;
    }
    const Folder folder;
    const std::string told = folder / "told";
    int runs = 0, refused = 0;
    for (const bool on : {false, true})
        for (int number = 1; number < 80; ++number) {
            std::vector<std::pair<std::string, std::string>> environment = {
                {"LD_PRELOAD", library},
                {"CSGRT_FAIL_THREAD", std::to_string(number)},
                {"CSGRT_FAIL_THREAD_TOLD", told}};
            if (on) environment.emplace_back("CSGRT_FAIL_THREAD_ON", "1");
            fs::remove(told);
            ViewProcess view({"--threads", "3"}, environment);
            CAPTURE(number, on, view.printed_errors());
            if (view.is_up()) {
                CHECK(view.connect().ask("POST", view.api("frame"), view.frame(64).dump())->body.size() > 64 * 64 * 4);
                CHECK(view.end(SIGTERM) == 130);
            } else {
                ++refused;
                CHECK(view.status_at_end() == 6);
                CHECK(contains(view.printed_errors(), "csgrt: error: "));
            }
            if (!fs::exists(told)) break;
            ++runs;
        }
    CHECK(runs > 2);
    CHECK(refused > 0);
}
