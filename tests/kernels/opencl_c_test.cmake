# Do the kernels stay within OpenCL C 1.2? clang's front end reads every program that csgrt makes, for a device that is
# not the host, with the standard's own declarations. cmake -DCLANG=... -DKERNELS=... -P opencl_c_test.cmake
cmake_minimum_required(VERSION 3.25)

set(every_partition 1_count_segments.cl scan.cl 2_store_segments.cl 2_rays_in_faces.cl 3_weave.cl 4_evaluate.cl
    3_deep_rays.cl 5_shade.cl 6_rows.cl)
set(double -DCSGRT_REAL=double)
set(single -DCSGRT_REAL=float)
set(relative ${single} -DCSGRT_EYE_RELATIVE)
set(packets ${double} -DCSGRT_PACKETS)
set(failed "")

# check(OPTIONS... FILES file...): the files together, as one program.
function(check)
    cmake_parse_arguments(program "" "" "FILES" ${ARGN})
    set(includes "")
    foreach(file IN LISTS program_FILES)
        list(APPEND includes -include ${file})
    endforeach()
    # Unused: a program has functions and arguments for more than one scene or device needs.
    execute_process(
        COMMAND ${CLANG} -x cl -cl-std=CL1.2 -target spir64-unknown-unknown -Xclang -finclude-default-header
            -fsyntax-only -Werror -Wall -Wextra -pedantic -Wno-unused -Wno-unused-parameter
            -Wno-constant-logical-operand "-DCSGRT_SOLIDS=((1u << SOLID_TYPES) - 1u)" -DCSGRT_QUARTIC=0
            -D__OPENCL_VERSION__=120 -DCSGRT_LARGE_TERMS -DCSGRT_SHAPED_LIGHTS ${program_UNPARSED_ARGUMENTS}
            -I${KERNELS} ${includes} /dev/null
        RESULT_VARIABLE result ERROR_VARIABLE words)
    if(NOT result EQUAL 0)
        string(APPEND failed "${program_UNPARSED_ARGUMENTS}, ${program_FILES}:\n${words}\n")
        set(failed "${failed}" PARENT_SCOPE)
    endif()
endfunction()

foreach(number double single relative)
    check(${${number}} FILES 0_cull_tiles.cl ${every_partition})
    check(${${number}} -DCSGRT_PRIVATE_BOUNDARIES -DCSGRT_FEW=64u
        FILES 0_cull_tiles.cl shading/first_hits_ray.h first_hits.cl)
    check(${${number}} FILES tile_list.cl edges.cl)
endforeach()
check(${packets} FILES 0_cull_tiles.cl 1_packet_candidates.cl ${every_partition})
check(${packets} -DCSGRT_PRIVATE_BOUNDARIES -DCSGRT_PREFETCH
    FILES 0_cull_tiles.cl packet/first_hits_packet.h first_hits.cl)
if(BEHIND)  # another's kernels, with BEHIND_OPTIONS
    check(${double} ${BEHIND_OPTIONS} FILES ${every_partition} ${BEHIND})
endif()
if(failed)
    message(FATAL_ERROR "not OpenCL C 1.2:\n${failed}")
endif()
