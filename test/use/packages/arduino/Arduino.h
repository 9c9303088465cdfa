// SPDX-License-Identifier: MIT
// Of Arduino's library what the sketches call, for a PC: host.cpp has it.
#ifndef ARDUINO_H
#define ARDUINO_H
#include <stdint.h>

#define F(text) (text)
#define A0 14
#define OUTPUT 1
#define LOW 0
#define HIGH 1
#define HEX 16
#define min(a, b) ((a) < (b) ? (a) : (b))
#define max(a, b) ((a) > (b) ? (a) : (b))

void pinMode(uint8_t pin, uint8_t mode);
void digitalWrite(uint8_t pin, uint8_t level);
void analogWrite(uint8_t pin, int value);
int analogRead(uint8_t pin);
unsigned long millis();

struct Serial_ {
    void begin(unsigned long baud);
    int available();
    int read();
    void print(const char *text);
    void print(char letter);
    void print(long number);
    void print(int number)
    {
        print((long)number);
    }
    void print(unsigned number)
    {
        print((long)number);
    }
    void print(int number, int base);
    void print(unsigned long number)
    {
        print((long)number);
    }
    template <class T> void println(T value)
    {
        print(value);
        print("\r\n");
    }
};
extern Serial_ Serial;

void setup();
void loop();

#endif
