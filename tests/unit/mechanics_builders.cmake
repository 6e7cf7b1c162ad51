list(APPEND TAUT_UNIT_TESTS
  mechanics_anchor_generator_test.cpp
  mechanics_block_moduli_test.cpp
  mechanics_builders_block_test.cpp
  mechanics_builders_cloth_test.cpp
  mechanics_builders_groups_test.cpp
  mechanics_builders_mesh_cloth_test.cpp
  mechanics_builders_net_test.cpp
  mechanics_builders_rope_test.cpp
  mechanics_filling_generator_test.cpp
  mechanics_gravity_generator_test.cpp
  mechanics_gust_generator_test.cpp
  mechanics_index_runs_generator_test.cpp
  mechanics_rigid_test.cpp
  mechanics_mesh_lattice_test.cpp
  mechanics_panel_mesher_test.cpp
  mechanics_sheet_moduli_test.cpp
  mechanics_volume_generator_test.cpp
  mechanics_wind_generator_test.cpp)
list(APPEND TAUT_UNIT_LINKS taut::mechanics)
