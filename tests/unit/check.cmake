list(APPEND TAUT_UNIT_TESTS
  check_figures_test.cpp
  check_functions_test.cpp
  check_language_test.cpp
  check_mangled_test.cpp
  check_watcher_test.cpp)
list(APPEND TAUT_UNIT_LINKS taut::check taut::scene taut::world)
