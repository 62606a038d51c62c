/* One wheel: its speed from the encoder's edges, and the duty that keeps it at the speed asked for. */
#ifndef PONS_WHEEL_H
#define PONS_WHEEL_H

#include <stdbool.h>
#include <stdint.h>

enum { FULL_DUTY = 1000 }; /* duties are per mille of the supply, signed */

/* What the encoder's interrupt has counted, read in one piece. */
typedef struct {
    int32_t ticks;    /* wraps */
    uint32_t edge_us; /* when the newest edge came */
} encoder_t;

/* What the motor and its gear are like; config.h of the board says it. */
typedef struct {
    uint16_t free_radps;     /* of the wheel at full duty, unloaded: the feed-forward */
    uint16_t start_duty;     /* below it the wheel does not begin to turn */
    uint16_t kp, ki;         /* duty per rad/s, and per rad */
    uint16_t trip_ms;        /* so long may a wheel disobey at high duty */
} motor_t;

typedef struct {
    const motor_t *motor;
    encoder_t last;
    int32_t mradps;       /* measured */
    int32_t integral;     /* of the error: mrad/s x ms, so that none is too small to count */
    uint16_t disobeyed_ms;
    int16_t duty;
} wheel_t;

void begin_wheel(wheel_t *wheel, const motor_t *motor, encoder_t now);

/* Measures the speed from the newest edges: whole ticks over the time between the edges that bound
 * them (the M/T method), so that few ticks a period give no steps. Without an edge the speed is at
 * most one tick over the time since the last. */
void measure_wheel(wheel_t *wheel, encoder_t now, uint32_t now_us, uint32_t ticks_per_turn);

/* Returns the duty towards a speed; call it every period_ms. */
int16_t regulate_wheel(wheel_t *wheel, int32_t target_mradps, uint16_t period_ms);

/* Forgets the past of the regulation: the wheel has no torque. */
void release_wheel(wheel_t *wheel);

/* True when the wheel stood still or turned the wrong way under high duty for too long: an encoder
 * that is unplugged or reversed, a motor that is blocked or wired the other way round. Without this a
 * regulator turns either into full speed. */
bool is_disobedient(const wheel_t *wheel);

#endif
