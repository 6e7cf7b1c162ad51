list(APPEND TAUT_GOLDEN_TESTS golden_frames_test.cpp)
list(APPEND TAUT_GOLDEN_LINKS taut::pipeline taut::render taut::scene taut::world nlohmann_json::nlohmann_json)
find_package(nlohmann_json REQUIRED)
