list(APPEND TAUT_UNIT_TESTS view_primitives_test.cpp view_subdivision_test.cpp view_tube_test.cpp)
list(APPEND TAUT_UNIT_LINKS taut::view)
