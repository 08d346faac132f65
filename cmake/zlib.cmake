# The target csgrt_zlib; csgrt_has_zlib: whether it is there. Not FindZLIB, whose names a parent project would see.
find_path(CSGRT_zlib_INCLUDE_DIR zlib.h HINTS ${zlib_ROOT} PATH_SUFFIXES include)
find_library(CSGRT_zlib_LIBRARY z HINTS ${zlib_ROOT} PATH_SUFFIXES lib)
mark_as_advanced(CSGRT_zlib_INCLUDE_DIR CSGRT_zlib_LIBRARY)

set(csgrt_has_zlib OFF)
if(CSGRT_zlib_INCLUDE_DIR AND CSGRT_zlib_LIBRARY AND NOT CMAKE_CROSSCOMPILING)
    set(csgrt_has_zlib ON)
    add_library(csgrt_zlib INTERFACE IMPORTED)
    target_include_directories(csgrt_zlib SYSTEM INTERFACE ${CSGRT_zlib_INCLUDE_DIR})
    target_link_libraries(csgrt_zlib INTERFACE ${CSGRT_zlib_LIBRARY} Threads::Threads)
endif()
