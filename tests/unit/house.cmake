list(APPEND TAUT_UNIT_TESTS house_test.cpp)
