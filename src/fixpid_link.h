// SPDX-License-Identifier: MIT
// For Arduino, which looks for headers in src/ only.
#ifdef __has_include
#if !__has_include("../include/fixpid_link.h")
#error "fixpid: to have both in one folder copy src first, then include"
#endif
#endif
#include "../include/fixpid_link.h"
