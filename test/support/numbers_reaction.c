// SPDX-License-Identifier: MIT
#include "numbers_reaction.h"

#include "numbers.h"
#include "numbers_control.h"

#define DELAY_MAX 16u
#define FRACTION 13 // bits of a position, which is below 2^15 counts

static struct {
    int32_t first;
    int32_t second;
    int32_t span; // where it ends, or what the integrator adds up
    int16_t start;
    int16_t rest;
    uint16_t noise;
    uint8_t on[DELAY_MAX];
    uint8_t delay;
    uint8_t at;
    uint8_t first_shift;
    uint8_t second_shift;
    uint8_t quantum_shift;
    bool integrating;
    bool falling;
} plant;

static int16_t within_16_bits(int32_t value)
{
    if (value > INT16_MAX) {
        return INT16_MAX;
    }
    return (int16_t)((value < INT16_MIN) ? INT16_MIN : value);
}

static void draw_plant(void)
{
    plant.first = 0;
    plant.second = 0;
    plant.span = ((int32_t)1 << (FRACTION + 4)) << numbers_below(11);
    plant.start =
        numbers_one_in(8) ? numbers_int16() : (int16_t)numbers_below(1000);
    plant.noise = numbers_one_in(3) ? 0u : (uint16_t)(1u << numbers_below(9));
    for (uint8_t i = 0; i < DELAY_MAX; i++) {
        plant.on[i] = 0;
    }
    plant.delay = (uint8_t)(1u + numbers_below(DELAY_MAX));
    plant.at = 0;
    plant.first_shift = (uint8_t)numbers_below(5);
    plant.second_shift = (uint8_t)(2u + numbers_below(10));
    plant.quantum_shift = (uint8_t)(numbers_one_in(3) ? numbers_below(6) : 0u);
    plant.integrating = numbers_one_in(4);
}

void numbers_reaction_config(struct fixpid_reaction_config *config)
{
    const int32_t far = (int32_t)(numbers_any_size() & 0xFFFFu);
    const bool beyond = numbers_one_in(20);

    draw_plant();
    config->output_rest = numbers_one_in(4) ? numbers_int16() : 0;
    config->output_drive = numbers_one_in(4)
                               ? numbers_int16()
                               : numbers_close_to(config->output_rest, 1000);
    config->timeout_steps = 0;
    if (numbers_one_in(3)) {
        config->timeout_steps = (uint16_t)(1u + numbers_below(2000));
    }
    if (numbers_one_in(50)) {
        config->timeout_steps = (uint16_t)(32767u + numbers_below(2));
    }
    config->reverse = numbers_one_in(3);
    plant.rest = config->output_rest;
    plant.falling =
        (config->output_drive > config->output_rest) == config->reverse;
    config->measurement_stop =
        within_16_bits(plant.start + ((plant.falling != beyond) ? -far : far));
    if (numbers_one_in(30)) {
        plant.falling = !plant.falling;
    }
}

int16_t numbers_reaction_measure(void)
{
    int32_t counts = plant.second >> FRACTION;

    if (plant.noise != 0u) {
        counts += (int32_t)numbers_below(plant.noise) - (plant.noise >> 1);
    }
    if (numbers_one_in(4000)) {
        counts += numbers_int16();
    }
    counts = (counts >> plant.quantum_shift) * (1 << plant.quantum_shift);
    return within_16_bits(plant.start + (plant.falling ? -counts : counts));
}

void numbers_reaction_move(int16_t output)
{
    const int32_t goal = (plant.on[plant.at] != 0u) ? plant.span : 0;

    plant.on[plant.at] = (output != plant.rest) ? 1u : 0u;
    plant.at++;
    if (plant.at >= plant.delay) {
        plant.at = 0;
    }
    plant.first += (goal - plant.first) >> plant.first_shift;
    if (!plant.integrating) {
        plant.second += (plant.first - plant.second) >> plant.second_shift;
    } else if (plant.second < ((int32_t)1 << 28)) {
        plant.second += plant.first >> plant.second_shift;
    } else {
        // It is full.
    }
}
