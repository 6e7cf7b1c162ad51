list(APPEND TAUT_UNIT_TESTS contact_geometry_test.cpp contact_group_test.cpp contact_impacts_test.cpp)
list(APPEND TAUT_UNIT_LINKS taut::contact taut::core)
