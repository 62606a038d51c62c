/* What stands between a host's commands and two wheels: who is obeyed, for how long, and when not.
 *
 * Pure: it is told the time, the bytes, the encoders and the inputs, and says what the motors are to
 * do. sim/twin/pons_mcu.py is the same in Python; the tests hold the two against each other. */
#ifndef PONS_CONTROLLER_H
#define PONS_CONTROLLER_H

#include "frame.h"
#include "wheel.h"

enum {
    TTL_MIN_MS = 50,
    TTL_MAX_MS = 500,
    CONTROL_PERIOD_MS = 5,
    STATE_PERIOD_MS = 10,
};

/* What the board's pins say. What is not fitted reads false. */
typedef struct {
    bool stop_pressed, bumper_front, bumper_rear, cliff;
    uint16_t current_ma, battery_mv;
} inputs_t;

/* What the board is to do. Without torque the motors are shorted: they brake. */
typedef struct {
    bool torque;
    int16_t left_duty, right_duty; /* per mille, signed */
} outputs_t;

typedef struct {
    uint32_t boot;
    uint32_t state_seq;
    reader_t reader;
    command_t command;  /* the newest that was accepted; boot 0: none */
    uint32_t heard_us;
    bool is_alive;      /* the command's time has not run out */
    bool is_tripped;    /* a wheel disobeyed or too much current flowed */
    uint16_t overcurrent_ms;
    uint16_t most_ma;   /* 0: current isn't measured */
    wheel_t left, right;
} controller_t;

/* Begins without a command: no torque until one is accepted. boot tells this run from the last. */
void begin_controller(controller_t *controller, uint32_t boot, const motor_t *motor, uint16_t most_ma,
                      encoder_t left, encoder_t right);

/* Takes one byte from the host. */
void hear_byte(controller_t *controller, uint8_t byte, uint32_t now_us);

/* Ends a command whose time is over. Call it at least once a millisecond; true when there is no torque
 * to be had, so that the caller can take it away at once and not at the next period. */
bool is_silent(controller_t *controller, uint32_t now_us);

/* Measures and regulates; call it every CONTROL_PERIOD_MS. */
outputs_t control(controller_t *controller, encoder_t left, encoder_t right, const inputs_t *inputs,
                  uint32_t now_us);

/* Writes the STATE_BYTES that the host is due; call it every STATE_PERIOD_MS. */
void report_state(controller_t *controller, encoder_t left, encoder_t right, const inputs_t *inputs,
                  uint32_t now_us, uint8_t *bytes);

#endif
