list(APPEND TAUT_UNIT_TESTS collision_distance_test.cpp)
list(APPEND TAUT_UNIT_LINKS taut::collision taut::bullet)
