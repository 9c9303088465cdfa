// SPDX-License-Identifier: MIT
// A permanent-magnet DC motor on a bridge, with a tachometer's view of it.
//
//   L current' = supply drive - R current - K speed
//   J speed'   = K current - b speed - friction - load
//
// friction is Coulomb's, smoothed around standstill. The load torque opposes a
// positive speed. Without friction and load the mechanical time constant is
// R J / K^2 and the speed at full drive is supply / K.
#ifndef PLANT_MOTOR_H
#define PLANT_MOTOR_H

enum motor_state {
    MOTOR_CURRENT, // A
    MOTOR_SPEED,   // rad/s
    MOTOR_STATES
};

struct motor {
    double supply_v;
    double resistance_ohm;
    double inductance_h;
    double constant_v_s; // K: V s/rad, and N m/A
    double inertia_kg_m2;
    double viscous_n_m_s; // b
    double friction_n_m;
    double longest_step_s; // of the integrator

    double load_n_m;

    double state[MOTOR_STATES];
    double drive; // -1..1, of the last advance
};

// A motor of 24 V with a mechanical time constant of 25 ms, at rest.
void motor_init(struct motor *self);

// Advances by `seconds` at a constant drive, -1..1 (limited).
void motor_advance(struct motor *self, double drive, double seconds);

#endif
