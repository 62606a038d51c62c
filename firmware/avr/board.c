#include "../core/board.h"

#include <avr/eeprom.h>
#include <avr/interrupt.h>
#include <avr/io.h>
#include <util/atomic.h>

#include "config.h"

enum {
    US_PER_COUNT = 4, /* Timer0 at F_CPU / 64 */
    ADC_BATTERY = 6,
    ADC_CURRENT = 7,
    ADC_FULL = 1023,
};

#if F_CPU != 16000000UL
#error "Timer0 counts 4 us only at 16 MHz"
#endif

static volatile uint32_t overflows;
static volatile encoder_t left_encoder, right_encoder;
static volatile uint8_t last_phases;

ISR(TIMER0_OVF_vect)
{
    overflows++;
}

/* Only with interrupts off. */
static uint32_t clock_us_undisturbed(void)
{
    uint8_t count = TCNT0;
    uint32_t turns = overflows;
    if ((TIFR0 & _BV(TOV0)) && count < 128) /* overflowed, and not yet counted */
        turns++;
    return (turns << 8 | count) * US_PER_COUNT;
}

uint32_t clock_us(void)
{
    uint32_t now_us;
    ATOMIC_BLOCK(ATOMIC_RESTORESTATE)
    {
        now_us = clock_us_undisturbed();
    }
    return now_us;
}

/* By the phases before and now, two bits each. Two edges at once are one that was missed: which way is
 * unknown, so it counts nothing. */
static const int8_t STEPS[16] = {0, 1, -1, 0, -1, 0, 0, 1, 1, 0, 0, -1, 0, -1, 1, 0};

static void count_edge(volatile encoder_t *encoder, uint8_t before, uint8_t now, int8_t sense,
                       uint32_t now_us)
{
    int8_t step = STEPS[(uint8_t)(before << 2 | now)];
    if (step == 0)
        return;
    encoder->ticks += sense > 0 ? step : -step;
    encoder->edge_us = now_us;
}

ISR(PCINT1_vect)
{
    uint8_t phases = PINC & 0x0F;
    uint32_t now_us = clock_us_undisturbed();
    count_edge(&left_encoder, last_phases & 3, phases & 3, LEFT_ENCODER_SENSE, now_us);
    count_edge(&right_encoder, last_phases >> 2, phases >> 2, RIGHT_ENCODER_SENSE, now_us);
    last_phases = phases;
}

static encoder_t read_encoder(const volatile encoder_t *encoder)
{
    encoder_t whole;
    ATOMIC_BLOCK(ATOMIC_RESTORESTATE)
    {
        whole = *encoder;
    }
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

void begin_board(void)
{
    brake_motors();
    PORTB |= _BV(PB0) | _BV(PB4); /* pull-ups: stop input, rear bumper */
    PORTD |= _BV(PD2);            /* front bumper */
    PORTC |= 0x0F | _BV(PC4);     /* encoders with open collectors, cliff */
    DDRB |= _BV(PB5);             /* light: torque */

    TCCR0A = 0;
    TCCR0B = _BV(CS01) | _BV(CS00);
    TIMSK0 = _BV(TOIE0);

    last_phases = PINC & 0x0F;
    PCMSK1 = 0x0F;
    PCICR = _BV(PCIE1);

    ADCSRA = _BV(ADEN) | _BV(ADPS2) | _BV(ADPS1) | _BV(ADPS0);
    ADMUX = _BV(REFS0) | ADC_BATTERY;
}

static uint32_t EEMEM starts;

uint32_t draw_boot(void)
{
    uint32_t number = eeprom_read_dword(&starts) + 1;
    eeprom_update_dword(&starts, number); /* in most starts one byte, which bears 100 000 writes */
    number ^= number >> 16; /* one to one, so that the next start has another number: spread, so that */
    number *= 0x45D9F3BUL;  /* two boards seldom have the same */
    return number ^ number >> 16;
}

static uint16_t scale(uint16_t reading, uint32_t full_scale)
{
    uint32_t value = reading * full_scale / ADC_FULL;
    return value < NOT_MEASURED ? (uint16_t)value : NOT_MEASURED - 1;
}

void read_inputs(inputs_t *inputs)
{
    inputs->stop_pressed = PINB & _BV(PB0);
    inputs->bumper_front = HAS_BUMPER_FRONT && !(PIND & _BV(PD2));
    inputs->bumper_rear = HAS_BUMPER_REAR && !(PINB & _BV(PB4));
    inputs->cliff = HAS_CLIFF && !(PINC & _BV(PC4));

    if (ADCSRA & _BV(ADSC)) /* never waited for */
        return;
    if ((ADMUX & 0x0F) == ADC_BATTERY) {
        inputs->battery_mv = BATTERY_FULL_SCALE_MV ? scale(ADC, BATTERY_FULL_SCALE_MV) : NOT_MEASURED;
        ADMUX = _BV(REFS0) | ADC_CURRENT;
    } else {
        inputs->current_ma = CURRENT_FULL_SCALE_MA ? scale(ADC, CURRENT_FULL_SCALE_MA) : NOT_MEASURED;
        ADMUX = _BV(REFS0) | ADC_BATTERY;
    }
    ADCSRA |= _BV(ADSC);
}
