#define CATCH_CONFIG_RUNNER
#include "catch.hpp"
#include "cli/cache_folder.hpp"

int main(int argc, char* argv[]) {
    csgrt::cli::ensure_cache_folder();
    return Catch::Session().run(argc, argv);
}
