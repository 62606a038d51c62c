/* Which pin does what. PWM: GP16 and 17 are slice 0, GP18 and 19 slice 1; each A and B. */
#ifndef PONS_PINS_H
#define PONS_PINS_H

#define CRYSTAL_HZ 12000000UL /* also the processor's: no PLL runs */

enum {
    PIN_TX = 0, PIN_RX = 1,
    PIN_STOP = 2, PIN_BUMPER_FRONT = 3, PIN_BUMPER_REAR = 4, PIN_CLIFF = 5,
    PIN_LEFT_A = 8, PIN_LEFT_B = 9, PIN_RIGHT_A = 10, PIN_RIGHT_B = 11,
    PIN_16 = 16, PIN_17 = 17, PIN_18 = 18, PIN_19 = 19, PIN_20 = 20, PIN_21 = 21,
    PIN_LIGHT = 25, PIN_BATTERY = 26, PIN_CURRENT = 27, /* inputs 0 and 1 of the converter */
};

#define BIT(pin) (1UL << (pin))

void begin_output(uint32_t pin);
void begin_input(uint32_t pin);
void give_pin(uint32_t pin, uint32_t function);

#endif
