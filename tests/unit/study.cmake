list(APPEND TAUT_UNIT_TESTS
  study_atlas_chart_test.cpp
  study_atlas_command_test.cpp
  study_atlas_test.cpp
  study_chart_command_test.cpp
  study_contact_test.cpp
  study_steps_table_test.cpp
  study_fit_command_test.cpp
  study_fit_test.cpp
  study_horizon_test.cpp
  study_least_squares_test.cpp
  study_plan_command_test.cpp
  study_plan_test.cpp
  study_problems_test.cpp
  study_refinement_test.cpp
  study_work_precision_test.cpp)
list(APPEND TAUT_UNIT_LINKS taut::study taut::reality taut::world taut::game)
