#include "wheel.h"

/* Not enums: an int of the AVR has 16 bits. */
static const uint32_t STANDS_AFTER_US = 250000; /* without an edge: 0, whatever one tick would be */
static const int32_t MILLION = 1000000;
static const int32_t HIGH_DUTY = 400;
static const int32_t TURNS_MRADPS = 300; /* less may be play of the gear */

/* mrad in a turn x us in a second: ticks / (ticks a turn x us) of it is the speed in mrad/s. */
static const uint64_t MRAD_US = 6283185307ull;

void begin_wheel(wheel_t *wheel, const motor_t *motor, encoder_t now)
{
    wheel->motor = motor;
    wheel->last = now;
    wheel->mradps = 0;
    release_wheel(wheel);
}

static int32_t limit(int32_t value, int32_t most)
{
    return value > most ? most : value < -most ? -most : value;
}

static int32_t speed_mradps(int32_t ticks, uint32_t time_us, uint32_t ticks_per_turn)
{
    if (time_us == 0)
        time_us = 1;
    uint32_t count = ticks < 0 ? 0u - (uint32_t)ticks : (uint32_t)ticks;
    uint64_t speed = (uint64_t)count * (uint32_t)(MRAD_US / ticks_per_turn) / time_us;
    int32_t held = speed > INT32_MAX ? INT32_MAX : (int32_t)speed;
    return ticks < 0 ? -held : held;
}

void measure_wheel(wheel_t *wheel, encoder_t now, uint32_t now_us, uint32_t ticks_per_turn)
{
    int32_t ticks = (int32_t)((uint32_t)now.ticks - (uint32_t)wheel->last.ticks);
    if (ticks != 0) {
        uint32_t time_us = now.edge_us - wheel->last.edge_us;
        wheel->mradps = speed_mradps(ticks, time_us, ticks_per_turn);
        wheel->last = now;
        return;
    }
    uint32_t silent_us = now_us - wheel->last.edge_us;
    if (silent_us > STANDS_AFTER_US) {
        wheel->mradps = 0;
        wheel->last.edge_us = now_us - STANDS_AFTER_US; /* the clock begins anew after 71 min */
        return;
    }
    wheel->mradps = limit(wheel->mradps, speed_mradps(1, silent_us, ticks_per_turn));
}

static void watch_obedience(wheel_t *wheel, int32_t duty, uint16_t period_ms)
{
    bool high = duty >= HIGH_DUTY || duty <= -HIGH_DUTY;
    int32_t along = duty < 0 ? -wheel->mradps : wheel->mradps;
    if (!high || along >= TURNS_MRADPS)
        wheel->disobeyed_ms = 0;
    else if (wheel->disobeyed_ms <= wheel->motor->trip_ms)
        wheel->disobeyed_ms = (uint16_t)(wheel->disobeyed_ms + period_ms);
}

static int32_t integral_duty(const wheel_t *wheel)
{
    return wheel->integral * (int32_t)wheel->motor->ki / MILLION;
}

int16_t regulate_wheel(wheel_t *wheel, int32_t target_mradps, uint16_t period_ms)
{
    const motor_t *motor = wheel->motor;
    int32_t fastest = (int32_t)motor->free_radps * 1000;
    int32_t target = limit(target_mradps, fastest);
    int32_t error = limit(target - wheel->mradps, fastest);

    int32_t forward = target / motor->free_radps; /* mrad/s over rad/s: per mille */
    if (target > 0)
        forward += motor->start_duty;
    else if (target < 0)
        forward -= motor->start_duty;
    int32_t proportional = error * (int32_t)motor->kp / 1000;
    int32_t most = motor->ki ? (int32_t)FULL_DUTY * MILLION / motor->ki : 0;
    int32_t step = error * period_ms;
    int32_t raw = forward + proportional + integral_duty(wheel);

    /* At its end the duty grows no further, so the integral may only shrink. */
    if (!(raw >= FULL_DUTY && step > 0) && !(raw <= -FULL_DUTY && step < 0))
        wheel->integral = limit(wheel->integral + step, most);
    if (target == 0 && wheel->mradps == 0)
        wheel->integral -= wheel->integral / 16; /* a wheel that stands is not pushed for ever */

    int32_t duty = limit(forward + proportional + integral_duty(wheel), FULL_DUTY);
    watch_obedience(wheel, duty, period_ms);
    wheel->duty = (int16_t)duty;
    return wheel->duty;
}

void release_wheel(wheel_t *wheel)
{
    wheel->integral = 0;
    wheel->disobeyed_ms = 0;
    wheel->duty = 0;
}

bool is_disobedient(const wheel_t *wheel)
{
    return wheel->disobeyed_ms > wheel->motor->trip_ms;
}
