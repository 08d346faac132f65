#define CATCH_CONFIG_RUNNER
#include "catch.hpp"
#include "cli/cache_folder.hpp"
#include <cstdlib>
#include <string>

int main(int argc, char* argv[]) {
    // What ctest sets has precedence; an executable that is run by hand finds scenes and models, too.
    for (const std::string variable : {CSGRT_ENVIRONMENT}) {
        const std::size_t name_end = variable.find('=');
        setenv(variable.substr(0, name_end).c_str(), variable.c_str() + name_end + 1, 0);
    }
    csgrt::cli::ensure_cache_folder();
    return Catch::Session().run(argc, argv);
}
