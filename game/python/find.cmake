# Python3 and pybind11 for the module, where they are there.
if(NOT DEFINED Python3_EXECUTABLE AND EXISTS /usr/bin/python3)
  set(Python3_EXECUTABLE /usr/bin/python3)  # for which the distribution has numpy, whatever else is in the PATH
endif()
find_package(Python3 QUIET COMPONENTS Interpreter Development.Module)
set(PYBIND11_NOPYTHON ON)  # it is found already
find_package(pybind11 2.10 QUIET)
