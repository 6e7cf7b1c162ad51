# What the engine needs besides emscripten: headers of Debian's packages, which are the same for all processors, and the
# sources of Bullet and libdeflate (TAUT_BULLET_SOURCE and TAUT_DEFLATE_SOURCE, as game/web.sh unpacks them).
set(headers ${PROJECT_BINARY_DIR}/include)  # of these alone: /usr/include has another system's C library
file(MAKE_DIRECTORY ${headers})
foreach(folder fmt glm nlohmann toml++)
  if(NOT EXISTS /usr/include/${folder})
    message(FATAL_ERROR "There is no /usr/include/${folder}; sh game/web.sh installs what is needed")
  endif()
  file(CREATE_LINK /usr/include/${folder} ${headers}/${folder} SYMBOLIC)
endforeach()
file(CREATE_LINK /usr/include/tiny_gltf.h ${headers}/tiny_gltf.h SYMBOLIC)
set(TAUT_TOMLPP_INCLUDE ${headers} CACHE INTERNAL "")
foreach(package fmt glm nlohmann_json)
  add_library(${package}::${package} INTERFACE IMPORTED)
  target_include_directories(${package}::${package} SYSTEM INTERFACE ${headers})
  file(WRITE ${PROJECT_BINARY_DIR}/packages/${package}Config.cmake "")  # find_package finds the target above
  set(${package}_DIR ${PROJECT_BINARY_DIR}/packages CACHE INTERNAL "")
endforeach()
target_compile_definitions(fmt::fmt INTERFACE FMT_HEADER_ONLY)

set(TAUT_BULLET_SOURCE "" CACHE PATH "The folder src of Bullet's sources")
set(TAUT_DEFLATE_SOURCE "" CACHE PATH "libdeflate's sources")
foreach(header TAUT_BULLET_SOURCE/btBulletCollisionCommon.h TAUT_DEFLATE_SOURCE/libdeflate.h)
  get_filename_component(variable ${header} DIRECTORY)
  get_filename_component(name ${header} NAME)
  if(NOT EXISTS ${${variable}}/${name})
    message(FATAL_ERROR "${variable}: there is no ${name} in \"${${variable}}\"; sh game/web.sh finds it")
  endif()
endforeach()
add_library(taut_bullet STATIC)
add_library(taut::bullet ALIAS taut_bullet)
set(shapes btBoxShape btCapsuleShape btCollisionShape btConcaveShape btConeShape
  btConvexHullShape btConvexInternalShape btConvexPolyhedron btConvexShape btCylinderShape btOptimizedBvh
  btPolyhedralConvexShape btSphereShape btStridingMeshInterface btTriangleCallback btTriangleIndexVertexArray)
list(TRANSFORM shapes PREPEND BulletCollision/CollisionShapes/)
set(detectors btGjkEpa2 btGjkEpaPenetrationDepthSolver btGjkPairDetector btVoronoiSimplexSolver)
list(TRANSFORM detectors PREPEND BulletCollision/NarrowPhaseCollision/)
set(sources ${shapes} ${detectors} BulletCollision/BroadphaseCollision/btQuantizedBvh LinearMath/btAlignedAllocator
  LinearMath/btConvexHullComputer LinearMath/btGeometryUtil LinearMath/btSerializer LinearMath/btVector3)
list(TRANSFORM sources PREPEND ${TAUT_BULLET_SOURCE}/)
list(TRANSFORM sources APPEND .cpp)
target_sources(taut_bullet PRIVATE ${sources})
target_compile_definitions(taut_bullet PUBLIC BT_USE_DOUBLE_PRECISION)
target_include_directories(taut_bullet SYSTEM PUBLIC ${TAUT_BULLET_SOURCE})
target_compile_options(taut_bullet PRIVATE -w -ffp-contract=off)

set(sources adler32 arm/cpu_features crc32 deflate_compress deflate_decompress utils x86/cpu_features)
list(TRANSFORM sources PREPEND ${TAUT_DEFLATE_SOURCE}/lib/)
list(TRANSFORM sources APPEND .c)
add_library(taut_deflate STATIC ${sources})
target_include_directories(taut_deflate SYSTEM PUBLIC ${TAUT_DEFLATE_SOURCE})
target_compile_options(taut_deflate PRIVATE -w -Oz -DNDEBUG)
add_library(PkgConfig::libdeflate ALIAS taut_deflate)

# 128-bit vectors, exceptions, and copies of memory by one instruction, as WebAssembly has them. emscripten takes -Os for
# -fno-inline-functions, which would hold for files with -O3 as well.
add_compile_options(-msimd128 -mbulk-memory -fwasm-exceptions -finline-functions)
# There is one thread. What is local to it the linker refuses together with that instruction.
add_compile_definitions(thread_local=static)
add_compile_options("$<$<COMPILE_LANGUAGE:CXX>:SHELL:-include ${CMAKE_CURRENT_LIST_DIR}/standard_library.h>")
add_link_options(-fwasm-exceptions)
