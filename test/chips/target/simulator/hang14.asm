; SPDX-License-Identifier: MIT
; Looks to the co-simulation like a pendulum's firmware, and hangs in its first
; pass, with the watchdog off.
        list p=16f684, r=dec
        include "p16f684.inc"
        __config _INTOSCIO & _WDT_OFF & _MCLRE_ON
        global _pendulum, _port_wait_tick

objects udata
_pendulum
        res 20

reset   code 0
        goto main
program code
_port_wait_tick
        return
main:   call _port_wait_tick
hang:   goto hang
        end
