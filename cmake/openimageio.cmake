# OpenImageIO as the interface target csgrt_openimageio; CSGRT_OPENIMAGEIO_FOUND says whether there is one.
# Looked for by its headers and libraries. The package file that comes with it stops CMake where the tools of
# OpenImageIO or the headers of OpenCV are not installed, neither of which csgrt needs.
find_path(OpenImageIO_INCLUDE_DIR OpenImageIO/imageio.h HINTS ${OpenImageIO_ROOT} PATH_SUFFIXES include)
find_path(Imath_INCLUDE_DIR ImathConfig.h HINTS ${Imath_ROOT} PATH_SUFFIXES include/Imath Imath
          DOC "OpenImageIO's headers include Imath's")
find_library(OpenImageIO_LIBRARY OpenImageIO HINTS ${OpenImageIO_ROOT} PATH_SUFFIXES lib)
find_library(OpenImageIO_Util_LIBRARY OpenImageIO_Util HINTS ${OpenImageIO_ROOT} PATH_SUFFIXES lib)

set(CSGRT_OPENIMAGEIO_FOUND OFF)
if(OpenImageIO_INCLUDE_DIR AND Imath_INCLUDE_DIR AND OpenImageIO_LIBRARY AND OpenImageIO_Util_LIBRARY)
    set(CSGRT_OPENIMAGEIO_FOUND ON)
    add_library(csgrt_openimageio INTERFACE)
    cmake_path(GET Imath_INCLUDE_DIR PARENT_PATH imath_parent)
    target_include_directories(csgrt_openimageio SYSTEM INTERFACE
        ${OpenImageIO_INCLUDE_DIR} ${Imath_INCLUDE_DIR} ${imath_parent})
    target_link_libraries(csgrt_openimageio INTERFACE ${OpenImageIO_LIBRARY} ${OpenImageIO_Util_LIBRARY})
endif()
