#include "loop.h"

static controller_t controller;

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
    if (outputs.torque)
        drive_motors(outputs.left_duty, outputs.right_duty);
    else
        brake_motors();
    show_torque(outputs.torque);
    feed_watchdog(); /* here alone: a loop that turns without regulating is hung too */
}

void run_loop(const motor_t *motor, uint16_t most_ma)
{
    inputs_t inputs = {true, false, false, false, NOT_MEASURED, NOT_MEASURED};
    uint8_t state[STATE_BYTES], byte;

    begin_board();
    begin_serial();
    begin_controller(&controller, draw_boot(), motor, most_ma, read_left_encoder(),
                     read_right_encoder());
    begin_watchdog();

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
