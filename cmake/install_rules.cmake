# What `cmake --install` puts where, and the package that find_package(csgrt) finds.
include(CMakePackageConfigHelpers)

set(package_folder ${CMAKE_INSTALL_LIBDIR}/cmake/csgrt)
set(installed csgrt)
if(CSGRT_IMAGE)
    list(APPEND installed csgrt_image)
endif()

install(TARGETS ${installed} EXPORT csgrt_targets LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR})
install(DIRECTORY include/csgrt DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
install(EXPORT csgrt_targets FILE csgrt-targets.cmake NAMESPACE csgrt:: DESTINATION ${package_folder})

configure_package_config_file(cmake/csgrt-config.cmake.in csgrt-config.cmake INSTALL_DESTINATION ${package_folder})
write_basic_package_version_file(csgrt-config-version.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/csgrt-config.cmake ${CMAKE_CURRENT_BINARY_DIR}/csgrt-config-version.cmake
        DESTINATION ${package_folder})
