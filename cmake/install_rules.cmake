# What `cmake --install` puts where, and the package that find_package(csgrt) finds.
include(CMakePackageConfigHelpers)

set(package_folder ${CMAKE_INSTALL_LIBDIR}/cmake/csgrt)
set(installed csgrt)
if(CSGRT_IMAGE)
    list(APPEND installed csgrt_image)
endif()
if(CSGRT_VIEW)
    list(APPEND installed csgrt_view)
endif()

# Who links static libraries links what they need, too.
set(csgrt_needs "")
if(csgrt_library_type STREQUAL "STATIC")
    list(APPEND installed csgrt_native)
    set(csgrt_needs "include(CMakeFindDependencyMacro)\nfind_dependency(Threads)\n")
    if(CSGRT_IMAGE)
        string(APPEND csgrt_needs "include(\${CMAKE_CURRENT_LIST_DIR}/openimageio.cmake)\n")
        install(FILES cmake/openimageio.cmake DESTINATION ${package_folder})
    endif()
    if(CSGRT_VIEW)
        string(APPEND csgrt_needs "include(\${CMAKE_CURRENT_LIST_DIR}/zlib.cmake)\n")
        install(FILES cmake/zlib.cmake DESTINATION ${package_folder})
    endif()
endif()
install(TARGETS ${installed} EXPORT csgrt_targets
    LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR} ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
install(DIRECTORY include/csgrt DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
install(EXPORT csgrt_targets FILE csgrt-targets.cmake NAMESPACE csgrt:: DESTINATION ${package_folder})

configure_package_config_file(cmake/csgrt-config.cmake.in csgrt-config.cmake INSTALL_DESTINATION ${package_folder})
write_basic_package_version_file(csgrt-config-version.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/csgrt-config.cmake ${CMAKE_CURRENT_BINARY_DIR}/csgrt-config-version.cmake
        DESTINATION ${package_folder})

# For pkg-config; wherever the prefix is moved to.
cmake_path(RELATIVE_PATH CMAKE_INSTALL_PREFIX BASE_DIRECTORY
    ${CMAKE_INSTALL_PREFIX}/${CMAKE_INSTALL_LIBDIR}/pkgconfig OUTPUT_VARIABLE csgrt_pc_to_prefix)
configure_file(cmake/csgrt.pc.in csgrt.pc @ONLY)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/csgrt.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig)

install(FILES src/cli/csgrt.bash DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions RENAME csgrt)
install(FILES scenes/csgrt.schema.json DESTINATION ${CMAKE_INSTALL_DATADIR}/csgrt)
# Pages, and the files to which their links lead; tests/install_test.cmake follows each link.
install(FILES README.md CHANGELOG.md CONTRIBUTING.md SECURITY.md LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR})
foreach(folder docs docs/images scenes scenes/pictures bench bench/analysis bench/campaign bench/chart tests/stress
        tests/integration/truth)
    file(GLOB pages CONFIGURE_DEPENDS ${folder}/*.md ${folder}/*.png ${folder}/*.webp ${folder}/*.ipynb)
    install(FILES ${pages} DESTINATION ${CMAKE_INSTALL_DOCDIR}/${folder})
endforeach()
install(DIRECTORY examples DESTINATION ${CMAKE_INSTALL_DOCDIR})
