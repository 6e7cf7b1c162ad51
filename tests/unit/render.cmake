list(APPEND TAUT_UNIT_TESTS render_edge_coverage_test.cpp render_edge_tiles_test.cpp render_label_test.cpp render_layers_test.cpp render_light_test.cpp render_picture_test.cpp render_renderer_test.cpp render_samples_test.cpp render_shadow_map_test.cpp render_shadow_test.cpp render_still_test.cpp)
list(APPEND TAUT_UNIT_LINKS taut::image taut::render taut_glad)
