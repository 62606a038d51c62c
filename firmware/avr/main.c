/* The firmware's loop. Nothing in it waits; what hangs is reset by the watchdog within 60 ms, and the
 * pull-ups brake meanwhile. */
#include <avr/interrupt.h>
#include <avr/io.h>
#include <avr/wdt.h>

#include "board.h"
#include "config.h"

static const motor_t MOTOR = {FREE_RADPS, START_DUTY, KP, KI, TRIP_MS};
static controller_t controller;

/* The watchdog stays on through the reset that it makes, at its shortest time: off before all else. */
void stop_watchdog(void) __attribute__((naked, used, section(".init3")));
void stop_watchdog(void)
{
    MCUSR = 0;
    wdt_disable();
}

static bool is_due(uint32_t *due_us, uint32_t now_us, uint16_t period_ms)
{
    if ((int32_t)(now_us - *due_us) < 0)
        return false;
    *due_us += period_ms * 1000UL;
    if ((int32_t)(now_us - *due_us) >= 0) /* behind by more than one: no burst */
        *due_us = now_us + period_ms * 1000UL;
    return true;
}

static void regulate(inputs_t *inputs, uint32_t now_us)
{
    read_inputs(inputs);
    outputs_t outputs =
        control(&controller, read_left_encoder(), read_right_encoder(), inputs, now_us);
    if (outputs.torque) {
        drive_motors(outputs.left_duty, outputs.right_duty);
        PORTB |= _BV(PB5);
    } else {
        brake_motors();
        PORTB &= (uint8_t)~_BV(PB5);
    }
    wdt_reset(); /* here alone: a loop that turns without regulating is hung too */
}

int main(void)
{
    inputs_t inputs = {true, false, false, false, NOT_MEASURED, NOT_MEASURED};
    uint8_t state[STATE_BYTES], byte;

    begin_board();
    begin_serial();
    begin_controller(&controller, draw_boot(), &MOTOR, MOST_MA, read_left_encoder(),
                     read_right_encoder());
    wdt_enable(WDTO_60MS);
    sei();

    uint32_t control_due_us = clock_us(), state_due_us = control_due_us;
    for (;;) {
        uint32_t now_us = clock_us();
        while (read_serial(&byte))
            hear_byte(&controller, byte, now_us);
        if (is_silent(&controller, now_us))
            brake_motors();
        if (is_due(&control_due_us, now_us, CONTROL_PERIOD_MS))
            regulate(&inputs, now_us);
        if (is_due(&state_due_us, now_us, STATE_PERIOD_MS)) {
            report_state(&controller, read_left_encoder(), read_right_encoder(), &inputs, now_us,
                         state);
            write_serial(state, STATE_BYTES);
        }
    }
}
