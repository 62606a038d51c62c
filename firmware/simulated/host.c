/* The firmware's core for this computer, so that tests/firmware can hold it against the Python twin.
 * ctypes needs plain functions and one controller. */
#include "../core/controller.h"

static controller_t controller;
static motor_t motor;

void host_begin(uint32_t boot, const motor_t *described, uint16_t most_ma);
void host_hear(const uint8_t *bytes, uint32_t count, uint32_t now_us);
bool host_is_silent(uint32_t now_us);
void host_control(encoder_t left, encoder_t right, const inputs_t *inputs, uint32_t now_us,
                  outputs_t *outputs);
void host_report(encoder_t left, encoder_t right, const inputs_t *inputs, uint32_t now_us,
                 uint8_t *bytes);

void host_begin(uint32_t boot, const motor_t *described, uint16_t most_ma)
{
    const encoder_t none = {0, 0};
    motor = *described;
    begin_controller(&controller, boot, &motor, most_ma, none, none);
}

void host_hear(const uint8_t *bytes, uint32_t count, uint32_t now_us)
{
    while (count--)
        hear_byte(&controller, *bytes++, now_us);
}

bool host_is_silent(uint32_t now_us)
{
    return is_silent(&controller, now_us);
}

void host_control(encoder_t left, encoder_t right, const inputs_t *inputs, uint32_t now_us,
                  outputs_t *outputs)
{
    *outputs = control(&controller, left, right, inputs, now_us);
}

void host_report(encoder_t left, encoder_t right, const inputs_t *inputs, uint32_t now_us,
                 uint8_t *bytes)
{
    report_state(&controller, left, right, inputs, now_us, bytes);
}
