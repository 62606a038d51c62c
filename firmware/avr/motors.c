/* Two motors behind an H-bridge each. Shorted they brake; that is also what the pull-ups of the wiring
 * do while the pins float in a reset. */
#include <avr/io.h>

#include "../core/board.h"
#include "config.h"

#define TOP ((uint16_t)(F_CPU / 2 / PWM_HZ))

static int16_t with_sense(int16_t duty, int8_t sense)
{
    return sense > 0 ? duty : (int16_t)-duty;
}

static uint16_t magnitude(int16_t duty)
{
    return (uint16_t)(duty < 0 ? -duty : duty);
}

static uint16_t share_of(uint16_t top, uint16_t duty)
{
    return (uint16_t)((uint32_t)top * duty / FULL_DUTY);
}

#if DRIVER == DRIVER_PWM_IN_IN

/* PWM left D9, right D10; inputs left D4, D5, right D6, D7. Both inputs high short the motor, and so
 * does a low PWM of a TB6612FNG. */
enum { LEFT_1 = _BV(PD4), LEFT_2 = _BV(PD5), RIGHT_1 = _BV(PD6), RIGHT_2 = _BV(PD7) };
enum { ALL = LEFT_1 | LEFT_2 | RIGHT_1 | RIGHT_2 };

static void begin_pwm(void)
{
    ICR1 = TOP;
    TCCR1A = _BV(COM1A1) | _BV(COM1B1);
    TCCR1B = _BV(WGM13) | _BV(CS10); /* phase and frequency correct up to ICR1 */
    DDRB |= _BV(PB1) | _BV(PB2);
}

void brake_motors(void)
{
    PORTD |= ALL;
    DDRD |= ALL;
    OCR1A = OCR1B = TOP;
    begin_pwm();
}

void drive_motors(int16_t left_duty, int16_t right_duty)
{
    left_duty = with_sense(left_duty, LEFT_MOTOR_SENSE);
    right_duty = with_sense(right_duty, RIGHT_MOTOR_SENSE);
    uint8_t pins = PORTD & (uint8_t)~ALL;
    pins |= left_duty > 0 ? LEFT_1 : left_duty < 0 ? LEFT_2 : LEFT_1 | LEFT_2;
    pins |= right_duty > 0 ? RIGHT_1 : right_duty < 0 ? RIGHT_2 : RIGHT_1 | RIGHT_2;
    OCR1A = left_duty ? share_of(TOP, magnitude(left_duty)) : TOP;
    OCR1B = right_duty ? share_of(TOP, magnitude(right_duty)) : TOP;
    PORTD = pins;
}

#elif DRIVER == DRIVER_IN_IN

/* Inputs left D9, D10 by Timer1, right D11, D3 by Timer2. One input stays high and the other is low for
 * the duty's share, so that the motor is shorted in between: it obeys evenly in both senses. */
enum { TOP_2 = 255 };

void brake_motors(void)
{
    ICR1 = TOP;
    OCR1A = OCR1B = TOP;
    OCR2A = OCR2B = TOP_2;
    TCCR1A = _BV(COM1A1) | _BV(COM1B1);
    TCCR1B = _BV(WGM13) | _BV(CS10);
    TCCR2A = _BV(COM2A1) | _BV(COM2B1) | _BV(WGM20);
    TCCR2B = _BV(CS20);
    DDRB |= _BV(PB1) | _BV(PB2) | _BV(PB3);
    DDRD |= _BV(PD3);
}

void drive_motors(int16_t left_duty, int16_t right_duty)
{
    left_duty = with_sense(left_duty, LEFT_MOTOR_SENSE);
    right_duty = with_sense(right_duty, RIGHT_MOTOR_SENSE);
    uint16_t left_low = (uint16_t)(TOP - share_of(TOP, magnitude(left_duty)));
    uint8_t right_low = (uint8_t)(TOP_2 - share_of(TOP_2, magnitude(right_duty)));
    OCR1A = left_duty < 0 ? left_low : TOP;
    OCR1B = left_duty > 0 ? left_low : TOP;
    OCR2A = right_duty < 0 ? right_low : TOP_2;
    OCR2B = right_duty > 0 ? right_low : TOP_2;
}

#else
#error "DRIVER: expected DRIVER_PWM_IN_IN or DRIVER_IN_IN"
#endif
