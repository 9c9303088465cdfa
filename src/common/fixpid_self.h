// SPDX-License-Identifier: MIT
// A source reaches its controller by the name that it defined as OBJECT (object
// mode), else through the caller's pointer. This header has no include guard,
// because several sources may be compiled as one file.
#undef SELF
#undef VALID
#ifdef OBJECT
#define SELF (*((void)self, &OBJECT)) // `self` counts as used
#define VALID(self) ((self) == &OBJECT)
#else
#define SELF (*self)
#define VALID(self) ((self) != 0)
#endif
