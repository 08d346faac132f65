// What a host notices of csgrt::image.
#include "cli/command.hpp"
#include "host/host_states.hpp"
#include "host/process.hpp"

using namespace csgrt;
using namespace csgrt::test;

namespace {

/// Large enough for OpenImageIO to compress it with threads.
Image large_picture() {
    return Renderer(small_scene(), {}, on("reference")).render({.width = 256, .height = 256, .every_partition = false});
}

/// The files that csgrt writes of it, and whether reading gives the same picture again.
std::string written(const Image& image, const std::string& folder, bool& is_read) {
    std::string bytes;
    for (const std::string name : {"a.exr", "a.png"}) {
        write_image(image, folder + name);
        bytes += command_test::read_file(folder + name);
    }
    is_read = read_image(folder + "a.exr").channels == image.channels;
    return bytes;
}

}  // namespace

TEST_CASE("whatever the host's floating-point state, pictures have the same bytes", "[image]") {
    require_good("csgrt::image", [] {
        const command_test::Folder temporary;
        const std::string folder = temporary / "";
        const Image image = large_picture();
        bool is_read = false;
        const std::string usual = written(image, folder, is_read);
        REQUIRE(is_read);
        for (const HostState& host : host_states) {
            INFO(host.name);
            bool is_kept = false;
            const std::string bytes = [&] {
                const InState state(host);
                const test::State before;
                const std::string mine = written(image, folder, is_read);
                is_kept = test::State() == before;
                return mine;
            }();
            REQUIRE((bytes == usual));
            REQUIRE(is_read);
            REQUIRE(is_kept);
        }
    });
}

TEST_CASE("threads that are started to write a picture leave all signals to the host's", "[image]") {
    require_good("csgrt::image", [] {
        const command_test::Folder temporary;
        const std::string folder = temporary / "";
        const Image image = large_picture();
        const std::set<std::string> before = threads();
        bool is_read = false;
        written(image, folder, is_read);
        REQUIRE(is_read);
        require_silent_threads(before);
    });
}

TEST_CASE("pictures are read and written by the process that does so first, not by its later children", "[image]") {
    require_good("csgrt::image", [] {
        const command_test::Folder temporary;
        const std::string folder = temporary / "";
        const Image image = large_picture();
        bool is_read = false;
        REQUIRE(status_of([&] { written(image, folder, is_read); }) == 0);  // nothing was written here
        written(image, folder, is_read);
        REQUIRE(status_of([&] {
                    REQUIRE_THROWS_WITH(write_image(image, folder + "b.png"),
                                        ContainsSubstring("before this process was forked"));
                    REQUIRE_THROWS_WITH(read_image(folder + "a.exr"),
                                        ContainsSubstring("before this process was forked"));
                }) == 0);
    });
}
