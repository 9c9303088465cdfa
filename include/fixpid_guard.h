/* SPDX-License-Identifier: MIT */
#include "fixpid.h"
// fixpid_guard: reports when a loop no longer does what it should.
//
// This is not a safety device. It reports early what would otherwise be noticed
// late. If the plant's dead time is longer than a quarter of its lag and the
// plant can do harm, it needs a hardware cut-out, such as a thermal fuse:
// nothing that reads the sensor can then be early enough.
//
// A guard works with any controller. Call it once per step, after the
// controller, with the controller's inputs and output:
//   output = fixpid_pid_step(&pid, setpoint, y);
//   flags = fixpid_guard_step(&guard, setpoint, y, output);
//   if ((flags & FIXPID_GUARD_ALARMS) != 0) {
//       off = true; // until a person says that the loop may go on
//   }
// It never changes the output: the application decides. On an alarm it should
// switch the output off, keep it off whatever the flags are later, tell a
// person, and go on only when that person acknowledges, with
// fixpid_guard_acknowledge. With FIXPID_GUARD_NOT_FALLING the output is already
// off or has no effect: cut the supply, with a second contactor.
//
// The steps are the clock. Setpoint and measurement are counts of the sensor,
// the output is counts of the actuator, any int16_t each. Nothing is rounded,
// and no difference overflows. A step has no division, no multiplication and no
// number of 32 bits.
//
// There is nothing to arm. A new setpoint, a ramp, a cold start, or an output
// that stays at its end while the reading moves raise no alarm and need no
// call. While the loop is open, in manual or while a tuner runs, call
// fixpid_guard_step(&guard, y, y, output): then the guard watches only the
// sensor. With fixpid_tpo, give the guard the duty, not the relay's state.
//
// Some loops swing for ever although nothing is broken: under on-off control,
// with a PWM of ten levels, with a valve or a joint that sticks. They set
// FIXPID_GUARD_OSCILLATING. Make the band wider than the swing, or do not
// switch off on this alarm.
//
// What it does not see: a sensor that drifts slowly; one without noise that
// sticks exactly at the setpoint; one that sticks inside the band, until the
// output reaches its end and stays there.
//
// Any number of them work side by side. Functions of one must not interrupt
// each other; fixpid.h lists the chips on which those of two must not either.
#ifndef FIXPID_GUARD_H
#define FIXPID_GUARD_H
#include <stdbool.h>
#include <stdint.h>

FIXPID_C_BEGIN

// What fixpid_guard_init takes. If a tuner has measured the plant,
// fixpid_guard_from_model finds band, patience and `noisy`. Without a model:
//   band      1.5 times the jitter of the reading at rest, peak to peak; at
//             least 4 counts, and at least as much as two counts of the output
//             move the reading in the end
//   patience  twice the steps in which full output, from cold, moves the
//             reading by ten bands
// A loop without an integral needs a band above its steady-state offset.
struct fixpid_guard_config {
    // The controller's range, output_min < output_max. An output at or beyond
    // an end counts as at that end.
    int16_t output_min;
    int16_t output_max;

    // The readings that a working sensor can give, measurement_min <
    // measurement_max: an open or shorted sensor reads outside. If both are 0,
    // every reading is possible.
    int16_t measurement_min;
    int16_t measurement_max;

    // The readings to which the ends of the output are sure to bring the
    // process, within the readings above and more than two bands apart. A
    // setpoint beyond one of them counts as this one, so that "off" and "full"
    // raise no alarm. A reading beyond may stand still. The lowest and the
    // highest setpoint that the loop must hold are a safe choice. If both are
    // 0, they are measurement_min and measurement_max. That is only for a loop
    // that reaches every setpoint: a heater that is switched off by a setpoint
    // of 0 never reads 0, which is an alarm.
    int16_t reach_min;
    int16_t reach_max;

    // The smallest movement that is not noise, 1..32767 counts of the
    // measurement.
    uint16_t band;

    // The steps in which an end of the output is sure to move the reading by a
    // band: 2..32767.
    uint16_t patience;

    bool reverse; // the output falls to raise the reading
    bool noisy;   // a working sensor never gives 2 * patience equal readings
};

// The bits that a step returns. An alarm stays set until
// fixpid_guard_acknowledge or fixpid_guard_reset.
//
// NOT_RISING: the output has been at the end that raises the reading for
// `patience` steps, and the reading has not come a band nearer to the setpoint
// from where it was farthest. Causes: a broken heater; a sensor that is off,
// stuck or shorted; a wrong sign. NOT_FALLING: the same downward, as with a
// relay that does not open.
#define FIXPID_GUARD_NOT_RISING 0x01u
#define FIXPID_GUARD_NOT_FALLING 0x02u
#define FIXPID_GUARD_FROZEN 0x04u      // the reading does not change
#define FIXPID_GUARD_OSCILLATING 0x08u // 12 swings across the band
#define FIXPID_GUARD_SENSOR_LOW 0x10u  // 4 readings below measurement_min
#define FIXPID_GUARD_SENSOR_HIGH 0x20u // 4 readings above measurement_max
#define FIXPID_GUARD_ALARMS 0x3Fu      // all of the above

// Not an alarm: the reading has been in the band for `patience` steps and has
// not left it.
#define FIXPID_GUARD_SETTLED 0x40u

// There was no good init: nothing is watched.
#define FIXPID_GUARD_REFUSED 0x80u

// This is private, and open only so that the application can allocate it: 32
// bytes.
struct fixpid_guard {
    int16_t output_min;
    int16_t output_max;
    int16_t measurement_min;
    int16_t measurement_max;
    int16_t reach_min;
    int16_t reach_max;
    uint16_t band;
    uint16_t patience; // 0: refused
    int16_t last;      // the reading of the last `run` steps and the one before
    uint16_t run;
    int16_t hold;   // the output when `run` came to patience
    uint16_t count; // of int16_t: at an end inside the band, it is below 0
    int16_t mark;   // the reading from which progress counts
    int16_t anchor; // the setpoint for which swings are counted
    uint8_t flags;
    uint8_t state;
    uint8_t swings;
    uint8_t strikes;
};

// What a tuner has found out about the plant. The first three members are those
// of struct fixpid_reaction_process, in its order; struct
// fixpid_autotune_process also has the gain.
struct fixpid_guard_model {
    uint32_t slope_q24; // counts per step for one of the output, x 2^24
    uint32_t dead_q4;   // the delay L in steps, x 16
    uint16_t noise_q4;  // the noise s in counts, x 16

    // The gain K, counts of the measurement for one of the output, x 256; 0 if
    // it is not known. FIXPID_AUTOTUNE_INTEGRATING counts as 0.
    uint32_t gain_q8;

    // A band to use instead of the rule's: wider than a swing that is not a
    // fault, or than a steady-state offset. 0: the rule's.
    uint16_t band;

    // The number of bands by which full output could move the reading within
    // the patience. 0 means 20, for setpoints that 5 to 95 % of the output
    // hold. A plant that cools slowly needs more: 100 divided by the percentage
    // that holds the lowest setpoint, as 50 for a kettle that 2 % keep hot.
    uint8_t bands;
};

// Writes band, patience and `noisy` into a configuration that has its output's
// range, and nothing else:
//   band     = ceil(max(8 s + 4, 2 K))
//   patience = ceil(2 L + bands * band / (slope * (output_max -
//              output_min))), at least 4
//   noisy      if s >= 1 and patience >= 16
// Half of that patience raises false alarms. False, and nothing written, if the
// slope is 0, the output has no range, or band or patience would be above
// 32767: then use a slower rate. It divides, and it is in fixpid_guard_more.c.
bool fixpid_guard_from_model(struct fixpid_guard_config *config,
                             const struct fixpid_guard_model *model);

// Starts anew: nothing is known yet, and no flag is set. A value outside its
// range above is refused: the result is false, and until a good init the flags
// are FIXPID_GUARD_REFUSED. An all-zero object is refused, too.
bool fixpid_guard_init(FIXPID_DATA struct fixpid_guard *self,
                       const struct fixpid_guard_config *config);

// As after init with the same configuration.
void fixpid_guard_reset(FIXPID_DATA struct fixpid_guard *self);

// Clears the alarms and every count towards one. Call it only when a person has
// looked at the plant. FIXPID_GUARD_SETTLED stays.
void fixpid_guard_acknowledge(FIXPID_DATA struct fixpid_guard *self);

// One step, after the controller's; returns the flags. What it counts:
//   range        4 readings in a row outside measurement_min..max;
//   frozen       `patience` equal readings within reach, and then as many in
//                which the output is more than a quarter of its range away from
//                where it was; with a noisy sensor, then as many of any output;
//   not rising   outside the band around the setpoint: steps at the end of the
//   not falling  output that drives the reading to it; a step not at an end
//                neither counts nor restarts the count. Inside the band: steps
//                at an end, while the reading is not the setpoint itself; each
//                step not at an end takes one back, and the other end clears
//                the count;
//   oscillating  changes from one side of the band to the other, while the
//                setpoint does not move by more than a band and the loop does
//                not settle.
// A reading that has left the band is inside again at half its width.
uint8_t fixpid_guard_step(FIXPID_DATA struct fixpid_guard *self,
                          int16_t setpoint, int16_t measurement,
                          int16_t output);

// The flags after the last call.
uint8_t fixpid_guard_flags(FIXPID_DATA const struct fixpid_guard *self);

// Object mode, for firmware with one guard: compile the application and
// fixpid_guard.c with -DFIXPID_GUARD_OBJECT=name, and define that object at
// file scope, not static. Calls stay as they are; the pointer is ignored.
// FIXPID_GUARD_PLACE may put it at an address. docs/cost.md has what that
// saves. Sources that disagree about the object or its place do not link.
#ifdef FIXPID_GUARD_OBJECT
extern FIXPID_DATA struct fixpid_guard FIXPID_GUARD_PLACE FIXPID_GUARD_OBJECT;
#endif

FIXPID_C_END

#endif
