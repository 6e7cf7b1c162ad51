find_package(Boost REQUIRED)  # headers of odeint; imported, so the compiler takes them for the system's
list(APPEND TAUT_PHYSICS_TESTS
  bending_test.cpp
  blanes_moan_test.cpp
  block_recovery_test.cpp
  closed_systems_test.cpp
  contact_test.cpp
  float_floor_test.cpp
  free_motion_test.cpp
  frequency_bounds_test.cpp
  hanging_test.cpp
  hard_cases_test.cpp
  implicit_euler_test.cpp
  led_points_test.cpp
  linear_modes_test.cpp
  lying_test.cpp
  mesh_block_test.cpp
  network_energy_test.cpp
  network_limits_test.cpp
  network_order_test.cpp
  odeint_witness_test.cpp
  oscillator_damping_test.cpp
  oscillator_energy_test.cpp
  oscillator_limits_test.cpp
  precision_test.cpp
  sdirk2_test.cpp
  solid_test.cpp
  step_following_test.cpp
  touching_bodies_test.cpp
  touching_energy_test.cpp
  touching_funnel_test.cpp
  touching_long_test.cpp
  touching_test.cpp)
list(APPEND TAUT_PHYSICS_LINKS taut::world taut::mechanics taut::ode Boost::headers)
list(APPEND TAUT_PHYSICS_TESTS drawn_finer_test.cpp shipped_scenes_test.cpp tearing_test.cpp)
list(APPEND TAUT_PHYSICS_LINKS taut::scene)
list(APPEND TAUT_PHYSICS_TESTS study_reference_test.cpp study_threshold_test.cpp)
list(APPEND TAUT_PHYSICS_LINKS taut::study)
list(APPEND TAUT_PHYSICS_TESTS plan_brute_force_test.cpp)
