# What most files include is read once. A compiler cache does not keep what is compiled so; with one every file reads
# it.
set(CSGRT_COMMON_HEADERS <algorithm> <array> <cmath> <cstdint> <functional> <limits> <map> <memory> <optional> <sstream>
    <string> <string_view> <unordered_map> <utility> <variant> <vector> <csgrt/scene.hpp>)
if(CSGRT_TOGETHER AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
    file(CONFIGURE OUTPUT common.cpp CONTENT "")
    add_library(csgrt_common OBJECT ${CMAKE_CURRENT_BINARY_DIR}/common.cpp)
    csgrt_target_options(csgrt_common)
    target_include_directories(csgrt_common PRIVATE ${PROJECT_SOURCE_DIR}/include)
    target_precompile_headers(csgrt_common PRIVATE ${CSGRT_COMMON_HEADERS})
endif()

# For libraries: the code of executables is compiled with other options.
function(csgrt_precompile target)
    if(TARGET csgrt_common)
        target_precompile_headers(${target} REUSE_FROM csgrt_common)
    endif()
endfunction()
