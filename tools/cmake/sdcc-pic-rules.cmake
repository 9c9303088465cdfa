# SPDX-License-Identifier: MIT
# Read after CMake's own rules for SDCC, which are those of its other ports.
set(CMAKE_C_OUTPUT_EXTENSION .o)
set(CMAKE_STATIC_LIBRARY_PREFIX "")
set(CMAKE_STATIC_LIBRARY_SUFFIX .lib)
set(CMAKE_EXECUTABLE_SUFFIX .hex)
set(CMAKE_LINK_LIBRARY_FLAG "")
set(CMAKE_LINK_LIBRARY_SUFFIX .lib)
set(CMAKE_C_CREATE_STATIC_LIBRARY
    "\"${CMAKE_COMMAND}\" -E remove <TARGET>"
    "\"${GPLIB}\" -c <TARGET> <OBJECTS>")
set(sdcc_start)
if(SDCC_PORT STREQUAL pic16)
  set(sdcc_start "\"${SDCC_LIBRARIES}/crt0iz.o\"")
endif()
# The project's first object gives the .cod its chip.
string(CONCAT CMAKE_C_LINK_EXECUTABLE
              "\"${GPLINK}\" -m${SDCC_LINK_FOLDERS} -o <TARGET> <LINK_FLAGS>"
              " <OBJECTS> ${sdcc_start} <LINK_LIBRARIES> ${SDCC_LIBRARY}")

if(SDCC_ONE_BANK)
  string(CONCAT CMAKE_C_COMPILE_OBJECT
                "\"${SDCC_ONE_BANK_TOOL}\" compile \"${SDCC_ONE_BANK_FOLDER}\""
                " <SOURCE> <OBJECT> <CMAKE_C_COMPILER> <DEFINES>"
                " <INCLUDES> <FLAGS>")
  string(CONCAT CMAKE_C_LINK_EXECUTABLE
                "\"${GPLINK}\" -m -s"
                " \"${SDCC_ONE_BANK_FOLDER}/${SDCC_CHIP}.lkr\""
                "${SDCC_LINK_FOLDERS} -o <TARGET> <LINK_FLAGS> <OBJECTS>"
                " \"${SDCC_ONE_BANK_FOLDER}/one_bank.o\" <LINK_LIBRARIES>"
                " libsdcc.lib")
  set(CMAKE_C_LINK_EXECUTABLE
      "${CMAKE_C_LINK_EXECUTABLE}" "\"${SDCC_ONE_BANK_TOOL}\" check <TARGET>")
endif()
