// SPDX-License-Identifier: MIT
// Runs a sketch on the PC until it has printed so many lines in loop(): what it
// prints is what the simulated chip must print, too.
//
//   host LINES
#include <cstdio>
#include <cstdlib>

#include "Arduino.h"

#include "room.h"

Serial_ Serial;

static int drive; // of pin 9
static long lines;

void pinMode(uint8_t, uint8_t)
{
}

void digitalWrite(uint8_t, uint8_t level)
{
    drive = (level != LOW) ? 255 : 0;
}

void analogWrite(uint8_t, int value)
{
    drive = value;
}

int analogRead(uint8_t)
{
    return room_counts(drive);
}

unsigned long millis()
{
    static unsigned long now;
    return ++now;
}

void Serial_::begin(unsigned long)
{
}

int Serial_::available()
{
#ifdef KEY
    static bool sent;

    if (!sent && (room_steps >= KEY)) {
        sent = true;
        return 1;
    }
#endif
    return 0;
}

int Serial_::read()
{
    const char *const key = std::getenv("KEY_SENT");
    return (key != nullptr) ? *key : 'a';
}

void Serial_::print(int number, int)
{
    std::printf("%X", static_cast<unsigned>(number));
}

void Serial_::print(const char *text)
{
    for (; *text != '\0'; text++) {
        print(*text);
    }
}

void Serial_::print(char letter)
{
    lines += letter == '\n';
    std::putchar(letter);
}

void Serial_::print(long number)
{
    std::printf("%ld", number);
}

int main(int, char **argv)
{
    const long wanted = std::atol(argv[1]);

    setup();
    while (lines < wanted) {
        loop();
    }
}
