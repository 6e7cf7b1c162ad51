list(APPEND TAUT_GOLDEN_TESTS goldens_test.cpp)
list(APPEND TAUT_GOLDEN_LINKS taut::regression taut::render taut::scene taut::world)
