# csgrt_embed_kernels(FOLDER OUTPUT [FUNCTION]): writes OUTPUT, a C++ file that holds every .h and .cl file under
# FOLDER as text. FUNCTION returns the table; its usual name is kernel_files, which src/device/kernel_source.hpp
# declares. Written anew when one of the files changes, appears or goes. The same file is the script that does it:
# cmake -DFOLDER=... -DOUTPUT=... -P embed.cmake
if(NOT CMAKE_SCRIPT_MODE_FILE)
    function(csgrt_embed_kernels folder output)
        set(function ${ARGN} kernel_files)
        list(GET function 0 function)
        file(GLOB_RECURSE files CONFIGURE_DEPENDS ${folder}/*.h ${folder}/*.cl)
        add_custom_command(
            OUTPUT ${output}
            COMMAND ${CMAKE_COMMAND} -DFOLDER=${folder} -DOUTPUT=${output} -DFUNCTION=${function}
                -P ${CMAKE_CURRENT_FUNCTION_LIST_FILE}
            DEPENDS ${files} ${CMAKE_CURRENT_FUNCTION_LIST_FILE}
            COMMENT "Embedding the kernels of ${folder}" VERBATIM)
    endfunction()
    return()
endif()

file(GLOB_RECURSE names RELATIVE ${FOLDER} ${FOLDER}/*.h ${FOLDER}/*.cl)
list(SORT names)
set(entries "")
foreach(name IN LISTS names)
    file(READ ${FOLDER}/${name} text)
    if(text MATCHES "\\)kernel\"")
        message(FATAL_ERROR "${name} holds the mark that ends an embedded text: )kernel\"")
    endif()
    string(APPEND entries "    {\"${name}\", R\"kernel(${text})kernel\"},\n")
endforeach()
file(WRITE ${OUTPUT} "// Made by cmake/embed.cmake from the kernels' own files; edit those.
#include \"device/kernel_source.hpp\"

namespace csgrt {

const std::vector<KernelFile>& ${FUNCTION}() {
    static const auto& files = *new const std::vector<KernelFile>{
${entries}    };
    return files;
}

}  // namespace csgrt
")
