# Writes into FOLDER what is installed beside PROGRAM and comes from it, its manual page and completions, and CHANGELOG as
# Debian has it.
file(MAKE_DIRECTORY ${FOLDER})
execute_process(COMMAND ${PROGRAM} manual OUTPUT_FILE ${FOLDER}/taut.1 COMMAND_ERROR_IS_FATAL ANY)
foreach(shell bash zsh fish)
  execute_process(COMMAND ${PROGRAM} completion ${shell} OUTPUT_FILE ${FOLDER}/taut.${shell} COMMAND_ERROR_IS_FATAL ANY)
endforeach()
file(COPY ${CHANGELOG} DESTINATION ${FOLDER})
# -n: no time in it, so that packages of the same sources are the same.
execute_process(COMMAND gzip -9nf taut.1 changelog WORKING_DIRECTORY ${FOLDER} COMMAND_ERROR_IS_FATAL ANY)
