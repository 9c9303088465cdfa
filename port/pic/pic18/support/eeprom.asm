; SPDX-License-Identifier: MIT
; For SDCC only: a generic pointer may point into EEPROM, so the run-time
; library's access through one refers to these. This firmware makes no such
; pointer: a reset.
        global  ___eeprom_gptrget1
        global  ___eeprom_gptrget2
        global  ___eeprom_gptrget3
        global  ___eeprom_gptrget4
        global  ___eeprom_gptrput1
        global  ___eeprom_gptrput2
        global  ___eeprom_gptrput3
        global  ___eeprom_gptrput4

        code
___eeprom_gptrget1:
___eeprom_gptrget2:
___eeprom_gptrget3:
___eeprom_gptrget4:
___eeprom_gptrput1:
___eeprom_gptrput2:
___eeprom_gptrput3:
___eeprom_gptrput4:
        reset
        end
