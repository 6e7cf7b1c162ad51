list(APPEND TAUT_UNIT_TESTS
  regression_calibration_test.cpp
  regression_commands_test.cpp
  regression_goldens_test.cpp
  regression_manifest_test.cpp
  regression_scenario_test.cpp
  regression_tape_test.cpp)
list(APPEND TAUT_UNIT_LINKS taut::regression taut::game taut::world)
