# find_header_only(NAME HEADER): the interface target csgrt_NAME for a library that is headers alone.
# Looks in NAME_ROOT, CMAKE_PREFIX_PATH and the system; the headers of others raise no warnings here.
function(find_header_only name header)
    find_path(${name}_INCLUDE_DIR ${header} HINTS ${${name}_ROOT} PATH_SUFFIXES include
              DOC "Folder that holds ${header}")
    if(NOT ${name}_INCLUDE_DIR)
        message(FATAL_ERROR "${header} was not found: install ${name}, or give -D${name}_ROOT=FOLDER")
    endif()
    add_library(csgrt_${name} INTERFACE)
    target_include_directories(csgrt_${name} SYSTEM INTERFACE $<BUILD_INTERFACE:${${name}_INCLUDE_DIR}>)
endfunction()
