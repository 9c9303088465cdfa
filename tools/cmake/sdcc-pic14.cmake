# SPDX-License-Identifier: MIT
# Toolchain file: CMake (3.16 or later) builds firmware for 14-bit PICs (PIC12,
# PIC16) with SDCC and gputils.
#
#   cmake -S . -B build -DCMAKE_TOOLCHAIN_FILE=.../sdcc-pic14.cmake
#         -DSDCC_CHIP=16f684
#
# SDCC_CHIP is the chip as SDCC spells it. The compiler is CMAKE_C_COMPILER,
# else the environment's SDCC, else `sdcc` in PATH or the private one that
# fixpid's tools/firmware builds, the first that has the port pic14.
#
# Libraries are gplib archives (.lib); an executable is linked by gplink into
# NAME.hex with NAME.cod and NAME.map beside it. Links SDCC's run-time library
# and nothing of the chip: where SDCC comes without its device libraries, as
# Debian's does, the project declares its registers (fixpid's are in
# port/pic/pic16f684). SDCC's own start-up does not clear RAM.
# With -DSDCC_ONE_BANK=ON all variables lie in bank 0 of a chip with two, and a
# file is compiled to know no other bank, which makes fixpid's controllers faster
# and smaller. What uses a register elsewhere is to say so:
#
#   set_source_files_properties(port.c PROPERTIES COMPILE_OPTIONS --all-banks)
#
# and is to return in bank 0. A link that breaks that fails; it needs ruby.
set(SDCC_PORT pic14)
set(SDCC_DEFAULT_CHIP 16f684)
set(SDCC_PORT_FLAGS "")
option(SDCC_ONE_BANK "Keep all variables in bank 0" OFF)
include(${CMAKE_CURRENT_LIST_DIR}/sdcc-pic.cmake)
