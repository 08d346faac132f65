# Files whose headers take longer to read than they do themselves are compiled together, each group as one.
# A build with CSGRT_TOGETHER=OFF, without common headers (precompile.cmake) either, tells whether each file of the
# library and of the command includes what it needs.
option(CSGRT_TOGETHER "Compile groups of small files as one, and common headers once: sooner all, later one" ON)

# csgrt_together(TARGET REGEX...): a group of those of its sources that match, for each expression.
function(csgrt_together target)
    get_target_property(sources ${target} SOURCES)
    set_target_properties(${target} PROPERTIES UNITY_BUILD ${CSGRT_TOGETHER} UNITY_BUILD_MODE GROUP)
    foreach(regex IN LISTS ARGN)
        set(group ${sources})
        list(FILTER group INCLUDE REGEX ${regex})
        string(MAKE_C_IDENTIFIER ${regex} name)
        set_source_files_properties(${group} PROPERTIES UNITY_GROUP ${name})
    endforeach()
endfunction()
