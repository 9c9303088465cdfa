// SPDX-License-Identifier: MIT
// Private: how fixpid_an964_8bit's files reach their controller, the one that
// their caller points at or, in object mode, the one with a name.
#ifndef FIXPID_AN964_8BIT_SELF_H
#define FIXPID_AN964_8BIT_SELF_H

#ifdef FIXPID_AN964_8BIT_OBJECT
#define SELF FIXPID_AN964_8BIT_OBJECT
#define VALID(self) ((self) == &SELF)
#else
#define SELF (*self)
#define VALID(self) ((self) != 0)
#endif

#endif
