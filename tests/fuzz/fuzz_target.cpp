// The function that libFuzzer calls with bytes of its own making. The variable CSGRT_FUZZ names the reader that gets
// them: rays, view, request (of the page), or else that of scenes (.json, .asc, .g: the bytes tell). A scene that is
// read is compiled, and the reference traces rays through it, unless CSGRT_FUZZ is "parse". An Error is a right answer.
// All else ends the program: another exception, a finding of the sanitizers, many seconds without an answer (-timeout).
#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <string_view>

#include <sys/mman.h>
#include <unistd.h>

#include <csgrt/renderer.hpp>
#include <csgrt/scene_io.hpp>

#include "cli/text/rays.hpp"
#include "formats/brlcad/view_script.hpp"
#ifdef CSGRT_HAVE_VIEW
#include "form/written_back.hpp"
#include "view/page_request.hpp"
#include "view/request_head.hpp"
#endif

using namespace csgrt;

namespace {

/// A few solids: more say nothing new about the code, and take time.
constexpr std::uint32_t most_instances = 200;

std::uint64_t were_read = 0, were_shot_at = 0;

void print_counts() {
    std::fprintf(stderr, "csgrt: %llu read without an error, %llu of them shot at\n",
                 static_cast<unsigned long long>(were_read), static_cast<unsigned long long>(were_shot_at));
}

void shoot_at(const Scene& scene) {
    Settings settings{.reference = true, .threads = 1};
    settings.skip_unsupported = true;
    settings.max_instances = most_instances;
    static_cast<void>(
        Renderer(scene, {}, settings).shoot({{{0.1, 0.2, -1e4}, {0, 0, 1}}, {{-9, -8, -7}, {1, 0.9, 0.8}}}));
    ++were_shot_at;
}

void read_rays(std::string_view bytes) {
    const int file = memfd_create("rays", 0);
    if (file < 0 || write(file, bytes.data(), bytes.size()) < 0 || lseek(file, 0, SEEK_SET) < 0) std::abort();
    try {
        cli::RayReader reader("/dev/fd/" + std::to_string(file));
        std::vector<Ray> rays;
        while (reader.next(rays, 7)) {
        }
    } catch (...) {
        close(file);
        throw;
    }
    close(file);
}

/// A body is read whatever its head is: else few would be.
void read_request(std::string_view bytes) {
#ifdef CSGRT_HAVE_VIEW
    static const Guard guard("127.0.0.1", std::string(32, '0'));
    const std::size_t end = std::min(bytes.find("\r\n\r\n"), bytes.size()), body = std::min(end + 4, bytes.size());
    RequestHead head;
    if (read_request_head(bytes.substr(0, body), head) == 0 && guard.refusal(head) == 0 && body_refusal(head) == 0 &&
        (head.host.empty() || head.is_in_pieces || head.length > most_body_bytes ||
         head.path.size() < guard.root().size()))
        std::abort();  // what the server relies on
    const Request request{std::string(bytes.substr(body))};
    const PageView page = read_page_view(request);
    static_cast<void>(drawing_options(page.view, page.looks));
    static_cast<void>(read_slice(request));
#else
    static_cast<void>(bytes);
#endif
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static const std::string_view reader = [] {
        std::atexit(print_counts);
        const char* const name = std::getenv("CSGRT_FUZZ");
        return name ? name : "";
    }();
    std::string bytes(reinterpret_cast<const char*>(data), size);
    try {
        if (reader == "rays") {
            read_rays(bytes);
            ++were_read;
        } else if (reader == "view") {
            static_cast<void>(parse_view_script(TextSource("view", std::move(bytes))));
            ++were_read;
        } else if (reader == "request") {
            read_request(bytes);
            ++were_read;
        } else {
            const Scene scene = parse_scene(std::move(bytes), "scene");
            ++were_read;
            if (reader != "parse") shoot_at(scene);
        }
    } catch (const Error&) {
    }
    return 0;
}
