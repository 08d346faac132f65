# libFuzzer for the readers, with the sanitizers of Clang.
if(CSGRT_SANITIZE AND CMAKE_CXX_COMPILER_ID MATCHES "Clang" AND TARGET csgrt_cli_objects)
    add_executable(csgrt_fuzz fuzz/fuzz_target.cpp)
    csgrt_target_options(csgrt_fuzz)
    target_link_options(csgrt_fuzz PRIVATE -fsanitize=fuzzer)
    target_link_libraries(csgrt_fuzz PRIVATE csgrt_core csgrt_cli_objects
        $<TARGET_NAME_IF_EXISTS:csgrt_image_objects> $<TARGET_NAME_IF_EXISTS:csgrt_view_objects>)
    add_dependencies(csgrt_memory_tests csgrt_fuzz)
    set(fuzzed json asc g rays view)
    if(CSGRT_VIEW)
        target_compile_definitions(csgrt_fuzz PRIVATE CSGRT_HAVE_VIEW)
        list(APPEND fuzzed request)
    endif()
    # The readers' own words.
    set(words "")
    file(GLOB_RECURSE readers CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/src/formats/*.cpp
        ${PROJECT_SOURCE_DIR}/src/view/page_request.cpp ${PROJECT_SOURCE_DIR}/src/view/request_head.cpp)
    foreach(reader IN LISTS readers)
        file(STRINGS ${reader} lines REGEX "\"[A-Za-z_0-9-]+\"")
        string(REGEX MATCHALL "\"[A-Za-z_0-9-]+\"" found "${lines}")
        list(APPEND words ${found})
    endforeach()
    list(REMOVE_DUPLICATES words)
    list(JOIN words "\n" words)
    set(dictionary ${CMAKE_CURRENT_BINARY_DIR}/fuzz/words.dict)
    file(GENERATE OUTPUT ${dictionary} CONTENT "${words}\n")
    # What longer runs have found, reduced to what reaches more code; see coverage.cmake.
    set(corpus ${CMAKE_CURRENT_BINARY_DIR}/fuzz/corpus)
    file(ARCHIVE_EXTRACT INPUT ${CMAKE_CURRENT_SOURCE_DIR}/fuzz/corpus.txz DESTINATION ${corpus})
    foreach(reader IN LISTS fuzzed)
        set(found ${CMAKE_CURRENT_BINARY_DIR}/fuzz/${reader})  # what libFuzzer adds to the seeds
        file(MAKE_DIRECTORY ${found} ${corpus}/${reader})
        set(seeds ${CMAKE_CURRENT_SOURCE_DIR}/fuzz/seeds/${reader})
        set(command csgrt_fuzz -timeout=20 -rss_limit_mb=2048 -print_final_stats=1 -verbosity=0 -print_funcs=0
            -dict=${dictionary} -artifact_prefix=${found}_ ${found} ${seeds})
        set(more ${corpus}/${reader})  # to be read takes them a minute
        if(reader STREQUAL "json")
            list(APPEND more ${PROJECT_SOURCE_DIR}/scenes ${PROJECT_SOURCE_DIR}/scenes/broken)
        endif()
        add_test(NAME fuzz/${reader} COMMAND ${command} -max_total_time=5)
        add_test(NAME fuzz/hour/${reader} CONFIGURATIONS Long COMMAND ${command} ${more} -max_total_time=3600)
        set_tests_properties(fuzz/${reader} fuzz/hour/${reader} PROPERTIES ENVIRONMENT "CSGRT_FUZZ=${reader}")
        set_tests_properties(fuzz/${reader} PROPERTIES LABELS memory)
        set_tests_properties(fuzz/hour/${reader} PROPERTIES LABELS fuzz TIMEOUT 4000)
    endforeach()
    add_test(NAME fuzz/coverage CONFIGURATIONS Long COMMAND ${CMAKE_COMMAND} -DROOT=${PROJECT_SOURCE_DIR}
        -DGENERATOR=${CMAKE_GENERATOR} -DWORK=${CMAKE_CURRENT_BINARY_DIR}/coverage
        -P ${CMAKE_CURRENT_SOURCE_DIR}/fuzz/coverage.cmake)
    set_tests_properties(fuzz/coverage PROPERTIES LABELS fuzz TIMEOUT 3600 SKIP_REGULAR_EXPRESSION "SKIPPED:")
endif()
