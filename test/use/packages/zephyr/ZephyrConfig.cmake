# SPDX-License-Identifier: MIT
# A stand-in for Zephyr's package: it finds the module's files by module.yml, makes
# the configuration with Zephyr's own library, and has the functions that
# zephyr/CMakeLists.txt and the sample call, with Zephyr's names and meaning.
set(stub ${CMAKE_CURRENT_LIST_DIR})

foreach(module ${ZEPHYR_EXTRA_MODULES})
  file(STRINGS ${module}/zephyr/module.yml lines)
  foreach(key cmake kconfig)
    set(${key} ${lines})
    list(FILTER ${key} INCLUDE REGEX "^  ${key}: ")
    list(TRANSFORM ${key} REPLACE "^  ${key}: " "${module}/")
  endforeach()
endforeach()
set(python $ENV{PYTHON})
if(NOT python)
  set(python /usr/bin/python3) # Debian's, which has its modules
endif()
execute_process(
  COMMAND ${python} ${stub}/kconfig.py ${kconfig}
          ${CMAKE_CURRENT_SOURCE_DIR}/prj.conf ${CMAKE_BINARY_DIR}/.config
  RESULT_VARIABLE failed)
if(failed)
  message(FATAL_ERROR "the configuration")
endif()
file(STRINGS ${CMAKE_BINARY_DIR}/.config lines REGEX "^CONFIG_")
foreach(line ${lines})
  string(REGEX MATCH "^([^=]+)=(.*)$" line ${line})
  set(${CMAKE_MATCH_1} ${CMAKE_MATCH_2})
endforeach()

# For every file of the firmware.
function(zephyr_include_directories)
  target_include_directories(zephyr_interface INTERFACE ${ARGN})
endfunction()

function(zephyr_compile_definitions)
  target_compile_definitions(zephyr_interface INTERFACE ${ARGN})
endfunction()

macro(zephyr_library_named name)
  set(ZEPHYR_CURRENT_LIBRARY ${name})
  add_library(${name} STATIC)
  target_link_libraries(${name} PUBLIC zephyr_interface)
  set_property(GLOBAL APPEND PROPERTY zephyr_libraries ${name})
endmacro()

function(zephyr_library_sources)
  target_sources(${ZEPHYR_CURRENT_LIBRARY} PRIVATE ${ARGN})
endfunction()

# All that a library has is linked, and what nobody calls dropped again.
macro(project)
  _project(${ARGN})
  add_library(zephyr_interface INTERFACE)
  target_compile_options(
    zephyr_interface INTERFACE -std=c99 -Wall -Wextra -Werror
                               -Wno-unused-parameter -ffunction-sections)
  add_library(app STATIC)
  target_link_libraries(app PUBLIC zephyr_interface)
  target_include_directories(app PUBLIC ${stub}/include)
  add_subdirectory(${cmake} ${CMAKE_BINARY_DIR}/module)
  file(WRITE ${CMAKE_BINARY_DIR}/empty.c "typedef int nothing_else;\n")
  get_property(libraries GLOBAL PROPERTY zephyr_libraries)
  add_executable(zephyr ${CMAKE_BINARY_DIR}/empty.c)
  target_link_libraries(zephyr PRIVATE -Wl,--gc-sections -Wl,--whole-archive app
                                       ${libraries} -Wl,--no-whole-archive)
endmacro()
