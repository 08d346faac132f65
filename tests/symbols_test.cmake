# The symbols that libcsgrt.so exports are those of symbols.list: of C, and of C++ without what is weak (inline
# functions, templates) and what only the library uses (Impl).
# cmake -DLIBRARY=... -DNM=... -DREADELF=... -DLIST=... -DCOMPATIBLE=0.1 [-DUPDATE=ON] -P symbols_test.cmake
cmake_minimum_required(VERSION 3.25)
execute_process(COMMAND ${NM} -D --defined-only --format=posix ${LIBRARY}
    OUTPUT_VARIABLE symbols RESULT_VARIABLE result)
if(NOT result EQUAL 0)
    message(FATAL_ERROR "${NM} failed on ${LIBRARY}")
endif()
string(REGEX MATCHALL "[^\n]+ [TDBR] " symbols "${symbols}")
list(TRANSFORM symbols REPLACE " [TDBR] $" "")
list(FILTER symbols EXCLUDE REGEX "4Impl")
list(SORT symbols)
if(UPDATE)
    list(JOIN symbols "\n" text)
    file(WRITE ${LIST} "${text}\n")
endif()
file(STRINGS ${LIST} expected)
set(gone ${expected})
list(REMOVE_ITEM gone ${symbols})
list(REMOVE_ITEM symbols ${expected})
if(gone OR symbols)
    message(FATAL_ERROR "${LIST} is not what is exported (if that is meant: the target `symbols`).\n"
        "  no longer there: ${gone}\n  new: ${symbols}")
endif()

# Before version 1 a library of another minor version does not take this one's place.
execute_process(COMMAND ${READELF} -d ${LIBRARY} OUTPUT_VARIABLE dynamic)
if(NOT dynamic MATCHES "SONAME[^\n]*\\[libcsgrt\\.so\\.${COMPATIBLE}\\]")
    message(FATAL_ERROR "the SONAME is not libcsgrt.so.${COMPATIBLE}:\n${dynamic}")
endif()
