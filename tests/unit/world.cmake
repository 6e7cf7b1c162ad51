list(APPEND TAUT_UNIT_TESTS
  world_actions_test.cpp
  world_bodies_test.cpp
  world_components_test.cpp
  world_cutting_test.cpp
  world_divergence_test.cpp
  world_encounters_test.cpp
  world_envelope_test.cpp
  world_forces_test.cpp
  world_freeze_test.cpp
  world_hands_test.cpp
  world_inside_test.cpp
  world_islands_test.cpp
  world_motion_test.cpp
  world_own_action_test.cpp
  world_own_kinds_test.cpp
  world_own_method_test.cpp
  world_own_shape_test.cpp
  world_publish_test.cpp
  world_ramps_test.cpp
  world_rehearsal_test.cpp
  world_saving_test.cpp
  world_step_choice_test.cpp
  world_step_following_test.cpp
  world_targets_test.cpp
  world_tearing_test.cpp
  world_ties_test.cpp)
list(APPEND TAUT_UNIT_LINKS taut::world)
