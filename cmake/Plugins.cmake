# A plugin is a module in <lib>/switchyard/plugins that exports one symbol. The libraries it brings
# along stand in deps/ beside it; it finds them through its own run path, so the tree can be moved.

set_property(GLOBAL PROPERTY SWITCHYARD_PLUGINS_BUILT "")
set_property(GLOBAL PROPERTY SWITCHYARD_PLUGINS_LEFT_OUT "")

# Leaves the current plugin out with a sentence, shown at the end of the configuration.
function(switchyard_leave_out name reason)
  set_property(GLOBAL APPEND PROPERTY SWITCHYARD_PLUGINS_LEFT_OUT "${name}: ${reason}")
endfunction()

# switchyard_add_plugin(NAME [SOURCES ...] [LIBRARIES ...] [BRINGS file ...])
# LIBRARIES are linked; BRINGS are shared libraries copied into deps/.
function(switchyard_add_plugin name)
  cmake_parse_arguments(arg "" "" "SOURCES;LIBRARIES;BRINGS" ${ARGN})
  set(target plugin_${name})
  add_library(${target} MODULE ${arg_SOURCES})
  target_link_libraries(${target} PRIVATE switchyard_headers ${arg_LIBRARIES})
  switchyard_warnings(${target})
  set_target_properties(${target} PROPERTIES
    PREFIX "" OUTPUT_NAME ${name}
    LIBRARY_OUTPUT_DIRECTORY ${SWITCHYARD_PLUGIN_OUTPUT}
    BUILD_WITH_INSTALL_RPATH ON INSTALL_RPATH "$ORIGIN/deps")
  set(map ${PROJECT_SOURCE_DIR}/cmake/plugin.map)
  target_link_options(${target} PRIVATE -Wl,--no-undefined -Wl,--version-script=${map})
  set_property(TARGET ${target} APPEND PROPERTY LINK_DEPENDS ${map})
  foreach(file ${arg_BRINGS})
    file(COPY ${file} DESTINATION ${SWITCHYARD_PLUGIN_OUTPUT}/deps FOLLOW_SYMLINK_CHAIN)
    install(FILES ${file} DESTINATION ${CMAKE_INSTALL_LIBDIR}/${SWITCHYARD_PLUGIN_SUBDIR}/deps)
  endforeach()
  install(TARGETS ${target}
          LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR}/${SWITCHYARD_PLUGIN_SUBDIR})
  set_property(GLOBAL APPEND PROPERTY SWITCHYARD_PLUGINS_BUILT ${name})
endfunction()

function(switchyard_print_summary)
  get_property(built GLOBAL PROPERTY SWITCHYARD_PLUGINS_BUILT)
  get_property(out GLOBAL PROPERTY SWITCHYARD_PLUGINS_LEFT_OUT)
  list(JOIN built ", " built)
  message(STATUS "Switchyard plugins: ${built}")
  foreach(line ${out})
    message(STATUS "Left out: ${line}")
  endforeach()
endfunction()
