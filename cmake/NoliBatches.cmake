# SPDX-License-Identifier: Apache-2.0
# Most of the time of a compilation goes into reading headers, so the sources of a folder are compiled some at a time, as if they were
# one file. Names in unnamed namespaces are therefore the folder's, not the file's. Without NOLI_BATCHES (the preset `debug`) every
# source is compiled by itself, which finds what one of them forgot to include.
option(NOLI_BATCHES "Compile the sources of a folder together" ON)

# noli_batches(TARGET [SIZE N] [ALONE SOURCE...]): the target's sources so far, N at a time (16 unless said), but those that need a
# compilation to themselves.
function(noli_batches target)
  cmake_parse_arguments(arg "" "SIZE" "ALONE" ${ARGN})
  if(NOT NOLI_BATCHES)
    return()
  endif()
  if(NOT arg_SIZE)
    set(arg_SIZE 16)
  endif()
  set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_MODE GROUP)
  # What one source of a batch includes, another one's types too, is taken for a header's.
  target_compile_options(${target} PRIVATE $<$<CXX_COMPILER_ID:GNU>:-Wno-subobject-linkage>)
  get_target_property(sources ${target} SOURCES)
  foreach(alone IN LISTS arg_ALONE)
    if(NOT "${CMAKE_CURRENT_SOURCE_DIR}/${alone}" IN_LIST sources)
      message(FATAL_ERROR "noli_batches(${target}): ALONE names ${alone}, which is none of its sources")
    endif()
  endforeach()
  foreach(source IN LISTS sources)
    cmake_path(ABSOLUTE_PATH source)
    cmake_path(RELATIVE_PATH source BASE_DIRECTORY "${CMAKE_CURRENT_SOURCE_DIR}" OUTPUT_VARIABLE relative)
    if(relative IN_LIST arg_ALONE)
      continue()
    endif()
    cmake_path(GET relative PARENT_PATH folder)
    string(MAKE_C_IDENTIFIER "${target}_${folder}" group)
    if(NOT DEFINED count_${group})
      set(count_${group} 0)
    endif()
    math(EXPR batch "${count_${group}} / ${arg_SIZE}")
    math(EXPR count_${group} "${count_${group}} + 1")
    set_source_files_properties("${source}" PROPERTIES UNITY_GROUP "${group}_${batch}")
  endforeach()
endfunction()
