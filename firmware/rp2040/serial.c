/* The line to the host: two rings between the UART's interrupts and the loop. */
#include "../core/board.h"

#include "config.h"
#include "pins.h"
#include "registers.h"

enum { RING = 256, MASK = RING - 1 };

static volatile uint8_t heard[RING], said[RING];
static volatile uint32_t heard_head, heard_tail, said_head, said_tail;

void begin_serial(void)
{
    uint32_t sixtyfourths = (CRYSTAL_HZ * 4 + BAUD / 2) / BAUD;
    REGISTER(UART_WHOLE_DIVIDER) = sixtyfourths >> 6;
    REGISTER(UART_PART_DIVIDER) = sixtyfourths & 63;
    REGISTER(UART_LINE) = UART_8_BITS | UART_QUEUES; /* takes the dividers over */
    REGISTER(UART_CONTROL) = UART_ON | UART_SENDS | UART_HEARS;
    begin_input(PIN_RX);
    give_pin(PIN_RX, FUNCTION_UART);
    give_pin(PIN_TX, FUNCTION_UART);
    REGISTER(UART_INTERRUPTS) = UART_HEARD | UART_HEARD_AND_IDLE;
    REGISTER(NVIC_ENABLE) = BIT(IRQ_UART0);
}

static void send_what_fits(void)
{
    while (said_tail != said_head && !(REGISTER(UART_FLAGS) & UART_SENDER_FULL)) {
        REGISTER(UART_DATA) = said[said_tail];
        said_tail = (said_tail + 1) & MASK;
    }
    if (said_tail == said_head)
        CLEAR_BITS(UART_INTERRUPTS) = UART_HAS_ROOM;
    else
        SET_BITS(UART_INTERRUPTS) = UART_HAS_ROOM;
}

/* A spoilt byte is kept: the frame's checksum judges. One that finds no room is lost. */
void serve_serial(void)
{
    while (!(REGISTER(UART_FLAGS) & UART_NOTHING_HEARD)) {
        uint8_t byte = (uint8_t)REGISTER(UART_DATA);
        uint32_t next = (heard_head + 1) & MASK;
        if (next == heard_tail)
            continue;
        heard[heard_head] = byte;
        heard_head = next;
    }
    send_what_fits();
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
    if (((said_tail - said_head - 1) & MASK) < count)
        return false;
    uint32_t head = said_head;
    while (count--) {
        said[head] = *bytes++;
        head = (head + 1) & MASK;
    }
    said_head = head;
    __asm volatile("cpsid i" ::: "memory");
    send_what_fits(); /* its interrupt comes when the queue empties, not when it is empty */
    __asm volatile("cpsie i" ::: "memory");
    return true;
}
