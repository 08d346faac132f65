# find_package(OpenImageIO MODULE): the target OpenImageIO::OpenImageIO. OpenImageIO_ROOT and Imath_ROOT name folders to
# look in first. OpenImageIO's own package file is not used: it stops CMake where the tools of OpenImageIO or the
# headers of OpenCV are not installed. csgrt needs neither.
include(FindPackageHandleStandardArgs)

find_path(OpenImageIO_INCLUDE_DIR OpenImageIO/imageio.h)
find_path(Imath_INCLUDE_DIR ImathConfig.h HINTS ${Imath_ROOT} PATH_SUFFIXES include/Imath Imath
          DOC "OpenImageIO's headers include Imath's")
find_library(OpenImageIO_LIBRARY OpenImageIO)
find_library(OpenImageIO_Util_LIBRARY OpenImageIO_Util)
mark_as_advanced(OpenImageIO_INCLUDE_DIR Imath_INCLUDE_DIR OpenImageIO_LIBRARY OpenImageIO_Util_LIBRARY)

find_package_handle_standard_args(OpenImageIO REQUIRED_VARS
    OpenImageIO_LIBRARY OpenImageIO_Util_LIBRARY OpenImageIO_INCLUDE_DIR Imath_INCLUDE_DIR)

if(OpenImageIO_FOUND AND NOT TARGET OpenImageIO::OpenImageIO)
    cmake_path(GET Imath_INCLUDE_DIR PARENT_PATH imath_parent)
    add_library(OpenImageIO::OpenImageIO UNKNOWN IMPORTED)
    set_target_properties(OpenImageIO::OpenImageIO PROPERTIES
        IMPORTED_LOCATION ${OpenImageIO_LIBRARY}
        INTERFACE_INCLUDE_DIRECTORIES "${OpenImageIO_INCLUDE_DIR};${Imath_INCLUDE_DIR};${imath_parent}"
        INTERFACE_LINK_LIBRARIES ${OpenImageIO_Util_LIBRARY})
endif()
