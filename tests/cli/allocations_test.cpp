// Memory ends somewhere in the command: it says so with status 5, or gives the right answer.
#include "cli/fail_each.hpp"

using namespace command_test;

TEST_CASE("an allocation that fails ends the command with status 5 or changes nothing, and the old file stays") {
    NEEDS_COMMAND();
    fail_each("CSGRT_FAIL_NEW", 50, false, {5});
}

TEST_CASE("each allocation that fails ends the command with status 5 or changes nothing", "[.long]") {
    NEEDS_COMMAND();
    fail_each("CSGRT_FAIL_NEW", 1, false, {5});
}

#ifdef CSGRT_HAVE_IMAGE
// 6: what OpenImageIO says of it need not be that.
TEST_CASE("an allocation that fails where pictures are read or written is an error or changes nothing") {
    NEEDS_COMMAND();
    fail_each("CSGRT_FAIL_NEW", 1000, true, {5, 6});
}

TEST_CASE("every tenth allocation that fails where pictures are read or written is an error or changes nothing",
          "[.long]") {
    NEEDS_COMMAND();
    fail_each("CSGRT_FAIL_NEW", 10, true, {5, 6});
}
#endif
