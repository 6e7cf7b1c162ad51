list(APPEND TAUT_UNIT_TESTS ecs_registry_test.cpp)
list(APPEND TAUT_UNIT_LINKS taut::ecs)
