list(APPEND TAUT_DETERMINISM_TESTS state_hash_test.cpp timeline_hash_test.cpp)
list(APPEND TAUT_DETERMINISM_LINKS taut::scene taut::world)
