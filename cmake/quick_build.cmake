# Several sources compiled as one, which reads what they include once. What is left out of it:
# sources with properties of their own.
option(LAMPLIGHTER_UNITY "Compile several sources as one" OFF)
set(LAMPLIGHTER_UNITY_BATCH 8 CACHE STRING "How many at most")

option(LAMPLIGHTER_PRECOMPILE "Precompile what most sources include" OFF)

# In targets with the flags of `owner`, and more definitions, sources begin with what `owner` precompiled.
function(lamplighter_precompile target owner header)
  if(target STREQUAL owner)
    # In <>, since CMake would write the absolute path of "", which ccache could not share.
    target_precompile_headers(${target} PRIVATE <${header}>)
  else()
    target_precompile_headers(${target} REUSE_FROM ${owner})
  endif()
  # ccache asks gcc for this.
  target_compile_options(${target} PRIVATE $<$<CXX_COMPILER_ID:GNU>:-fpch-preprocess>)
endfunction()

# For the libraries: a target that has nothing else, since a precompiled header is of use only where
# all definitions of its own target hold.
function(lamplighter_precompile_for_libraries)
  if(NOT LAMPLIGHTER_PRECOMPILE)
    return()
  endif()
  file(CONFIGURE OUTPUT ${CMAKE_CURRENT_BINARY_DIR}/precompiled.cpp CONTENT "")
  add_library(precompiled OBJECT ${CMAKE_CURRENT_BINARY_DIR}/precompiled.cpp)
  target_link_libraries(precompiled PRIVATE ${ARGN})
  lamplighter_precompile(precompiled precompiled renderer/base/precompiled.h)
endfunction()

# For a target whose sources are all known, after their properties are set. A batch ends with its
# folder where it can, so that a new file changes few of them. CMake's UNITY_BUILD writes absolute
# paths, which no two working trees have in common: ccache could not share what one has compiled.
function(lamplighter_quick_build target)
  if(LAMPLIGHTER_PRECOMPILE)
    lamplighter_precompile(${target} precompiled renderer/base/precompiled.h)
  endif()
  if(NOT LAMPLIGHTER_UNITY)
    return()
  endif()
  get_target_property(sources ${target} SOURCES)
  list(SORT sources)
  math(EXPR few "${LAMPLIGHTER_UNITY_BATCH} / 2")
  set(count 0)
  set(batches 0)
  set(content "")
  set(last_folder "")
  foreach(source ${sources} end)
    get_filename_component(folder ${source} DIRECTORY)
    if(source STREQUAL end OR count EQUAL LAMPLIGHTER_UNITY_BATCH
        OR (NOT folder STREQUAL last_folder AND NOT count LESS few))
      set(unity ${CMAKE_CURRENT_BINARY_DIR}/unity/${target}_${batches}.cpp)
      file(CONFIGURE OUTPUT ${unity} CONTENT "${content}" @ONLY)
      target_sources(${target} PRIVATE ${unity})
      math(EXPR batches "${batches} + 1")
      set(count 0)
      set(content "")
    endif()
    set(last_folder ${folder})
    get_source_file_property(definitions ${source} COMPILE_DEFINITIONS)
    get_source_file_property(options ${source} COMPILE_OPTIONS)
    if(source STREQUAL end OR definitions OR options)
      continue()
    endif()
    file(RELATIVE_PATH included ${PROJECT_SOURCE_DIR} ${source})
    string(APPEND content "#include \"${included}\"\n")
    set_source_files_properties(${source} PROPERTIES HEADER_FILE_ONLY ON)
    math(EXPR count "${count} + 1")
  endforeach()
endfunction()

# Test programs: half of the time to compile one goes into parsing the same headers, most of the rest
# into optimizing checks that run once. target: a test program, or test_support, which precompiles the
# header that the programs use.
function(lamplighter_quick_test target)
  target_compile_options(${target} PRIVATE $<$<CONFIG:Release>:-O1>)
  if(LAMPLIGHTER_PRECOMPILE)
    lamplighter_precompile(${target} test_support tests/support/precompiled.h)
  endif()
endfunction()
