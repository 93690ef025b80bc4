# seedmesh_models(TARGET DIRECTORY [SERVER url] [PROGRAM file] [CHECK])
#
# Adds a target, part of ALL, that makes the models of all request files below DIRECTORY (docs/pipelines.md), and only those that
# changed. It calls `seedmesh sync` of PROGRAM, or of a program that is found in PATH. With SERVER, that server makes the models.
# A machine without the program needs Python 3.9 and a server: SERVER, or SEEDMESH_URL of the environment. With CHECK the target fails
# if a model does not match its request file, and writes nothing.
#
# The property SEEDMESH_FILES of the target has the paths of the models, for rules that read them. A new request file is found by the
# next build.
include_guard()

set(SEEDMESH_PYTHON_PATH "${CMAKE_CURRENT_LIST_DIR}/../python/src" CACHE PATH
  "Directory of the Python package seedmesh; empty if the package is installed")

# The command line of `sync` for a directory, without further flags.
function(_seedmesh_sync_command result program directory)
  if(NOT program)
    find_program(SEEDMESH_PROGRAM_FOUND seedmesh)
    set(program "${SEEDMESH_PROGRAM_FOUND}")
  endif()
  if(program)
    set(${result} "${program}" sync "${directory}" PARENT_SCOPE)
    return()
  endif()
  find_package(Python3 3.9 REQUIRED COMPONENTS Interpreter)
  set(command ${CMAKE_COMMAND} -E env)
  if(SEEDMESH_PYTHON_PATH)
    list(APPEND command "PYTHONPATH=${SEEDMESH_PYTHON_PATH}")
  endif()
  set(${result} ${command} "${Python3_EXECUTABLE}" -m seedmesh sync "${directory}" PARENT_SCOPE)
endfunction()

function(seedmesh_models target directory)
  cmake_parse_arguments(PARSE_ARGV 2 arg "CHECK" "SERVER;PROGRAM" "")
  if(arg_UNPARSED_ARGUMENTS OR arg_KEYWORDS_MISSING_VALUES)
    message(FATAL_ERROR "seedmesh_models: found ${arg_UNPARSED_ARGUMENTS}${arg_KEYWORDS_MISSING_VALUES}, expected SERVER url, PROGRAM file or CHECK")
  endif()
  get_filename_component(directory "${directory}" ABSOLUTE)
  if(NOT IS_DIRECTORY "${directory}")
    message(FATAL_ERROR "seedmesh_models: found no directory ${directory}")
  endif()
  _seedmesh_sync_command(command "${arg_PROGRAM}" "${directory}")

  # The models are known when the project is configured, and CMake configures again if there is another request file.
  file(GLOB_RECURSE requests CONFIGURE_DEPENDS "${directory}/*.seedmesh")
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${requests})
  execute_process(COMMAND ${command} --list OUTPUT_VARIABLE models OUTPUT_STRIP_TRAILING_WHITESPACE COMMAND_ERROR_IS_FATAL ANY)
  string(REPLACE "\n" ";" models "${models}")

  if(arg_SERVER)
    list(APPEND command --server "${arg_SERVER}")
  endif()
  if(arg_CHECK)
    list(APPEND command --check)
    add_custom_target(${target} ALL COMMAND ${command} COMMENT "Comparing models of ${directory}" VERBATIM)
  else()
    add_custom_target(${target} ALL COMMAND ${command} BYPRODUCTS ${models} COMMENT "Models of ${directory}" VERBATIM)
  endif()
  set_target_properties(${target} PROPERTIES SEEDMESH_FILES "${models}")
endfunction()
