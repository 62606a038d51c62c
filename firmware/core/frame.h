/* Frames between the host and this controller: the twin of devices/pons_mcu.py, table in docs/drives.md.
 *
 * Little-endian: A5 5A | length of payload u8 | type u8 | seq u32 | payload | CRC-16/XMODEM over length
 * to payload, least significant byte first. */
#ifndef PONS_FRAME_H
#define PONS_FRAME_H

#include <stdbool.h>
#include <stdint.h>

enum {
    FRAME_COMMAND = 0x01,
    FRAME_STATE = 0x81,
    COMMAND_BYTES = 29,
    STATE_BYTES = 47,
};

enum { /* flags of a command */
    FLAG_ENABLE = 0x01,
};

enum { /* bits of a state */
    BIT_ENABLED = 0x01,
    BIT_TIMED_OUT = 0x02,
    BIT_STOP_PRESSED = 0x04,
    BIT_BUMPER_FRONT = 0x08,
    BIT_BUMPER_REAR = 0x10,
    BIT_CLIFF = 0x20,
    BIT_TRIPPED = 0x40,
};

#define NOT_MEASURED 0xFFFFu /* of current and battery */

typedef struct {
    uint32_t seq;
    uint32_t boot; /* the host's run; 0 is none */
    int32_t left_mradps, right_mradps;
    uint32_t ticks_per_turn; /* of a wheel, all edges counted */
    uint16_t ttl_ms;
    uint8_t flags;
} command_t;

typedef struct {
    uint32_t seq;
    uint32_t boot; /* this controller's run */
    uint32_t echo_boot, echo_seq; /* of the newest command that was accepted */
    uint32_t time_us;
    int32_t left_ticks, right_ticks;
    int32_t left_mradps, right_mradps;
    uint16_t current_ma, battery_mv;
    uint8_t bits;
} state_t;

/* Finds commands in a stream; holds at most one unfinished frame. Zeroed, it is ready. */
typedef struct {
    uint8_t bytes[COMMAND_BYTES];
    uint8_t count;
} reader_t;

uint16_t crc_xmodem(const uint8_t *bytes, uint8_t count);

/* Takes one byte; true when it completes a command whose checksum holds. */
bool read_byte(reader_t *reader, uint8_t byte, command_t *command);

/* Writes the STATE_BYTES of a state. */
void write_state(const state_t *state, uint8_t *bytes);

#endif
