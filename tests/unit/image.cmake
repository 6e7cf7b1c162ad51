list(APPEND TAUT_UNIT_TESTS
  image_compare_test.cpp
  image_frame_sequence_test.cpp
  image_light_image_test.cpp
  image_png_test.cpp
  image_video_test.cpp)
list(APPEND TAUT_UNIT_LINKS taut::image)
