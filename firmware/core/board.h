/* What a chip must give: clock, pins, encoders, motors, watchdog, and the line to the host. One folder
 * beside this one a chip. */
#ifndef PONS_BOARD_H
#define PONS_BOARD_H

#include "controller.h"

/* Sets the pins up, motors braked first of all, and starts clock and encoders. */
void begin_board(void);

/* Microseconds since the start, in steps of 4 at most; begins anew after 71 minutes. */
uint32_t clock_us(void);

/* Returns a number that no recent run had. */
uint32_t draw_boot(void);

encoder_t read_left_encoder(void);
encoder_t read_right_encoder(void);

/* Reads the contacts, and of the analogue inputs what the last call began to convert. */
void read_inputs(inputs_t *inputs);

/* Drives both motors, signed per mille. */
void drive_motors(int16_t left_duty, int16_t right_duty);

/* Shorts both motors. */
void brake_motors(void);

/* Shows whether the motors have torque. */
void show_torque(bool torque);

/* From now on the chip resets itself within 60 ms unless it is fed; then lets interrupts in. */
void begin_watchdog(void);
void feed_watchdog(void);

void begin_serial(void);

/* Takes one byte that came; false where there is none. */
bool read_serial(uint8_t *byte);

/* Queues bytes for the host, all or none: half a frame would be noise. */
bool write_serial(const uint8_t *bytes, uint8_t count);

#endif
