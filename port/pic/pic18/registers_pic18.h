// SPDX-License-Identifier: MIT
// The registers that port_pic18.h uses and that all of its chips have at the
// same address, and the bits that it names. The rest is in a chip's
// registers.h, which includes this.
#ifndef PORT_PIC_REGISTERS_PIC18_H
#define PORT_PIC_REGISTERS_PIC18_H
#include "../compiler.h"

PORT_REGISTER(0xF89, LATA);
PORT_REGISTER(0xF8A, LATB);
PORT_REGISTER(0xF8B, LATC);
PORT_REGISTER(0xF92, TRISA);
PORT_REGISTER(0xF93, TRISB);
PORT_REGISTER(0xF94, TRISC);
PORT_REGISTER(0xF9E, PIR1);
PORT_REGISTER(0xFA0, PIE2);
PORT_REGISTER(0xFA1, PIR2);
PORT_REGISTER(0xFA2, IPR2);
PORT_REGISTER(0xFA6, EECON1);
PORT_REGISTER(0xFA7, EECON2);
PORT_REGISTER(0xFA8, EEDATA);
PORT_REGISTER(0xFA9, EEADR);
PORT_REGISTER(0xFBD, CCP1CON);
PORT_REGISTER(0xFBE, CCPR1L);
PORT_REGISTER(0xFC0, ADCON2);
PORT_REGISTER(0xFC1, ADCON1);
PORT_REGISTER(0xFC2, ADCON0);
PORT_REGISTER(0xFC3, ADRESL);
PORT_REGISTER(0xFC4, ADRESH);
PORT_REGISTER(0xFCD, T1CON);
PORT_REGISTER(0xFD0, RCON);
PORT_REGISTER(0xFF2, INTCON);

struct port_pir1 {
    unsigned int : 1;
    unsigned int TMR2IF : 1;
};
PORT_BITS(0xF9E, struct port_pir1, PIR1bits);

struct port_adcon0 {
    unsigned int : 1;
    unsigned int GO : 1;
};
PORT_BITS(0xFC2, struct port_adcon0, ADCON0bits);

#define PIR1_TMR2IF 0x02u
#define PIR2_CCP2IF 0x01u
#define ADCON0_GO 0x02u
#define CCP1CON_DC1B 0x30u

#endif
