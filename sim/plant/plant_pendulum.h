// SPDX-License-Identifier: MIT
// The inverted pendulum of AN964: a point mass on a massless rod, on a base
// that a motor moves along a straight line.
//
// AN964 equation B-15, angle'' = (g / R) sin(angle), extended by the base's
// acceleration a, which the note leaves to the motor:
//
//   angle'' = (g sin(angle) - a cos(angle)) / R + shove
//   a       = (full_speed supply drive - speed) / motor_time_constant
//
// The motor is a first-order lag whose drive saturates. The angle is sensed by
// the note's potentiometer through its second-order Bessel low-pass:
//
//   sensed'' = w^2 (angle - sensed) - (w / Q) sensed'
//   w = 1.2736 * 2 pi * corner (-3 dB there)
//
// Positive drive moves the base towards a positive angle, under the mass.
#ifndef PLANT_PENDULUM_H
#define PLANT_PENDULUM_H

#define PENDULUM_GRAVITY_M_S2 9.81
#define PENDULUM_FILTER_QUALITY 0.5774 // Q

enum pendulum_state {
    PENDULUM_ANGLE,       // rad from the vertical
    PENDULUM_RATE,        // rad/s
    PENDULUM_SPEED,       // of the base, m/s
    PENDULUM_POSITION,    // of the base, m
    PENDULUM_SENSED,      // rad, behind the filter
    PENDULUM_SENSED_RATE, // rad/s
    PENDULUM_STATES
};

struct pendulum {
    double rod_m;
    double full_speed_m_s; // of the base at full drive and full supply
    double motor_time_constant_s;
    double filter_corner_hz;
    double longest_step_s; // of the integrator

    double supply;       // fraction of the nominal voltage, 1: full
    double shove_rad_s2; // angular acceleration from outside

    double state[PENDULUM_STATES];
    double drive; // -1..1, of the last advance
};

// The note's pendulum of 0.5 m at rest in `angle_rad`, its filter settled.
void pendulum_init(struct pendulum *self, double angle_rad);

double pendulum_filter_rad_s(const struct pendulum *self); // w

// Advances by `seconds` at a constant drive, -1..1 (limited). The pendulum
// comes to rest where it meets the floor, at +-90 degrees.
void pendulum_advance(struct pendulum *self, double drive, double seconds);

#endif
