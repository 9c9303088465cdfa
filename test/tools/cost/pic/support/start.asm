; SPDX-License-Identifier: MIT
; For SDCC only: start-up of any PIC16, which clears no RAM. A PIC18's is SDCC's.
        global  __sdcc_gsinit_startup
        extern  _main

STARTCODE code
__sdcc_gsinit_startup:
        pagesel _main
        goto    _main
        end
