list(APPEND TAUT_UNIT_TESTS
  mechanics_dashpot_sweep_test.cpp
  mechanics_element_bending_test.cpp
  mechanics_grid_bending_test.cpp
  mechanics_grid_friction_test.cpp
  mechanics_implicit_products_test.cpp
  mechanics_mass_spring_system_test.cpp
  mechanics_place_springs_test.cpp
  mechanics_spring_kernel_test.cpp
  mechanics_spring_network_test.cpp
  mechanics_spring_watch_test.cpp
  mechanics_state_bound_test.cpp)
list(APPEND TAUT_UNIT_LINKS taut::mechanics taut::ode)
