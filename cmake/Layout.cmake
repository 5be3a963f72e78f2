# The build tree has the shape of an installed one (bin/, lib/, lib/switchyard/plugins/), so what is
# found relative to the executable or the library is found in both, and in a copy of either.
set(CMAKE_RUNTIME_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/bin)
set(CMAKE_LIBRARY_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/lib)
set(CMAKE_ARCHIVE_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/lib)
set(SWITCHYARD_PLUGIN_SUBDIR switchyard/plugins)  # below the folder of libswitchyard
set(SWITCHYARD_PLUGIN_OUTPUT ${CMAKE_LIBRARY_OUTPUT_DIRECTORY}/${SWITCHYARD_PLUGIN_SUBDIR})

file(RELATIVE_PATH SWITCHYARD_BIN_TO_LIB
     ${CMAKE_INSTALL_FULL_BINDIR} ${CMAKE_INSTALL_FULL_LIBDIR})
set(CMAKE_BUILD_RPATH_USE_ORIGIN ON)
set(CMAKE_INSTALL_RPATH "$ORIGIN:$ORIGIN/${SWITCHYARD_BIN_TO_LIB}")
