/* The line to the host: two rings between the UART's interrupts and the loop. */
#include <avr/interrupt.h>
#include <avr/io.h>

#include "../core/board.h"
#include "config.h"

#define BAUD_TOL 3 /* 115200 from 16 MHz is 2.1 % fast, as every Arduino is */
#include <util/setbaud.h>

enum { RING = 128, MASK = RING - 1 };

static volatile uint8_t heard[RING], heard_head, heard_tail;
static volatile uint8_t said[RING], said_head, said_tail;

void begin_serial(void)
{
    UBRR0 = UBRR_VALUE;
    UCSR0A = USE_2X ? _BV(U2X0) : 0;
    UCSR0C = _BV(UCSZ01) | _BV(UCSZ00);
    UCSR0B = _BV(RXEN0) | _BV(TXEN0) | _BV(RXCIE0);
}

/* A spoilt byte is kept: the frame's checksum judges. One that finds no room is lost. */
ISR(USART_RX_vect)
{
    uint8_t byte = UDR0, next = (heard_head + 1) & MASK;
    if (next == heard_tail)
        return;
    heard[heard_head] = byte;
    heard_head = next;
}

ISR(USART_UDRE_vect)
{
    if (said_tail == said_head) {
        UCSR0B &= (uint8_t)~_BV(UDRIE0);
        return;
    }
    UDR0 = said[said_tail];
    said_tail = (said_tail + 1) & MASK;
}

bool read_serial(uint8_t *byte)
{
    if (heard_tail == heard_head)
        return false;
    *byte = heard[heard_tail];
    heard_tail = (heard_tail + 1) & MASK;
    return true;
}

bool write_serial(const uint8_t *bytes, uint8_t count)
{
    uint8_t room = (uint8_t)(said_tail - said_head - 1) & MASK;
    if (room < count)
        return false;
    uint8_t head = said_head;
    while (count--) {
        said[head] = *bytes++;
        head = (head + 1) & MASK;
    }
    said_head = head;
    UCSR0B |= _BV(UDRIE0);
    return true;
}
