# SPDX-License-Identifier: MIT
# The quick start ends with the lines that stand in its page:
#
#   cmake -DPROGRAM=quick_start -DPAGE=docs/start/index.md -P quick_start.cmake
#
# with -DEMULATOR=wine before a program of Windows, whose lines end in two characters.
execute_process(COMMAND ${EMULATOR} ${PROGRAM} OUTPUT_VARIABLE printed
                RESULT_VARIABLE status)
string(REPLACE "\r\n" "\n" printed "${printed}")
if(NOT status EQUAL 0)
  message(FATAL_ERROR "${PROGRAM} ends with ${status}")
endif()

file(READ ${PAGE} text)
set(marker "<!-- quick_start_output:")
if(NOT text MATCHES "${marker}begin -->\n```[a-z]*\n(.+)```\n${marker}end -->")
  message(FATAL_ERROR "${PAGE} has no output of the quick start")
endif()
set(promised "${CMAKE_MATCH_1}")

string(LENGTH "${printed}" all)
string(LENGTH "${promised}" some)
math(EXPR start "${all} - ${some}")
if(start LESS 0)
  set(start 0)
endif()
string(SUBSTRING "${printed}" ${start} -1 end)
if(NOT end STREQUAL promised)
  message(FATAL_ERROR "promised:\n${promised}printed:\n${printed}")
endif()
