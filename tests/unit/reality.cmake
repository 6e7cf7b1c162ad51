list(APPEND TAUT_UNIT_TESTS
  reality_chart_test.cpp
  reality_command_test.cpp
  reality_elastica_test.cpp)
list(APPEND TAUT_UNIT_LINKS taut::reality taut::game)
