list(APPEND TAUT_UNIT_TESTS
  pipeline_checkpoint_test.cpp
  pipeline_overlay_test.cpp
  pipeline_queue_test.cpp
  pipeline_run_test.cpp
  pipeline_self_test_test.cpp
  pipeline_stages_test.cpp)
list(APPEND TAUT_UNIT_LINKS taut::pipeline taut::render)
