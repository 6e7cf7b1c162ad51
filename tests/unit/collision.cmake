list(APPEND TAUT_UNIT_TESTS
  collision_batch_test.cpp collision_bullet_test.cpp collision_contact_test.cpp collision_distance_test.cpp
  collision_element_distance_test.cpp collision_manifold_test.cpp collision_outline_test.cpp collision_random_test.cpp
  collision_shape_test.cpp collision_sweep_test.cpp)
list(APPEND TAUT_UNIT_LINKS taut::collision taut::bullet)
