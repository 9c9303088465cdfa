// SPDX-License-Identifier: MIT
// A driver's firmware on a simulated chip, asked one question after another.
#ifndef DRIVER_HH
#define DRIVER_HH
#include <functional>
#include <string>
#include <vector>

#include "chip.hh"

extern "C" {
#include "cases.h"
}

class Driver
{
  public:
    // `cod` is a firmware of driver_main.c with this controller's driver.
    Driver(const std::string &cod, const controller &which);

    // Before each question that initialises, the controller's object is filled
    // with arbitrary bytes.

    // Where main begins, all RAM is filled with them, too, whatever start-up
    // has cleared. A port relies on that.
    void poison_ram();

    // Bits of a byte of the controller's object flip, between two turns.
    void flip(unsigned byte, unsigned bits);

    // Question after question: `ask` gives the next or ends the run with false,
    // `judge` gets what came back. Throws ChipError for anything else that ends
    // the run, or if gpsim had anything to say.
    std::function<bool(question &asked)> ask;
    std::function<void(const answer &given)> judge;
    void run();

    // Or turn by turn, without `ask`: put() starts the chip's turn, run_turn()
    // ends with it, and the cycles in between are the caller's.
    void put(const question &asked);
    void run_turn();
    answer get() const;

    Chip chip;

  private:
    void take_turn();
    void check_end();
    void poison_object();

    const controller &tested;
    unsigned turn;
    unsigned exchange;
    unsigned object;
    bool started = false; // main has
    bool waiting = false; // for an answer
};

// True if the chip's answer is the expected one; else says what differs, for
// the first few, and of which question.
bool same_answer(const controller &tested, const std::string &what,
                 const answer &expected, const answer &given);

// A controller by name; throws ChipError.
const controller &find_controller(const std::string &name);

#endif
