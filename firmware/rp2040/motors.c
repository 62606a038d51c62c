/* Two motors behind an H-bridge each. Shorted they brake; that is also what the pull-ups of the wiring
 * do while the pins float in a reset. */
#include "../core/board.h"

#include "config.h"
#include "pins.h"
#include "registers.h"

#define TOP (CRYSTAL_HZ / 2 / PWM_HZ) /* counted up and down */
enum { ALWAYS = TOP + 1 };            /* a level above the top is high throughout */

static int32_t with_sense(int32_t duty, int sense)
{
    return sense > 0 ? duty : -duty;
}

static uint32_t share_of_top(int32_t duty)
{
    return TOP * (uint32_t)(duty < 0 ? -duty : duty) / FULL_DUTY;
}

static void begin_slice(uint32_t slice, uint32_t levels)
{
    REGISTER(PWM_LEVELS(slice)) = levels;
    REGISTER(PWM_TOP(slice)) = TOP;
    REGISTER(PWM_DIVIDER(slice)) = 1UL << 4;
    REGISTER(PWM_CSR(slice)) = 3;
}

static uint32_t levels_of(uint32_t a, uint32_t b)
{
    return b << 16 | a;
}

#if DRIVER == DRIVER_PWM_IN_IN

/* PWM left GP16, right GP17; inputs left GP18, GP19, right GP20, GP21. Both inputs high short the motor,
 * and so does a low PWM of a TB6612FNG. */
#define ALL (BIT(PIN_18) | BIT(PIN_19) | BIT(PIN_20) | BIT(PIN_21))

void brake_motors(void)
{
    REGISTER(SIO_OUT_SET) = ALL;
    for (uint32_t pin = PIN_18; pin <= PIN_21; pin++)
        begin_output(pin);
    begin_slice(0, levels_of(ALWAYS, ALWAYS));
    give_pin(PIN_16, FUNCTION_PWM);
    give_pin(PIN_17, FUNCTION_PWM);
}

void drive_motors(int16_t left_duty, int16_t right_duty)
{
    int32_t left = with_sense(left_duty, LEFT_MOTOR_SENSE);
    int32_t right = with_sense(right_duty, RIGHT_MOTOR_SENSE);
    uint32_t high = left > 0 ? BIT(PIN_18) : left < 0 ? BIT(PIN_19) : BIT(PIN_18) | BIT(PIN_19);
    high |= right > 0 ? BIT(PIN_20) : right < 0 ? BIT(PIN_21) : BIT(PIN_20) | BIT(PIN_21);
    REGISTER(SIO_OUT_SET) = high; /* first: between the two a motor is shorted, never the other way */
    REGISTER(SIO_OUT_CLEAR) = ALL & ~high;
    REGISTER(PWM_LEVELS(0)) =
        levels_of(left ? share_of_top(left) : ALWAYS, right ? share_of_top(right) : ALWAYS);
}

#elif DRIVER == DRIVER_IN_IN

/* Inputs left GP16, GP17, right GP18, GP19. One input stays high and the other is low for the duty's
 * share, so that the motor is shorted in between: it obeys evenly in both senses. */
static uint32_t levels_for(int32_t duty)
{
    uint32_t low = TOP - share_of_top(duty);
    return levels_of(duty < 0 ? low : ALWAYS, duty > 0 ? low : ALWAYS);
}

void brake_motors(void)
{
    begin_slice(0, levels_of(ALWAYS, ALWAYS));
    begin_slice(1, levels_of(ALWAYS, ALWAYS));
    for (uint32_t pin = PIN_16; pin <= PIN_19; pin++)
        give_pin(pin, FUNCTION_PWM);
}

void drive_motors(int16_t left_duty, int16_t right_duty)
{
    REGISTER(PWM_LEVELS(0)) = levels_for(with_sense(left_duty, LEFT_MOTOR_SENSE));
    REGISTER(PWM_LEVELS(1)) = levels_for(with_sense(right_duty, RIGHT_MOTOR_SENSE));
}

#else
#error "DRIVER: expected DRIVER_PWM_IN_IN or DRIVER_IN_IN"
#endif
