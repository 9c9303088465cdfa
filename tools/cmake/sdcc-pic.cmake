# SPDX-License-Identifier: MIT
# What sdcc-pic14.cmake and sdcc-pic16.cmake share. CMake includes a toolchain
# file several times, in its own small projects too.
set(CMAKE_SYSTEM_NAME Generic)
set(CMAKE_SYSTEM_PROCESSOR ${SDCC_PORT})
# A generic pointer. CMake looks for it in the strings of an object: pic14 packs
# them into instructions.
set(CMAKE_SIZEOF_VOID_P 3)

set(SDCC_CHIP ${SDCC_DEFAULT_CHIP}
    CACHE STRING "The chip, as SDCC spells it")
list(APPEND CMAKE_TRY_COMPILE_PLATFORM_VARIABLES SDCC_CHIP)

# Debian's sdcc does not have these ports.
function(sdcc_folders compiler result)
  execute_process(
    COMMAND ${compiler} -m${SDCC_PORT} --use-non-free --print-search-dirs
    OUTPUT_VARIABLE folders ERROR_QUIET RESULT_VARIABLE status)
  if(NOT status EQUAL 0)
    set(folders)
  endif()
  set(${result} "${folders}" PARENT_SCOPE)
endfunction()

if(NOT CMAKE_C_COMPILER)
  set(sdcc_cache $ENV{XDG_CACHE_HOME})
  if(NOT sdcc_cache)
    set(sdcc_cache $ENV{HOME}/.cache)
  endif()
  foreach(compiler $ENV{SDCC} sdcc ${sdcc_cache}/fixpid/sdcc-4.2.0-2/bin/sdcc)
    sdcc_folders(${compiler} folders)
    if(folders)
      set(CMAKE_C_COMPILER ${compiler})
      break()
    endif()
  endforeach()
endif()

# Where the run-time library is, and the device libraries if there are any.
set(folders)
if(CMAKE_C_COMPILER)
  sdcc_folders(${CMAKE_C_COMPILER} folders)
endif()
if(NOT folders)
  message(FATAL_ERROR "No sdcc with the port ${SDCC_PORT}: set SDCC or "
                      "CMAKE_C_COMPILER, or run fixpid's tools/firmware once")
endif()
string(REGEX MATCHALL "[^\n]*/lib/${SDCC_PORT}" folders "${folders}")
find_path(SDCC_LIBRARIES libsdcc.lib PATHS ${folders} NO_DEFAULT_PATH)
set(SDCC_LINK_FOLDERS)
foreach(folder ${folders})
  string(APPEND SDCC_LINK_FOLDERS
         " -I \"${folder}/${SDCC_CHIP}\" -I \"${folder}\"")
endforeach()
# gplink takes no other for an enhanced PIC16.
set(SDCC_LIBRARY libsdcc.lib)
if(SDCC_CHIP MATCHES "^1[26].*f1[0-9][0-9][0-9]")
  set(SDCC_LIBRARY libsdcce.lib)
endif()
find_program(GPLIB gplib)
find_program(GPLINK gplink)
foreach(needed SDCC_LIBRARIES GPLIB GPLINK)
  if(NOT ${needed})
    message(FATAL_ERROR "${needed} not found; is ${CMAKE_C_COMPILER} complete, "
                        "are the gputils there?")
  endif()
endforeach()

set(SDCC_ONE_BANK_TOOL ${CMAKE_CURRENT_LIST_DIR}/../lib/build/one_bank)
set(SDCC_ONE_BANK_FOLDER ${CMAKE_BINARY_DIR}/one_bank)
if(SDCC_ONE_BANK)
  execute_process(
    COMMAND ${SDCC_ONE_BANK_TOOL} describe ${CMAKE_C_COMPILER} ${SDCC_CHIP}
            ${SDCC_ONE_BANK_FOLDER}
    RESULT_VARIABLE status)
  if(NOT status EQUAL 0)
    message(FATAL_ERROR "SDCC_ONE_BANK: not for the ${SDCC_CHIP}")
  endif()
endif()

set(CMAKE_C_FLAGS_INIT
    "-m${SDCC_PORT} -p${SDCC_CHIP} --use-non-free -Wa,-w1 ${SDCC_PORT_FLAGS}")
# An executable needs the chip's start-up: CMake's own tests have none.
set(CMAKE_TRY_COMPILE_TARGET_TYPE STATIC_LIBRARY)
set(CMAKE_USER_MAKE_RULES_OVERRIDE_C
    ${CMAKE_CURRENT_LIST_DIR}/sdcc-pic-rules.cmake)
