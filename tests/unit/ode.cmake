list(APPEND TAUT_UNIT_TESTS ode_conjugate_gradient_test.cpp ode_first_order_test.cpp ode_methods_test.cpp
  ode_own_method_test.cpp ode_prescribed_test.cpp ode_update_kernel_test.cpp)
list(APPEND TAUT_UNIT_LINKS taut::ode)
