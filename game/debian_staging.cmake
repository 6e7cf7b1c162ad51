# Shaders, which the engine installs for those who draw with it, are in the package of the program.
file(REMOVE_RECURSE ${CPACK_TEMPORARY_INSTALL_DIRECTORY}/engine/usr/share/taut)
