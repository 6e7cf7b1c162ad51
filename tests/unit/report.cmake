list(APPEND TAUT_UNIT_TESTS
  report_contact_sheet_test.cpp
  report_gnuplot_test.cpp
  report_layout_test.cpp
  report_table_test.cpp
  report_test_report_test.cpp)
list(APPEND TAUT_UNIT_LINKS taut::report taut::image)
