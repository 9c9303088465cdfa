# SPDX-License-Identifier: MIT
# The first pass of ESP-IDF over a component, in CMake's script mode, where there
# are no targets and no project(): what it requires. A register returns from the
# component's file. -DCOMPONENT is its folder.
cmake_minimum_required(VERSION 3.16)
set(ESP_PLATFORM 1)
include(${CMAKE_CURRENT_LIST_DIR}/arguments.cmake)

macro(idf_component_register)
  component_arguments(${ARGN})
  message(STATUS "requires '${component_REQUIRES}'")
  set(registered TRUE)
  return()
endmacro()

function(component)
  include(${COMPONENT}/CMakeLists.txt)
  if(NOT registered)
    message(FATAL_ERROR "${COMPONENT} registered no component")
  endif()
endfunction()
component()
