list(APPEND TAUT_UNIT_TESTS
  fuzz_play_test.cpp
  fuzz_targets_test.cpp
  ../fuzz/check.cpp
  ../fuzz/gltf.cpp
  ../fuzz/image.cpp
  ../fuzz/manifest.cpp
  ../fuzz/obj.cpp
  ../fuzz/overrides.cpp
  ../fuzz/play.cpp
  ../fuzz/scene.cpp
  ../fuzz/scene_grammar.cpp
  ../fuzz/tape.cpp
  ../fuzz/targets.cpp
  ../fuzz/timeline.cpp
  ../fuzz/world.cpp)
list(APPEND TAUT_UNIT_LINKS taut::check taut::image taut::regression taut::scene taut::world)
