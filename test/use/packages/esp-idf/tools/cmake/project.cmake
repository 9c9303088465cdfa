# SPDX-License-Identifier: MIT
# A stand-in for ESP-IDF's file of this name. It goes over each component twice, as
# the real one does: in script mode, and then to build it. main comes last.
set(stub ${CMAKE_CURRENT_LIST_DIR}/../..)
include(${stub}/arguments.cmake)

# The options are those that ESP-IDF 5 compiles components with.
function(idf_component_register)
  component_arguments(${ARGN})
  set(name idf_${COMPONENT_NAME})
  add_library(${name} STATIC ${component_SRCS})
  target_include_directories(
    ${name} PUBLIC ${component_INCLUDE_DIRS} PRIVATE ${stub}/include)
  target_compile_options(
    ${name} PRIVATE -std=gnu17 -Os -Wall -Wextra -Werror -Wwrite-strings
                    -Wno-unused-parameter -Wno-sign-compare
                    -ffunction-sections -fdata-sections)
  foreach(required ${component_REQUIRES})
    if(NOT TARGET idf_${required})
      message(FATAL_ERROR "Failed to resolve component '${required}'")
    endif()
    target_link_libraries(${name} PUBLIC idf_${required})
  endforeach()
endfunction()

macro(project name)
  _project(${name} C)
  set(ESP_PLATFORM 1)
  foreach(folder ${EXTRA_COMPONENT_DIRS} ${CMAKE_CURRENT_SOURCE_DIR}/main)
    get_filename_component(folder ${folder} ABSOLUTE)
    get_filename_component(COMPONENT_NAME ${folder} NAME)
    execute_process(
      COMMAND ${CMAKE_COMMAND} -DCOMPONENT=${folder} -P ${stub}/early.cmake
      RESULT_VARIABLE failed)
    if(failed)
      message(FATAL_ERROR "the first pass over ${folder}")
    endif()
    add_subdirectory(${folder} ${CMAKE_BINARY_DIR}/${COMPONENT_NAME})
  endforeach()
  if(NOT CMAKE_CROSSCOMPILING)
    add_executable(${name} ${stub}/start.c)
    target_link_libraries(${name} PRIVATE idf_main)
  endif()
endmacro()
