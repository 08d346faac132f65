# The target csgrt_OpenImageIO; csgrt_has_openimageio: whether it is there; csgrt_picture_libraries: the libraries that
# it needs, in the order in which src/cli/late_image.cpp loads them, empty without ldd. OpenImageIO_ROOT and Imath_ROOT
# name folders to look in first. OpenImageIO's own package file is not used: it stops CMake where the tools of
# OpenImageIO or the headers of OpenCV are not installed. csgrt needs neither.
find_path(CSGRT_OpenImageIO_INCLUDE_DIR OpenImageIO/imageio.h HINTS ${OpenImageIO_ROOT} PATH_SUFFIXES include)
find_path(CSGRT_Imath_INCLUDE_DIR ImathConfig.h HINTS ${Imath_ROOT} PATH_SUFFIXES include/Imath Imath
          DOC "OpenImageIO's headers include Imath's")
find_library(CSGRT_OpenImageIO_LIBRARY OpenImageIO HINTS ${OpenImageIO_ROOT} PATH_SUFFIXES lib)
find_library(CSGRT_OpenImageIO_Util_LIBRARY OpenImageIO_Util HINTS ${OpenImageIO_ROOT} PATH_SUFFIXES lib)
mark_as_advanced(CSGRT_OpenImageIO_INCLUDE_DIR CSGRT_Imath_INCLUDE_DIR CSGRT_OpenImageIO_LIBRARY
    CSGRT_OpenImageIO_Util_LIBRARY)

set(csgrt_has_openimageio OFF)
if(CSGRT_OpenImageIO_LIBRARY AND CSGRT_OpenImageIO_Util_LIBRARY AND CSGRT_OpenImageIO_INCLUDE_DIR
   AND CSGRT_Imath_INCLUDE_DIR)
    set(csgrt_has_openimageio ON)
    cmake_path(GET CSGRT_Imath_INCLUDE_DIR PARENT_PATH imath_parent)
    add_library(csgrt_OpenImageIO UNKNOWN IMPORTED)
    set_target_properties(csgrt_OpenImageIO PROPERTIES
        IMPORTED_LOCATION ${CSGRT_OpenImageIO_LIBRARY}
        INTERFACE_INCLUDE_DIRECTORIES
            "${CSGRT_OpenImageIO_INCLUDE_DIR};${CSGRT_Imath_INCLUDE_DIR};${imath_parent}"
        INTERFACE_LINK_LIBRARIES ${CSGRT_OpenImageIO_Util_LIBRARY})
endif()

# ldd names a library before those that it alone needs.
set(csgrt_picture_libraries "")
if(csgrt_has_openimageio AND NOT CMAKE_CROSSCOMPILING)
    execute_process(COMMAND ldd ${CSGRT_OpenImageIO_LIBRARY} OUTPUT_VARIABLE needed ERROR_QUIET)
    string(REGEX MATCHALL "[^ \t\n]+ =>" names "${needed}")
    list(REVERSE names)
    list(TRANSFORM names REPLACE " =>" "")
    list(JOIN names " " csgrt_picture_libraries)
endif()
