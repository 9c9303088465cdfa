// SPDX-License-Identifier: MIT
// The pendulum's board: a full bridge on P1A to P1D (RC5 to RC2).
#include "board.hh"

#include "port_board.h"

namespace
{

constexpr unsigned t2con = 0x12, ccpr1l = 0x13, ccp1con = 0x15;
constexpr unsigned adcon0 = 0x1F, trisc = 0x87, pr2 = 0x92;

constexpr unsigned bridge_pins = 0x3C;
constexpr unsigned timer_on = 0x04;
constexpr unsigned go = 0x02; // of ADCON0, the rest is the channel

} // namespace

const Board board = {
    "p16f684",
    0.0,
    500, // 0.25 ms
    {0x04},
    {{PORT_ANGLE, "porta0"},
     {PORT_KP, "porta2"},
     {PORT_KI, "portc0"},
     {PORT_KD, "portc1"}},
    adcon0,
    go,
    no_channel,
    {ccpr1l, ccp1con, t2con, trisc},
};

unsigned board_channel(const Chip &, unsigned control)
{
    return control & ~go;
}

int board_drive_counts(const Chip &chip)
{
    const unsigned control = chip.peek(ccp1con);
    const bool pwm = (control & 0x0C) == 0x0C;
    const bool full_bridge = (control & 0x40) != 0;
    const bool running = (chip.peek(t2con) & timer_on) != 0;
    const bool driven = (chip.peek(trisc) & bridge_pins) == 0;
    if (!pwm || !full_bridge || !running || !driven) {
        return 0;
    }
    // A count is a quarter of an instruction cycle.
    const unsigned full = 4 * (chip.peek(pr2) + 1);
    const unsigned duty = (chip.peek(ccpr1l) << 2) | ((control >> 4) & 3);
    const int counts =
        (duty < full) ? (int)(duty * PORT_DRIVE_FULL / full) : PORT_DRIVE_FULL;
    return ((control & 0x80) != 0) ? -counts : counts;
}
