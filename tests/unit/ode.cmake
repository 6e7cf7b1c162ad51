list(APPEND TAUT_UNIT_TESTS ode_methods_test.cpp ode_update_kernel_test.cpp)
list(APPEND TAUT_UNIT_LINKS taut::ode)
