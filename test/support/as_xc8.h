// SPDX-License-Identifier: MIT
// What is compiled after this is preprocessed as by XC8 for a PIC: `-include`
// it, with the chip's class, `-D_PIC14`, `_PIC14E`, `_PIC14EX` or `_PIC18`, for
// avr-gcc or clang --target=avr and with -funsigned-char. Types are XC8's then:
// an int of 16 bits, a double of 32, a char without a sign.
//
// Whether XC8, whose front end is clang, calls itself GNU is not known: with
// -DAS_XC8_GNU it does.
#ifndef AS_XC8_H
#define AS_XC8_H

#pragma GCC system_header // to undefine without a warning
#if (__SIZEOF_INT__ != 2) || (__SIZEOF_DOUBLE__ != 4) ||                       \
    !defined(__CHAR_UNSIGNED__)
#error "XC8 has other types"
#endif
#if defined(_PIC14) + defined(_PIC14E) + defined(_PIC14EX) +                   \
        defined(_PIC18) !=                                                     \
    1
#error "XC8 defines one class"
#endif
#define __XC8 1
#define __XC8_VERSION 2460
#undef AVR
#undef __AVR
#undef __AVR__
#undef __AVR_HAVE_MOVW__
#undef __AVR_HAVE_MUL__
#ifndef AS_XC8_GNU
#undef __GNUC__
#endif

#endif
