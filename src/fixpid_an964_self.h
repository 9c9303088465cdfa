// SPDX-License-Identifier: MIT
// Private: how fixpid_an964's files reach their controller, the one that their
// caller points at or, in object mode, the one with a name.
#ifndef FIXPID_AN964_SELF_H
#define FIXPID_AN964_SELF_H

#ifdef FIXPID_AN964_OBJECT
#define SELF FIXPID_AN964_OBJECT
#define VALID(self) ((self) == &SELF)
#else
#define SELF (*self)
#define VALID(self) ((self) != 0)
#endif

#endif
