list(APPEND TAUT_UNIT_TESTS
  live_adaptation_test.cpp
  live_mouse_hand_test.cpp
  live_pace_test.cpp
  live_picking_test.cpp
  live_recording_test.cpp
  live_session_test.cpp)
list(APPEND TAUT_UNIT_LINKS taut::live taut::scene taut::world)
