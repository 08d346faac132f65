// Requests at random: no crash, no memory lost, no file opened. The system tells of files: from the first request on, a
// call that opens one ends in a handler that counts it.
#include <fcntl.h>

#include <cerrno>
#include <csignal>
#include <cstddef>
#include <cstdlib>
#include <random>

#include <linux/filter.h>
#include <linux/seccomp.h>
#include <netinet/in.h>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <csgrt/scene_io.hpp>

#include "catch.hpp"
#include "page_client.hpp"

using namespace csgrt;
using namespace csgrt::test;

namespace {

// The sanitizers find what is lost, and open files themselves.
#if defined __SANITIZE_ADDRESS__
constexpr bool is_sanitized = true;
#elif defined __has_feature
constexpr bool is_sanitized = __has_feature(address_sanitizer);
#else
constexpr bool is_sanitized = false;
#endif

volatile std::sig_atomic_t opened = 0;
char last_path[256];  ///< that was opened

/// For all threads, until the process ends.
bool watch_files() {
    struct sigaction action {};
    action.sa_sigaction = [](int, siginfo_t*, void* context) {
#ifdef __x86_64__
        auto& registers = static_cast<ucontext_t*>(context)->uc_mcontext.gregs;
        const auto* const path = reinterpret_cast<const char*>(registers[REG_RSI]);
        registers[REG_RAX] = -EACCES;
        // The C library counts processors, for the memory of a thread.
        if (std::strcmp(path, "/sys/devices/system/cpu/online") == 0 || std::strcmp(path, "/proc/stat") == 0) return;
        std::strncpy(last_path, path, sizeof last_path - 1);
#endif
        opened = opened + 1;
    };
    action.sa_flags = SA_SIGINFO;
    sigaction(SIGSYS, &action, nullptr);
    sock_filter filter[] = {BPF_STMT(BPF_LD | BPF_W | BPF_ABS, offsetof(seccomp_data, nr)),
                            BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, SYS_openat, 1, 0),
                            BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_ALLOW), BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_TRAP)};
    const sock_fprog program{4, filter};
    return prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) == 0 &&
           syscall(SYS_seccomp, SECCOMP_SET_MODE_FILTER, SECCOMP_FILTER_FLAG_TSYNC, &program) == 0;
}

long resident_kilobytes(int file) {
    char text[4096] = {};
    if (pread(file, text, sizeof text - 1, 0) <= 0) return 0;
    const char* const line = std::strstr(text, "VmRSS:");
    return line ? std::atol(line + 6) : 0;
}

using Random = std::mt19937;

std::string noise(Random& random, std::size_t most) {
    std::string bytes(random() % (most + 1), '\0');
    for (char& c : bytes) c = static_cast<char>(random());
    return bytes;
}

const std::string& one_of(Random& random, const std::vector<std::string>& list) { return list[random() % list.size()]; }

/// A right request, of which in most cases something is changed.
std::string request(Random& random, const std::string& root, const std::string& host, const std::string& view) {
    static const std::vector<std::string> methods = {"POST", "GET", "HEAD", "PUT", "DELETE", "OPTIONS", "PRI", "\x01"};
    static const std::vector<std::string> names = {"model",   "status", "frame", "pick",  "slice",
                                                   "command", "exr",    "parts", "check", "x"};
    static const std::vector<std::string> paths = {"/etc/passwd", "/../../etc/passwd", "//", "/%2e%2e/%00", "*",
                                                   "http:"};
    static const std::vector<std::string> headers = {"Content-Length: 18446744073709551615",
                                                     "Content-Length: -1",
                                                     "Transfer-Encoding: chunked",
                                                     "Expect: 100-continue",
                                                     "Range: bytes=0-1,5-9,-3",
                                                     "Content-Encoding: gzip",
                                                     "Content-Type: multipart/form-data; boundary=x",
                                                     "Host: a",
                                                     ":",
                                                     "Connection: close",
                                                     "Accept-Encoding: gzip, br"};
    static const std::vector<std::string> values = {"1e999", "-1", "null", "[]", "{}", "\"\"", "1e300", "0", "true"};
    std::string body = R"({"page":"r","number":)" + std::to_string(random() % 1000) +
                       R"(,"samples":1,"encoding":"raw","width":9,"height":7,"x":3,"y":2,"center":[0,0,0],)"
                       R"("generation":1,"parts":[{"regions":[[0,2],[3,4]]}],"right":[9,0,0],"up":[0,9,0],"view":)" +
                       view + "}";
    if (random() % 2) {  // another value somewhere
        const std::size_t colon = body.find(':', random() % body.size());
        if (colon != body.npos) body.replace(colon + 1, random() % 12, one_of(random, values));
    }
    if (random() % 8 == 0) body = noise(random, 300);
    if (random() % 32 == 0) body = std::string(random() % 200'000, '[');
    std::string path = random() % 8 ? root + "api/" + one_of(random, names) : root;
    if (random() % 8 == 0) path = one_of(random, paths) + noise(random, 9);
    if (random() % 64 == 0) path += std::string(random() % 20'000, 'a');
    std::string text = (random() % 4 ? methods[0] : one_of(random, methods)) + " " + path +
                       " HTTP/1.1\r\nHost: " + host + "\r\nContent-Type: application/json\r\n";
    if (random() % 4 == 0) text += one_of(random, headers) + "\r\n";
    if (random() % 32 == 0) text += noise(random, 100) + "\r\n";
    const std::size_t length = random() % 8 ? body.size() : random() % (2 * body.size() + 1);
    text += "Content-Length: " + std::to_string(length) + "\r\n\r\n" + body;
    if (random() % 8 == 0) text.resize(random() % text.size());
    return text;
}

/// Sends it, and reads a part of the answer or none.
void send_to(int port, const std::string& text, Random& random) {
    const int client = socket(AF_INET, SOCK_STREAM, 0);
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(static_cast<std::uint16_t>(port));
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    const timeval patience{0, 20'000};  // an incomplete request has no answer
    setsockopt(client, SOL_SOCKET, SO_RCVTIMEO, &patience, sizeof patience);
    if (connect(client, reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0) {
        char bytes[4096];
        const bool is_sent = send(client, text.data(), text.size(), MSG_NOSIGNAL) == static_cast<ssize_t>(text.size());
        if (is_sent && random() % 4) static_cast<void>(!recv(client, bytes, sizeof bytes, 0));
        if (random() % 4 == 0) {  // no goodbye: the other end sees a reset
            const linger hard{1, 0};
            setsockopt(client, SOL_SOCKET, SO_LINGER, &hard, sizeof hard);
        }
    }
    close(client);
}

}  // namespace

TEST_CASE("view: requests at random do no harm", "[.requests][promise:page][promise:untrusted]") {
    const char* const wanted = std::getenv("CSGRT_REQUESTS");
    const int count = wanted ? std::atoi(wanted) : 3000;
    const PageClient page(Model(load_scene(std::getenv("CSGRT_SCENES") + std::string("/operators.json"))));
    const std::string view = page.ask("model")["view"].dump(), host = page.host().substr(std::strlen("http://"));
    const int memory = open("/proc/self/status", O_RDONLY | O_CLOEXEC);
    Random random(20'261'128);
    const auto send_some = [&](int some) {
        for (int i = 0; i < some; ++i) send_to(page.port(), request(random, page.root(), host, view), random);
    };
    send_some(count / 3);  // threads and their memory come now
    if (!is_sanitized) REQUIRE(watch_files());
    const long before = resident_kilobytes(memory);
    send_some(count - count / 3);
    if (!is_sanitized) {
        const long after = resident_kilobytes(memory);
        CAPTURE(before, after, std::string(last_path));
        // 64 threads take some memory each when they are first busy; what is lost grows with the requests.
        if (count >= 100'000) CHECK(after < before + 60'000);
        CHECK(opened == 0);
        CHECK(open("/proc/self/status", O_RDONLY) < 0);
        CHECK(opened == 1);  // so it would have been seen
    }
    CHECK(page.ask("model")["generation"] == 1);
    close(memory);
}
