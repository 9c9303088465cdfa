// SPDX-License-Identifier: MIT
// The board of the motor and ovens: PWM on CCP1 (RC2), the direction on RC0 of
// a PIC18, which BOARD_PROCESSOR names.
#include "board.hh"

#include <string_view>

#include "port_board.h"

namespace
{

constexpr unsigned latc = 0xF8B, trisc = 0xF94;
constexpr unsigned ccp1con = 0xFBD, ccpr1l = 0xFBE;
constexpr unsigned adcon0 = 0xFC2;
constexpr unsigned t2con =
    std::string_view(BOARD_PROCESSOR) == "p18f26k22" ? 0xFBA : 0xFCA;

constexpr unsigned direction_pin = 0x01; // RC0; high is reverse
constexpr unsigned drive_pins = 0x05;
constexpr unsigned timer_on = 0x04;
constexpr unsigned go = 0x02; // of ADCON0, the rest is the channel

} // namespace

const Board board = {
    BOARD_PROCESSOR,
    40e6, // 10 MHz times the HSPLL's 4
    1000, // 0.1 ms
    {0x08},
    {{PORT_SETPOINT, "porta0"},
     {PORT_TACHOMETER, "porta1"},
     {PORT_TEMPERATURE, "porta2"}},
    adcon0,
    go,
    no_channel,
    {ccpr1l, ccp1con, t2con, trisc, latc},
};

unsigned board_channel(const Chip &, unsigned control)
{
    return control & ~go;
}

int board_drive_counts(const Chip &chip)
{
    const unsigned control = chip.peek(ccp1con);
    const bool pwm = (control & 0x0C) == 0x0C;
    const bool running = (chip.peek(t2con) & timer_on) != 0;
    const bool driven = (chip.peek(trisc) & drive_pins) == 0;
    if (!pwm || !running || !driven) {
        return 0;
    }
    const int counts = (int)((chip.peek(ccpr1l) << 2) | ((control >> 4) & 3));
    return ((chip.peek(latc) & direction_pin) != 0) ? -counts : counts;
}
