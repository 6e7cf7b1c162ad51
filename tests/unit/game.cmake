list(APPEND TAUT_UNIT_TESTS
  game_completion_test.cpp
  game_continuation_test.cpp
  game_flags_test.cpp
  game_interruption_test.cpp
  game_outputs_test.cpp
  game_own_command_test.cpp
  game_own_format_test.cpp
  game_own_layer_test.cpp
  game_play_test.cpp
  game_program_test.cpp
  game_shards_test.cpp
  game_streams_test.cpp
  game_version_test.cpp)
list(APPEND TAUT_UNIT_LINKS taut::game)
