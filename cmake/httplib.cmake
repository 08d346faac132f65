# The target csgrt_httplib, cpp-httplib with zlib; csgrt_has_httplib: whether both are there. The library is headers, or
# as Debian has it a header and a library, which was compiled with options that its users must have, too: the layout of
# its classes depends on them.
find_path(CSGRT_httplib_INCLUDE_DIR httplib.h HINTS ${httplib_ROOT} PATH_SUFFIXES include)
find_library(CSGRT_httplib_LIBRARY cpp-httplib HINTS ${httplib_ROOT} PATH_SUFFIXES lib)
# Not FindZLIB, whose names a parent project would see.
find_path(CSGRT_zlib_INCLUDE_DIR zlib.h HINTS ${zlib_ROOT} PATH_SUFFIXES include)
find_library(CSGRT_zlib_LIBRARY z HINTS ${zlib_ROOT} PATH_SUFFIXES lib)
mark_as_advanced(CSGRT_httplib_INCLUDE_DIR CSGRT_httplib_LIBRARY CSGRT_zlib_INCLUDE_DIR CSGRT_zlib_LIBRARY)

set(csgrt_has_httplib OFF)
if(CSGRT_httplib_INCLUDE_DIR AND CSGRT_zlib_INCLUDE_DIR AND CSGRT_zlib_LIBRARY AND NOT CMAKE_CROSSCOMPILING)
    set(csgrt_has_httplib ON)
    add_library(csgrt_httplib INTERFACE IMPORTED)
    target_include_directories(csgrt_httplib SYSTEM INTERFACE
        ${CSGRT_httplib_INCLUDE_DIR} ${CSGRT_zlib_INCLUDE_DIR})
    target_link_libraries(csgrt_httplib INTERFACE ${CSGRT_zlib_LIBRARY} Threads::Threads)
    if(CSGRT_httplib_LIBRARY)
        target_link_libraries(csgrt_httplib INTERFACE ${CSGRT_httplib_LIBRARY})
        target_compile_definitions(csgrt_httplib INTERFACE
            CPPHTTPLIB_OPENSSL_SUPPORT CPPHTTPLIB_ZLIB_SUPPORT CPPHTTPLIB_BROTLI_SUPPORT)
    endif()
endif()
