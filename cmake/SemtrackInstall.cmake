# `cmake --install`: both archives, the public headers, and a package for find_package(semtrack).
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)
set(semtrack_package ${CMAKE_INSTALL_LIBDIR}/cmake/semtrack)
set_target_properties(semtrack_core PROPERTIES EXPORT_NAME core)
set_target_properties(semtrack_receiver PROPERTIES EXPORT_NAME receiver)
install(TARGETS semtrack_core semtrack_receiver semtrack_capacity EXPORT semtrack
        ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
install(DIRECTORY ${PROJECT_SOURCE_DIR}/include/semtrack DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
install(EXPORT semtrack NAMESPACE semtrack:: FILE semtrackConfig.cmake DESTINATION ${semtrack_package})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/semtrackConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/semtrackConfigVersion.cmake DESTINATION ${semtrack_package})
