/* The firmware's loop, the same on each chip. Nothing in it waits; what hangs is reset by the watchdog
 * within 60 ms, and the pull-ups brake meanwhile. */
#ifndef PONS_LOOP_H
#define PONS_LOOP_H

#include "board.h"

/* Never returns. */
void run_loop(const motor_t *motor, uint16_t most_ma);

#endif
