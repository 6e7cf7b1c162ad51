# How every target of the project is compiled, and what of it is installed.

# Headers are included as "taut/FOLDER/FILE.h", in the checkout as where they are installed.
add_library(taut_headers INTERFACE)
set_target_properties(taut_headers PROPERTIES EXPORT_NAME headers)
target_include_directories(taut_headers INTERFACE
  $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/engine> $<INSTALL_INTERFACE:include>)
target_compile_features(taut_headers INTERFACE cxx_std_20)

# Files of a folder are compiled together, as units, since each unit costs some ten seconds for headers and for what it
# instantiates of the standard library. TAUT_UNITY is the most files of a unit. 1 compiles file by file, which is for work
# on the code: one file and the program again take seconds, and a missing include is found.
set(TAUT_UNITY 45 CACHE STRING "How many files of a folder are compiled together, at most")

# taut_unite(taut_core): the files of a target as units of equal size, of at most so many files if a number follows.
function(taut_unite target)
  set(most ${TAUT_UNITY})
  if(ARGC GREATER 1 AND ARGV1 LESS TAUT_UNITY)
    set(most ${ARGV1})
  endif()
  if(most GREATER 1)
    get_target_property(files ${target} SOURCES)
    list(FILTER files EXCLUDE REGEX "TARGET_OBJECTS")
    list(LENGTH files count)
    math(EXPR units "(${count} + ${most} - 1) / ${most}")
    math(EXPR size "(${count} + ${units} - 1) / ${units}")
    set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE ${size})
  endif()
endfunction()

# For our own targets alone: linked privately, so that a program that uses the engine keeps its own flags.
add_library(taut_options INTERFACE)
target_link_libraries(taut_options INTERFACE taut_headers)
target_compile_options(taut_options INTERFACE
  # An int that is a subscript converts by itself; comparisons of both signs are still refused.
  $<$<COMPILE_LANGUAGE:CXX>:-Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wno-sign-conversion
  $<$<BOOL:${TAUT_WERROR}>:-Werror>>
  # With sanitizers clang vectorises no loop and says so of each that asks for it.
  $<$<AND:$<COMPILE_LANG_AND_ID:CXX,Clang>,$<CONFIG:Asan>>:-Wno-pass-failed>
  # Same bits everywhere, whatever a project that adds this one compiles with: no fused multiply-add unless the source
  # says so, never fast-math.
  # The two others change no value; without them loops with a square root do not vectorise.
  $<$<NOT:$<BOOL:${PROJECT_IS_TOP_LEVEL}>>:-fno-fast-math>
  -ffp-contract=off -fno-math-errno -fno-trapping-math)
if(TAUT_UNITY GREATER 1)
  # fmt's check of every format string while compiling is a tenth of a build; file by file it is made.
  target_compile_definitions(taut_options INTERFACE FMT_CONSTEVAL=)
  # clang, unlike g++, takes a local name for one that hides that of another file of the unit.
  target_compile_options(taut_options INTERFACE $<$<COMPILE_LANG_AND_ID:CXX,Clang>:-Wno-shadow>)
endif()

# The folders where a scene's time goes. The others are compiled with -O1, which takes a quarter less. With sanitizers
# -O1 pays where a scene is built, too; the rest has -O0 there.
set(TAUT_COMPUTES core ode mechanics collision contact forces island image geometry render)
set(TAUT_BUILDS_SCENES damage body drawing bodies plan joints world)

# Those whose own loops take time too; of the others what is downloaded may be as small as can be.
set(TAUT_LOOPS core ode mechanics collision contact)

# taut_library(core SOURCES a.cpp LOOPS b.cpp LINK taut::ode PRIVATE_LINK fmt::fmt): the library of one folder, known as
# taut::core. LOOPS are files of long loops over flat arrays, which -O2 leaves scalar: they get -O3. LINK is what its
# headers include, PRIVATE_LINK what only its sources do. It is installed with its headers, but for those
# in the folder `private`; with PRIVATE none of them, with PROGRAM not at all: the program alone needs it.
function(taut_library name)
  cmake_parse_arguments(ARG "PRIVATE;PROGRAM" "" "SOURCES;LOOPS;LINK;PRIVATE_LINK" ${ARGN})
  add_library(taut_${name} STATIC ${ARG_SOURCES})
  add_library(taut::${name} ALIAS taut_${name})
  set_target_properties(taut_${name} PROPERTIES EXPORT_NAME ${name})
  target_link_libraries(taut_${name}
    PUBLIC taut_headers ${ARG_LINK} PRIVATE $<BUILD_INTERFACE:taut_options> ${ARG_PRIVATE_LINK})
  if(NOT name IN_LIST TAUT_COMPUTES)
    target_compile_options(taut_${name} PRIVATE $<$<CONFIG:Release>:-O1>)
  endif()
  if(name IN_LIST TAUT_COMPUTES OR name IN_LIST TAUT_BUILDS_SCENES)
    target_compile_options(taut_${name} PRIVATE $<$<CONFIG:Asan>:-O1>)
  endif()
  if(EMSCRIPTEN AND NOT name IN_LIST TAUT_LOOPS)
    target_compile_options(taut_${name} PRIVATE -Oz)
  endif()
  taut_unite(taut_${name})
  if(ARG_LOOPS)
    taut_objects(${name} loops "${ARG_LOOPS}" $<IF:$<CONFIG:Asan>,-O1,-O3>)
    target_link_libraries(taut_${name}_loops PRIVATE ${ARG_LINK} ${ARG_PRIVATE_LINK})
  endif()
  if(TAUT_INSTALL AND NOT ARG_PROGRAM)
    install(TARGETS taut_${name} EXPORT taut ARCHIVE DESTINATION lib)
    if(NOT ARG_PRIVATE)
      install(DIRECTORY ./ DESTINATION include/taut/${name} FILES_MATCHING PATTERN "*.h" PATTERN private EXCLUDE)
    endif()
  endif()
endfunction()

# taut_objects(core loops "a.cpp;b.cpp" -O3): files of a library that have options of their own, as taut_core_loops.
function(taut_objects name part files)
  set(objects taut_${name}_${part})
  add_library(${objects} OBJECT ${files})
  target_link_libraries(${objects} PRIVATE taut_options)
  target_compile_options(${objects} PRIVATE ${ARGN})
  taut_unite(${objects})
  target_sources(taut_${name} PRIVATE $<TARGET_OBJECTS:${objects}>)
endfunction()

# taut_kernels(mechanics spring_kernel.cpp wind_kernel.cpp): compiles files once per instruction set into the library, for
# the sets of taut/core/private/instruction_set.h.
# A file puts everything into the namespace TAUT_ISA (sse2, avx2, avx512) and uses no inline function of
# the standard library, so that no AVX code can be linked in for a processor that lacks it.
function(taut_kernels name)
  set(sets sse2 avx2 avx512)
  set(flags_sse2 -msse2)
  set(flags_avx2 -mavx2)
  set(flags_avx512 -mavx512f -mavx512vl -mavx512dq -mprefer-vector-width=512)
  if(EMSCRIPTEN)
    set(sets wasm128)
    set(flags_wasm128 -msimd128)
  endif()
  foreach(isa ${sets})
    taut_objects(${name} ${isa} "${ARGN}" ${flags_${isa}} $<IF:$<CONFIG:Asan>,-O1,-O3>)
    target_compile_definitions(taut_${name}_${isa} PRIVATE TAUT_ISA=${isa})
  endforeach()
endfunction()
