// SPDX-License-Identifier: MIT
// The host port's other door: what its main program starts and records. The
// application sees port.h only.
#ifndef HOST_H
#define HOST_H
#include <stdbool.h>
#include <stdint.h>

// A controller's terms at one instant, to record beside the plant.
struct host_terms {
    double proportional;
    double integral;
    double derivative;
    double accumulated_error; // the sum behind the integral term
};

// Bound by the linker: the program's probe looks at its controller, so that the
// port need not know it.
void host_probe(struct host_terms *terms);

// Bound in the same way: prints what the application has found out, if
// anything, when it has come to its end.
void host_report(void);

// The application's `main`, renamed by the build.
int application_main(void);

// Opens the trace; false when it cannot be written. One row each `period_s`.
bool host_trace_open(const char *path, double period_s);

// False when the trace is not complete, for instance on a full disk.
bool host_trace_close(void);

// The seed of the world's noise, before application_main.
void host_seed(uint32_t seed);

// ---- For who breaks the loop on purpose ----

// Called, if it is not NULL, by each of the port's functions, and as time
// passes in them, at least four times a tick. It need not return.
extern void (*host_watch)(void);

// The timer is this many ticks ahead of the time, or behind.
void host_shift_ticks(double ticks);

// When the watchdog was fed last.
double host_fed_s(void);

// The chip is reset: the drive is off, and the next port_init finds the world
// as it is.
void host_reset(void);

// What port_drive made of its last duty, and what that was.
int16_t host_drive_counts(void);
int16_t host_drive_asked(void);

#endif
