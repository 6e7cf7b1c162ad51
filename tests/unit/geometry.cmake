find_package(nlohmann_json REQUIRED)
list(APPEND TAUT_UNIT_TESTS
  geometry_glb_test.cpp
  geometry_lost_motion_test.cpp
  geometry_usda_test.cpp)
list(APPEND TAUT_UNIT_LINKS taut::geometry nlohmann_json::nlohmann_json)
