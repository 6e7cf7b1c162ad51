# The Debian packages that `cpack` makes of what is built, one of each component of the installation: `taut` of program,
# `libtaut-dev` of engine, `python3-taut` of python. What all need is in `taut`, on which the others depend.
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_VERSION ${PROJECT_VERSION})
file(STRINGS ${CMAKE_CURRENT_LIST_DIR}/changelog signature REGEX "^ -- " LIMIT_COUNT 1)
string(REGEX REPLACE "^ -- (.*>)  .*" "\\1" CPACK_PACKAGE_CONTACT "${signature}")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "")  # each has its own
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_COMPRESSION_TYPE xz)
set(CPACK_THREADS 0)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS
  OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)
set(CPACK_PRE_BUILD_SCRIPTS ${CMAKE_CURRENT_LIST_DIR}/debian_staging.cmake)
set(CPACK_COMPONENTS_ALL)

# taut_deb(engine NAME libtaut-dev SECTION libdevel SUMMARY ... TEXT ... [DEPENDS ...] [RECOMMENDS ...] [SUGGESTS ...])
# Libraries that programs of it load are depended on by themselves.
function(taut_deb component)
  cmake_parse_arguments(ARG "" "NAME;SECTION;SUMMARY" "TEXT;DEPENDS;RECOMMENDS;SUGGESTS" ${ARGN})
  string(TOUPPER ${component} upper)
  list(JOIN ARG_TEXT "\n" text)
  set(CPACK_DEBIAN_${upper}_PACKAGE_NAME ${ARG_NAME} PARENT_SCOPE)
  set(CPACK_DEBIAN_${upper}_PACKAGE_SECTION ${ARG_SECTION} PARENT_SCOPE)
  set(CPACK_DEBIAN_${upper}_DESCRIPTION "${ARG_SUMMARY}\n${text}" PARENT_SCOPE)
  set(CPACK_DEBIAN_${upper}_PACKAGE_SHLIBDEPS ON PARENT_SCOPE)
  foreach(relation DEPENDS RECOMMENDS SUGGESTS)
    list(JOIN ARG_${relation} ", " packages)
    set(CPACK_DEBIAN_${upper}_PACKAGE_${relation} "${packages}" PARENT_SCOPE)
  endforeach()
  set(CPACK_COMPONENTS_ALL ${CPACK_COMPONENTS_ALL} ${component} PARENT_SCOPE)
endfunction()

taut_deb(program NAME taut SECTION graphics
  SUMMARY "player of scenes of ropes, cloth and soft bodies"
  TEXT "taut simulates mass-spring scenes that text files describe and renders them"
    "as videos or pictures, on machines without a display too, or plays them in a"
    "window where they can be pulled with the mouse. A scene has the same bits on"
    "every x86-64 processor and with any number of threads, so that its states and"
    "pictures can be tested against recorded ones."
  RECOMMENDS ffmpeg fonts-dejavu-core libgl1-mesa-dri
  SUGGESTS gnuplot-nox libjs-three xvfb)
set(osmesa)
if(TARGET PkgConfig::OSMESA)
  set(osmesa libosmesa6-dev)
endif()
taut_deb(engine NAME libtaut-dev SECTION libdevel
  SUMMARY "mass-spring engine, for C++ programs"
  TEXT "The static libraries of taut, an engine for ropes, cloth, blocks and nets, with"
    "their headers and what CMake and pkg-config need to find them: taut::engine,"
    "which simulates, and taut::render, which draws without a display."
  DEPENDS "taut (= ${PROJECT_VERSION})" libbullet-dev libdeflate-dev libegl-dev libfmt-dev libglm-dev ${osmesa}
    libspng-dev libtbb-dev libturbojpeg0-dev
  SUGGESTS cmake g++ pkg-config)
if(TAUT_PYTHON)
  string(REGEX MATCH "[0-9]+\\.[0-9]+" python "${TAUT_PYTHON_FOLDER}")
  string(REGEX MATCH "[0-9]+$" minor "${python}")
  math(EXPR next "${minor} + 1")
  taut_deb(python NAME python3-taut SECTION python
    SUMMARY "mass-spring engine, for Python"
    TEXT "The module taut: scenes of ropes, cloth and soft bodies, loaded, stepped and"
      "asked for positions, energies and pictures as NumPy arrays, with forces and"
      "controllers written in Python."
    DEPENDS "taut (= ${PROJECT_VERSION})" "python3 (>= 3.${minor})" "python3 (<< 3.${next})" python3-numpy
    SUGGESTS mypy python3-matplotlib)
endif()
include(CPack)
