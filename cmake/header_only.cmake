# csgrt_find_header_only(NAME HEADER PACKAGE): the interface target csgrt_NAME for a library that is headers alone.
# Looks in NAME_ROOT, CMAKE_INCLUDE_PATH, CMAKE_PREFIX_PATH and the system; the headers of others raise no warnings
# here. Package files (find_package(NAME CONFIG)) do not do: a folder with nothing but the headers has none, and those
# of Debian and Ubuntu name /usr/include, which a cross compiler must not see.
function(csgrt_find_header_only name header package)
    find_path(CSGRT_${name}_INCLUDE_DIR ${header} HINTS ${${name}_ROOT} PATH_SUFFIXES include
              DOC "Folder that holds ${header}")
    if(NOT CSGRT_${name}_INCLUDE_DIR)
        message(FATAL_ERROR
            "${header} was not found: install ${package} (Debian, Ubuntu), or give -D${name}_ROOT=FOLDER")
    endif()
    set(folder ${CSGRT_${name}_INCLUDE_DIR})
    if(CMAKE_CROSSCOMPILING)  # the host's /usr/include has its C library, too: a link to these headers alone
        string(REGEX MATCH "^[^/]+" own ${header})
        set(links ${PROJECT_BINARY_DIR}/headers/${name})
        file(MAKE_DIRECTORY ${links})
        file(CREATE_LINK ${folder}/${own} ${links}/${own} SYMBOLIC)
        set(folder ${links})
    endif()
    add_library(csgrt_${name} INTERFACE)
    target_include_directories(csgrt_${name} SYSTEM INTERFACE $<BUILD_INTERFACE:${folder}>)
endfunction()
