#include "../core/board.h"

#include "config.h"
#include "pins.h"
#include "registers.h"

static volatile encoder_t left_encoder, right_encoder;
static uint32_t last_phases;

uint32_t clock_us(void)
{
    return REGISTER(TIMER_RAW_LOW);
}

void give_pin(uint32_t pin, uint32_t function)
{
    REGISTER(GPIO_CTRL(pin)) = function;
}

void begin_output(uint32_t pin)
{
    REGISTER(PAD(pin)) = PAD_INPUT | PAD_SCHMITT | PAD_4_MA;
    REGISTER(SIO_OUTPUTS_SET) = BIT(pin);
    give_pin(pin, FUNCTION_SIO);
}

void begin_input(uint32_t pin)
{
    REGISTER(PAD(pin)) = PAD_INPUT | PAD_SCHMITT | PAD_PULL_UP;
    give_pin(pin, FUNCTION_SIO);
}

/* By the phases before and now, two bits each. Two edges at once are one that was missed: which way is
 * unknown, so it counts nothing. */
static const int8_t STEPS[16] = {0, 1, -1, 0, -1, 0, 0, 1, 1, 0, 0, -1, 0, -1, 1, 0};

static void count_edge(volatile encoder_t *encoder, uint32_t before, uint32_t now, int sense,
                       uint32_t now_us)
{
    int8_t step = STEPS[(before << 2 | now) & 15];
    if (step == 0)
        return;
    encoder->ticks += sense > 0 ? step : -step;
    encoder->edge_us = now_us;
}

static uint32_t read_phases(void)
{
    return REGISTER(SIO_IN) >> PIN_LEFT_A & 15;
}

/* Both edges of the four phases, which are the low half of their register. */
void count_edges(void)
{
    REGISTER(GPIO_EDGES(PIN_LEFT_A)) = 0x0000ccccUL; /* forgotten before they are read: none is lost */
    uint32_t phases = read_phases(), now_us = clock_us();
    count_edge(&left_encoder, last_phases & 3, phases & 3, LEFT_ENCODER_SENSE, now_us);
    count_edge(&right_encoder, last_phases >> 2, phases >> 2, RIGHT_ENCODER_SENSE, now_us);
    last_phases = phases;
}

static encoder_t read_encoder(const volatile encoder_t *encoder)
{
    uint32_t masked;
    __asm volatile("mrs %0, primask\n cpsid i" : "=r"(masked)::"memory");
    encoder_t whole = {encoder->ticks, encoder->edge_us};
    __asm volatile("msr primask, %0" ::"r"(masked) : "memory");
    return whole;
}

encoder_t read_left_encoder(void)
{
    return read_encoder(&left_encoder);
}

encoder_t read_right_encoder(void)
{
    return read_encoder(&right_encoder);
}

/* Everything from the crystal of 12 MHz: no PLL has to lock, and it is more than the work needs. */
static void begin_clocks(void)
{
    REGISTER(XOSC_STARTUP) = CRYSTAL_HZ / 1000 / 256 + 1;
    REGISTER(XOSC_CTRL) = 0xfabUL << 12 | 0xaa0;
    while (!(REGISTER(XOSC_STATUS) & 1UL << 31))
        ;
    REGISTER(CLK_REF_CTRL) = 2;
    while (!(REGISTER(CLK_REF_SELECTED) & 1UL << 2))
        ;
    CLEAR_BITS(CLK_SYS_CTRL) = 1;
    while (!(REGISTER(CLK_SYS_SELECTED) & 1UL))
        ;
    REGISTER(CLK_PERI_CTRL) = 1UL << 11;
    REGISTER(WATCHDOG_TICK) = 1UL << 9 | CRYSTAL_HZ / 1000000; /* the timer's microsecond, too */
}

enum { HAS_ANALOGUE = BATTERY_FULL_SCALE_MV || CURRENT_FULL_SCALE_MA, ANALOGUE_FULL = 4095 };

_Static_assert(!MOST_MA || CURRENT_FULL_SCALE_MA, "MOST_MA watches a current that isn't measured");

static uint32_t converted_pin; /* what the converter was last begun on; 0: nothing yet */

static void begin_conversion(uint32_t pin)
{
    converted_pin = pin;
    REGISTER(ADC_CONTROL) = ADC_ON | ADC_START | (pin - PIN_BATTERY) << 12;
}

/* By the crystal, as all else: a conversion takes 8 us and not 2. Not begun where nothing is fitted. */
static void begin_analogue(void)
{
    REGISTER(CLK_ADC_CTRL) = 1UL << 11 | 3UL << 5;
    CLEAR_BITS(RESETS_RESET) = RESET_ADC;
    while (!(REGISTER(RESETS_DONE) & RESET_ADC))
        ;
    REGISTER(PAD(PIN_BATTERY)) = REGISTER(PAD(PIN_CURRENT)) = PAD_NO_OUTPUT; /* no pull bends a divider */
    REGISTER(ADC_CONTROL) = ADC_ON; /* the first of read_inputs finds it ready, or a later one does */
}

static uint16_t scale(uint32_t reading, uint32_t full_scale)
{
    uint32_t value = reading * full_scale / ANALOGUE_FULL;
    return value < NOT_MEASURED ? (uint16_t)value : NOT_MEASURED - 1;
}

/* Battery and current by turns. A conversion that failed leaves what was read before. */
static void read_analogue(inputs_t *inputs)
{
    uint32_t control = REGISTER(ADC_CONTROL);
    if (!(control & ADC_READY)) /* never waited for */
        return;
    uint32_t reading = REGISTER(ADC_RESULT);
    bool has_reading = converted_pin && !(control & ADC_FAILED);
    if (has_reading && converted_pin == PIN_BATTERY && BATTERY_FULL_SCALE_MV)
        inputs->battery_mv = scale(reading, BATTERY_FULL_SCALE_MV);
    if (has_reading && converted_pin == PIN_CURRENT && CURRENT_FULL_SCALE_MA)
        inputs->current_ma = scale(reading, CURRENT_FULL_SCALE_MA);
    begin_conversion(converted_pin == PIN_BATTERY ? PIN_CURRENT : PIN_BATTERY);
}

void begin_board(void)
{
    uint32_t wanted = RESET_IO | RESET_PADS | RESET_PWM | RESET_TIMER | RESET_UART0;
    CLEAR_BITS(RESETS_RESET) = RESET_IO | RESET_PADS;
    while ((REGISTER(RESETS_DONE) & (RESET_IO | RESET_PADS)) != (RESET_IO | RESET_PADS))
        ;
    begin_clocks();
    CLEAR_BITS(RESETS_RESET) = wanted;
    while ((REGISTER(RESETS_DONE) & wanted) != wanted)
        ;
    brake_motors();
    for (uint32_t pin = PIN_STOP; pin <= PIN_CLIFF; pin++)
        begin_input(pin);
    for (uint32_t pin = PIN_LEFT_A; pin <= PIN_RIGHT_B; pin++)
        begin_input(pin);
    begin_output(PIN_LIGHT);
    if (HAS_ANALOGUE)
        begin_analogue();
    last_phases = read_phases();
    REGISTER(GPIO_EDGES(PIN_LEFT_A)) = 0x0000ccccUL;
    REGISTER(GPIO_ENABLES(PIN_LEFT_A)) = 0x0000ccccUL;
    REGISTER(NVIC_ENABLE) = BIT(IRQ_GPIO);
}

/* There is no memory that counts starts: 32 pairs of bits of the ring oscillator that differ, which
 * takes the bias out of them. A stuck one ends it all the same, by the clock. */
uint32_t draw_boot(void)
{
    uint32_t number = clock_us(), drawn = 0;
    for (uint32_t tries = 0; drawn < 32 && tries < 4096; tries++) {
        uint32_t first = REGISTER(ROSC_RANDOMBIT) & 1;
        for (volatile uint32_t pause = 0; pause < 5; pause++)
            ;
        if (first == (REGISTER(ROSC_RANDOMBIT) & 1))
            continue;
        number = number << 1 ^ first;
        drawn++;
    }
    return number ? number : 1;
}

void read_inputs(inputs_t *inputs)
{
    uint32_t pins = REGISTER(SIO_IN);
    inputs->stop_pressed = pins & BIT(PIN_STOP);
    inputs->bumper_front = HAS_BUMPER_FRONT && !(pins & BIT(PIN_BUMPER_FRONT));
    inputs->bumper_rear = HAS_BUMPER_REAR && !(pins & BIT(PIN_BUMPER_REAR));
    inputs->cliff = HAS_CLIFF && !(pins & BIT(PIN_CLIFF));
    if (HAS_ANALOGUE)
        read_analogue(inputs);
}

void show_torque(bool torque)
{
    REGISTER(torque ? SIO_OUT_SET : SIO_OUT_CLEAR) = BIT(PIN_LIGHT);
}

enum { WATCHDOG_COUNTS = 2 * 60000 }; /* it counts each microsecond twice (erratum RP2040-E1) */

void feed_watchdog(void)
{
    REGISTER(WATCHDOG_LOAD) = WATCHDOG_COUNTS;
}

void begin_watchdog(void)
{
    CLEAR_BITS(WATCHDOG_CTRL) = 1UL << 30;
    REGISTER(PSM_WDSEL) = 0x0001fffcUL; /* all but the two oscillators: pins float, as in a reset */
    CLEAR_BITS(WATCHDOG_CTRL) = 7UL << 24; /* a debugger does not hold it up */
    feed_watchdog();
    SET_BITS(WATCHDOG_CTRL) = 1UL << 30;
    __asm volatile("cpsie i" ::: "memory");
}
