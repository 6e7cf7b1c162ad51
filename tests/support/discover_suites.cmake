# Writes a file for ctest with one test a suite of PROGRAM, named PREFIX.SUITE, under the label PREFIX, and under `all` or
# `long` too if its name matches ALL or LONG. A process a suite and not a test: starting one takes as long as most tests, for the libraries
# that draw are large. Called after each build with -DPROGRAM=… -DPREFIX=… -DALL=… -DLONG=… -DOUTPUT=….
execute_process(COMMAND ${PROGRAM} --gtest_list_tests OUTPUT_VARIABLE listed COMMAND_ERROR_IS_FATAL ANY)
string(REGEX MATCHALL "(^|\n)[^ \n]+\\.[^\n]*" suites "${listed}")
set(text)
foreach(suite IN LISTS suites)
  string(REGEX REPLACE "^\n?([^ ]+)\\..*" "\\1" suite "${suite}")
  set(labels ${PREFIX})
  foreach(label ALL LONG)
    if(${label} AND suite MATCHES "^(${${label}})$")
      string(TOLOWER ${label} name)
      list(APPEND labels ${name})
    endif()
  endforeach()
  string(APPEND text "add_test([==[${PREFIX}.${suite}]==] [==[${PROGRAM}]==] [==[--gtest_filter=${suite}.*]==])\n"
    "set_tests_properties([==[${PREFIX}.${suite}]==] PROPERTIES LABELS [==[${labels}]==])\n")
endforeach()
file(WRITE ${OUTPUT} "${text}")
