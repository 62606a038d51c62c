#include "controller.h"

#include <string.h>

/* Not enums: an int of the AVR has 16 bits. */
static const uint32_t LEAST_TICKS_PER_TURN = 4, MOST_TICKS_PER_TURN = 1000000;
static const int32_t MOST_MRADPS = 1000000;
static const uint16_t OVERCURRENT_MS = 100; /* a motor that starts draws its stall current for less */

void begin_controller(controller_t *controller, uint32_t boot, const motor_t *motor, uint16_t most_ma,
                      encoder_t left, encoder_t right)
{
    memset(controller, 0, sizeof *controller);
    controller->boot = boot ? boot : 1;
    controller->most_ma = most_ma;
    begin_wheel(&controller->left, motor, left);
    begin_wheel(&controller->right, motor, right);
}

static bool is_speed(int32_t mradps)
{
    return mradps >= -MOST_MRADPS && mradps <= MOST_MRADPS;
}

/* A number that does not grow is an old command that lay somewhere: no sign of life. Another boot is a
 * host that began anew; another wheel within one boot is a host that is confused. */
static bool is_acceptable(const controller_t *controller, const command_t *fresh)
{
    const command_t *last = &controller->command;
    if (fresh->boot == 0 || fresh->ttl_ms < TTL_MIN_MS || fresh->ttl_ms > TTL_MAX_MS)
        return false;
    if (fresh->ticks_per_turn < LEAST_TICKS_PER_TURN || fresh->ticks_per_turn > MOST_TICKS_PER_TURN)
        return false;
    if (!is_speed(fresh->left_mradps) || !is_speed(fresh->right_mradps))
        return false;
    if (fresh->boot != last->boot)
        return true;
    return fresh->seq > last->seq && fresh->ticks_per_turn == last->ticks_per_turn;
}

void hear_byte(controller_t *controller, uint8_t byte, uint32_t now_us)
{
    command_t fresh;
    if (!read_byte(&controller->reader, byte, &fresh) || !is_acceptable(controller, &fresh))
        return;
    controller->command = fresh;
    controller->heard_us = now_us;
    controller->is_alive = true;
    if (!(fresh.flags & FLAG_ENABLE))
        controller->is_tripped = false; /* the host took the torque away itself: begin again */
}

bool is_silent(controller_t *controller, uint32_t now_us)
{
    /* Kept as a fact: the age itself would look young again after 71 minutes. */
    if (now_us - controller->heard_us > (uint32_t)controller->command.ttl_ms * 1000u)
        controller->is_alive = false;
    return !controller->is_alive;
}

static bool has_torque(const controller_t *controller, const inputs_t *inputs)
{
    return controller->is_alive && controller->command.flags & FLAG_ENABLE && !inputs->stop_pressed
        && !controller->is_tripped;
}

static void watch_current(controller_t *controller, const inputs_t *inputs)
{
    bool over = controller->most_ma && inputs->current_ma != NOT_MEASURED
        && inputs->current_ma > controller->most_ma;
    controller->overcurrent_ms =
        over ? (uint16_t)(controller->overcurrent_ms + CONTROL_PERIOD_MS) : 0;
    if (controller->overcurrent_ms > OVERCURRENT_MS)
        controller->is_tripped = true;
}

outputs_t control(controller_t *controller, encoder_t left, encoder_t right, const inputs_t *inputs,
                  uint32_t now_us)
{
    outputs_t outputs = {false, 0, 0};
    const command_t *command = &controller->command;
    is_silent(controller, now_us);
    if (command->boot) { /* without one, the turn of a wheel is not known */
        measure_wheel(&controller->left, left, now_us, command->ticks_per_turn);
        measure_wheel(&controller->right, right, now_us, command->ticks_per_turn);
    }
    watch_current(controller, inputs);
    if (has_torque(controller, inputs)) {
        outputs.left_duty = regulate_wheel(&controller->left, command->left_mradps, CONTROL_PERIOD_MS);
        outputs.right_duty = regulate_wheel(&controller->right, command->right_mradps, CONTROL_PERIOD_MS);
        if (is_disobedient(&controller->left) || is_disobedient(&controller->right))
            controller->is_tripped = true;
    }
    outputs.torque = has_torque(controller, inputs);
    if (!outputs.torque) {
        release_wheel(&controller->left);
        release_wheel(&controller->right);
        outputs.left_duty = outputs.right_duty = 0;
    }
    return outputs;
}

void report_state(controller_t *controller, encoder_t left, encoder_t right, const inputs_t *inputs,
                  uint32_t now_us, uint8_t *bytes)
{
    const command_t *command = &controller->command;
    unsigned bits = 0;
    bits |= has_torque(controller, inputs) ? BIT_ENABLED : 0;
    bits |= controller->is_alive ? 0 : BIT_TIMED_OUT;
    bits |= inputs->stop_pressed ? BIT_STOP_PRESSED : 0;
    bits |= inputs->bumper_front ? BIT_BUMPER_FRONT : 0;
    bits |= inputs->bumper_rear ? BIT_BUMPER_REAR : 0;
    bits |= inputs->cliff ? BIT_CLIFF : 0;
    bits |= controller->is_tripped ? BIT_TRIPPED : 0;
    const state_t state = {
        .seq = ++controller->state_seq,
        .boot = controller->boot,
        .echo_boot = command->boot,
        .echo_seq = command->seq,
        .time_us = now_us,
        .left_ticks = left.ticks,
        .right_ticks = right.ticks,
        .left_mradps = controller->left.mradps,
        .right_mradps = controller->right.mradps,
        .current_ma = inputs->current_ma,
        .battery_mv = inputs->battery_mv,
        .bits = (uint8_t)bits,
    };
    write_state(&state, bytes);
}
