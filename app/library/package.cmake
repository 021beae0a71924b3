# The public library: one shared object with everything of mote inside, so that a user's project needs no
# third-party package to configure; what it loads at run time are Debian's own shared libraries. Only what
# mote.hpp marks is visible. The command line links the same static parts directly: it starts faster.
include(CMakePackageConfigHelpers)
add_library(mote_shared SHARED library/mote.cpp)
target_link_libraries(mote_shared PRIVATE mote_app $<BUILD_INTERFACE:mote_options>)
set_target_properties(mote_shared PROPERTIES
  OUTPUT_NAME mote EXPORT_NAME mote
  VERSION ${PROJECT_VERSION} SOVERSION ${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR}
  CXX_VISIBILITY_PRESET hidden VISIBILITY_INLINES_HIDDEN ON PUBLIC_HEADER library/mote.hpp)
target_link_options(mote_shared PRIVATE -Wl,--exclude-libs,ALL)
target_compile_features(mote_shared INTERFACE cxx_std_20)
target_include_directories(mote_shared INTERFACE $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)

set(package_folder ${CMAKE_INSTALL_LIBDIR}/cmake/mote)
install(TARGETS mote_shared EXPORT moteTargets
  LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR}
  PUBLIC_HEADER DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/mote)
install(EXPORT moteTargets NAMESPACE mote:: DESTINATION ${package_folder})
configure_package_config_file(library/moteConfig.cmake.in moteConfig.cmake INSTALL_DESTINATION ${package_folder})
write_basic_package_version_file(moteConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/moteConfig.cmake ${CMAKE_CURRENT_BINARY_DIR}/moteConfigVersion.cmake
  DESTINATION ${package_folder})
