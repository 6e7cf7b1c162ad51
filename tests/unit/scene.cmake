list(APPEND TAUT_UNIT_TESTS
  scene_action_reader_test.cpp
  scene_fabrics_test.cpp
  scene_field_table_test.cpp
  scene_fields_test.cpp
  scene_files_test.cpp
  scene_fit_errors_test.cpp
  scene_gltf_test.cpp
  scene_inheritance_test.cpp
  scene_label_test.cpp
  scene_merge_test.cpp
  scene_obj_test.cpp
  scene_overrides_test.cpp
  scene_refusals_test.cpp
  scene_robustness_test.cpp
  scene_splice_test.cpp
  scene_state_keys_test.cpp
  scene_syntax_errors_test.cpp
  scene_ties_test.cpp
  scene_timeline_fields_test.cpp)
list(APPEND TAUT_UNIT_LINKS taut::scene)
