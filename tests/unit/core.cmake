list(APPEND TAUT_UNIT_TESTS core_aligned_array_test.cpp core_base64_test.cpp core_bytes_test.cpp core_child_process_test.cpp core_glob_test.cpp core_hash_test.cpp core_instruction_set_test.cpp
  core_parallel_test.cpp core_trig_test.cpp core_utf8_test.cpp core_whole_file_test.cpp)
list(APPEND TAUT_UNIT_LINKS taut::core)
