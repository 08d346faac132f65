// Threads that the system does not give: the command does its work with fewer, or says why it cannot.
#include "cli/fail_each.hpp"

using namespace command_test;

TEST_CASE("a thread that is not to be had changes no answer, or the command says what it lacks") {
    NEEDS_COMMAND();
    fail_each("CSGRT_FAIL_THREAD", 1, false, {5, 6, 7});
#ifdef CSGRT_HAVE_IMAGE
    fail_each("CSGRT_FAIL_THREAD", 1, true, {5, 6, 7});
#endif
}

#ifdef CSGRT_HAVE_IMAGE
TEST_CASE("threads that libraries do not get while they are loaded: the right answer, or what is lacking is said",
          "[.long]") {
    NEEDS_COMMAND();
    setenv("CSGRT_FAIL_THREAD_LOADS", "1", 1);
    fail_each("CSGRT_FAIL_THREAD", 1, true, {5, 6, 7});
    unsetenv("CSGRT_FAIL_THREAD_LOADS");
}
#endif
