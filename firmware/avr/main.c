/* The ATmega328P's start. The loop is ../core/loop.c. */
#include <avr/interrupt.h>
#include <avr/io.h>
#include <avr/wdt.h>

#include "../core/loop.h"
#include "config.h"

static const motor_t MOTOR = {FREE_RADPS, START_DUTY, KP, KI, TRIP_MS};

/* The watchdog stays on through the reset that it makes, at its shortest time: off before all else. */
void stop_watchdog(void) __attribute__((naked, used, section(".init3")));
void stop_watchdog(void)
{
    MCUSR = 0;
    wdt_disable();
}

void show_torque(bool torque)
{
    if (torque)
        PORTB |= _BV(PB5);
    else
        PORTB &= (uint8_t)~_BV(PB5);
}

void begin_watchdog(void)
{
    wdt_enable(WDTO_60MS);
    sei();
}

void feed_watchdog(void)
{
    wdt_reset();
}

int main(void)
{
    run_loop(&MOTOR, MOST_MA);
}
