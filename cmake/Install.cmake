# What `cmake --install` writes: the headers, the library, the command line, the plugins (those say
# so themselves, see Plugins.cmake) and what CMake and pkg-config need to find them. No installed
# file holds an absolute path, so the tree can be moved.
include(CMakePackageConfigHelpers)

set(SWITCHYARD_CMAKE_DIR ${CMAKE_INSTALL_LIBDIR}/cmake/switchyard)

install(DIRECTORY ${PROJECT_SOURCE_DIR}/include/switchyard DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}
        FILES_MATCHING PATTERN "*.h" PATTERN "*.hpp")
install(FILES ${PROJECT_SOURCE_DIR}/LICENSE ${PROJECT_SOURCE_DIR}/THIRD_PARTY.md
        DESTINATION ${CMAKE_INSTALL_DOCDIR})

install(TARGETS switchyard switchyard_headers EXPORT switchyard-targets
        LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR})
install(EXPORT switchyard-targets NAMESPACE switchyard:: DESTINATION ${SWITCHYARD_CMAKE_DIR})

configure_package_config_file(
  ${CMAKE_CURRENT_LIST_DIR}/switchyard-config.cmake.in
  ${CMAKE_BINARY_DIR}/cmake/switchyard-config.cmake
  INSTALL_DESTINATION ${SWITCHYARD_CMAKE_DIR}
  NO_CHECK_REQUIRED_COMPONENTS_MACRO)
write_basic_package_version_file(
  ${CMAKE_BINARY_DIR}/cmake/switchyard-config-version.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_BINARY_DIR}/cmake/switchyard-config.cmake
              ${CMAKE_BINARY_DIR}/cmake/switchyard-config-version.cmake
        DESTINATION ${SWITCHYARD_CMAKE_DIR})

# pkg-config finds the prefix from where the .pc file stands.
file(RELATIVE_PATH SWITCHYARD_PC_TO_PREFIX
     /prefix/${CMAKE_INSTALL_LIBDIR}/pkgconfig /prefix)
configure_file(${CMAKE_CURRENT_LIST_DIR}/switchyard.pc.in
               ${CMAKE_BINARY_DIR}/cmake/switchyard.pc @ONLY)
install(FILES ${CMAKE_BINARY_DIR}/cmake/switchyard.pc
        DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig)

# Everything a user runs, without the tests.
add_custom_target(products DEPENDS switchyard)
get_property(plugins GLOBAL PROPERTY SWITCHYARD_PLUGINS_BUILT)
foreach(name switchyard_cli ${plugins})
  foreach(target ${name} plugin_${name})
    if(TARGET ${target})
      add_dependencies(products ${target})
    endif()
  endforeach()
endforeach()
