# What find_package(taut) and pkg-config find of the installed engine.
include(CMakePackageConfigHelpers)

install(TARGETS taut_headers taut_engine EXPORT taut)
install(EXPORT taut FILE tautTargets.cmake NAMESPACE taut:: DESTINATION lib/cmake/taut)

configure_package_config_file(tautConfig.cmake.in ${PROJECT_BINARY_DIR}/tautConfig.cmake
  INSTALL_DESTINATION lib/cmake/taut)
write_basic_package_version_file(${PROJECT_BINARY_DIR}/tautConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/tautConfig.cmake ${PROJECT_BINARY_DIR}/tautConfigVersion.cmake
  DESTINATION lib/cmake/taut)

configure_file(taut.pc.in ${PROJECT_BINARY_DIR}/taut.pc @ONLY)
install(FILES ${PROJECT_BINARY_DIR}/taut.pc DESTINATION lib/pkgconfig)
if(TARGET taut_render)
  set(osmesa)
  if(TARGET PkgConfig::OSMESA)
    set(osmesa " osmesa")
  endif()
  configure_file(taut-render.pc.in ${PROJECT_BINARY_DIR}/taut-render.pc @ONLY)
  install(FILES ${PROJECT_BINARY_DIR}/taut-render.pc DESTINATION lib/pkgconfig)
endif()
