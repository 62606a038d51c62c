/* What runs before main: code and data go from flash to memory, where no read waits for flash. */
#include <stdint.h>

#include "../core/loop.h"
#include "config.h"
#include "registers.h"

static const motor_t MOTOR = {FREE_RADPS, START_DUTY, KP, KI, TRIP_MS};

extern uint32_t image_in_flash[], image_begin[], image_end[], zeroes_begin[], zeroes_end[], stack_top[];

void start(void);
void count_edges(void);
void serve_serial(void);

/* Nothing may come here. The watchdog, which nobody feeds now, resets the chip. */
static void hang(void)
{
    for (;;)
        ;
}

typedef void (*handler_t)(void);

/* In memory, after the copy. The first 16 are the processor's own. */
static const handler_t VECTORS[48] __attribute__((used, aligned(256))) = {
    (handler_t)(uintptr_t)stack_top,
    start,
    hang, hang, hang, hang, hang, hang, hang, hang, hang, hang, hang, hang, hang, hang,
    hang, hang, hang, hang, hang, hang, hang, hang, hang, hang, hang, hang, hang,
    [16 + IRQ_GPIO] = count_edges,
    hang, hang, hang, hang, hang, hang,
    [16 + IRQ_UART0] = serve_serial,
    hang, hang, hang, hang, hang, hang, hang, hang, hang, hang, hang,
};

/* What boot2 reads: where the stack begins, and the start. */
static const handler_t FIRST[2] __attribute__((used, section(".first"))) = {
    (handler_t)(uintptr_t)stack_top,
    start,
};

/* Runs from flash: it may call nothing that lies in memory before the copy. */
void __attribute__((section(".start"), noreturn, optimize("no-tree-loop-distribute-patterns")))
start(void)
{
    __asm volatile("cpsid i");
    for (uint32_t *from = image_in_flash, *to = image_begin; to < image_end;)
        *to++ = *from++;
    for (uint32_t *to = zeroes_begin; to < zeroes_end;)
        *to++ = 0;
    REGISTER(0xe000ed08UL) = (uint32_t)(uintptr_t)VECTORS;
    run_loop(&MOTOR, MOST_MA);
    for (;;)
        ;
}
