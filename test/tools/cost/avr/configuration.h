// SPDX-License-Identifier: MIT
// An AVR's fuses are not in its firmware.
