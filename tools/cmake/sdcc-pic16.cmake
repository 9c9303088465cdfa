# SPDX-License-Identifier: MIT
# Toolchain file: CMake (3.16 or later) builds firmware for PIC18 with SDCC,
# whose port of that family is called pic16, and gputils.
#
#   cmake -S . -B build -DCMAKE_TOOLCHAIN_FILE=.../sdcc-pic16.cmake
#         -DSDCC_CHIP=18f4520
#
# SDCC_CHIP is the chip as SDCC spells it. The compiler is CMAKE_C_COMPILER,
# else the environment's SDCC, else `sdcc` in PATH or the private one that
# fixpid's tools/firmware builds, the first that has the port pic16.
#
# Libraries are gplib archives (.lib); an executable is linked by gplink into
# NAME.hex with NAME.cod and NAME.map beside it. Links SDCC's run-time library
# and its start-up that clears RAM (crt0iz), and nothing of the chip: where SDCC
# comes without its device libraries, as Debian's does, the project declares its
# registers (fixpid's are in port/pic/pic18/). The options are those that
# made fixpid's controllers fastest.
set(SDCC_PORT pic16)
set(SDCC_DEFAULT_CHIP 18f4520)
set(SDCC_PORT_FLAGS
    "--fomit-frame-pointer --obanksel=9 --optimize-df --nogcse")
include(${CMAKE_CURRENT_LIST_DIR}/sdcc-pic.cmake)
