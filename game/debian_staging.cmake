# Shaders and fabrics, which the engine installs for those who use it, are in the package of the program.
set(staging ${CPACK_TEMPORARY_INSTALL_DIRECTORY})
file(REMOVE_RECURSE ${staging}/engine/usr/share/taut)

# Debian has one folder for the modules of all versions of Python.
file(GLOB modules ${staging}/python/usr/lib/python3.*)
foreach(module ${modules})
  file(RENAME ${module} ${staging}/python/usr/lib/python3)
endforeach()

# Neither symbols that nobody links nor the name of the compiler, as debhelper does it.
file(GLOB binaries ${staging}/engine/usr/lib/*.a ${staging}/program/usr/bin/*
  ${staging}/python/usr/lib/python3/dist-packages/taut/*.so)
execute_process(COMMAND strip --strip-unneeded --remove-section=.comment --enable-deterministic-archives ${binaries}
  COMMAND_ERROR_IS_FATAL ANY)
