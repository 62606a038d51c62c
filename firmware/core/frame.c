#include "frame.h"

#include <string.h>

enum {
    HEAD_0 = 0xA5,
    HEAD_1 = 0x5A,
    AT_LENGTH = 2,
    AT_TYPE = 3,
    AT_SEQ = 4,
    AT_PAYLOAD = 8,
    CRC_BYTES = 2,
};

uint16_t crc_xmodem(const uint8_t *bytes, uint8_t count)
{
    uint16_t crc = 0;
    while (count--) {
        crc ^= (uint16_t)((uint16_t)*bytes++ << 8);
        for (uint8_t bit = 0; bit < 8; bit++)
            crc = (crc & 0x8000u) ? (uint16_t)((crc << 1) ^ 0x1021u) : (uint16_t)(crc << 1);
    }
    return crc;
}

static uint16_t get_u16(const uint8_t *at)
{
    return (uint16_t)(at[0] | (uint16_t)at[1] << 8);
}

static uint32_t get_u32(const uint8_t *at)
{
    return get_u16(at) | (uint32_t)get_u16(at + 2) << 16;
}

static uint8_t *put_u16(uint8_t *at, uint16_t value)
{
    at[0] = (uint8_t)value;
    at[1] = (uint8_t)(value >> 8);
    return at + 2;
}

static uint8_t *put_u32(uint8_t *at, uint32_t value)
{
    return put_u16(put_u16(at, (uint16_t)value), (uint16_t)(value >> 16));
}

/* True while the bytes held may still become a command. */
static bool may_be_command(const reader_t *reader)
{
    static const uint8_t begin[] = {
        HEAD_0, HEAD_1, COMMAND_BYTES - AT_PAYLOAD - CRC_BYTES, FRAME_COMMAND};
    uint8_t known = reader->count < sizeof begin ? reader->count : sizeof begin;
    return memcmp(reader->bytes, begin, known) == 0;
}

/* Drops bytes in front until what is left may be a command: a true frame may begin within what only
 * looked like one. */
static void resynchronise(reader_t *reader)
{
    do {
        reader->count--;
        memmove(reader->bytes, reader->bytes + 1, reader->count);
    } while (reader->count > 0 && !may_be_command(reader));
}

bool read_byte(reader_t *reader, uint8_t byte, command_t *command)
{
    reader->bytes[reader->count++] = byte;
    if (!may_be_command(reader)) {
        resynchronise(reader);
        return false;
    }
    if (reader->count < COMMAND_BYTES)
        return false;
    const uint8_t *bytes = reader->bytes;
    uint16_t crc = crc_xmodem(bytes + AT_LENGTH, COMMAND_BYTES - AT_LENGTH - CRC_BYTES);
    if (crc != get_u16(bytes + COMMAND_BYTES - CRC_BYTES)) {
        resynchronise(reader);
        return false;
    }
    command->seq = get_u32(bytes + AT_SEQ);
    command->boot = get_u32(bytes + AT_PAYLOAD);
    command->left_mradps = (int32_t)get_u32(bytes + AT_PAYLOAD + 4);
    command->right_mradps = (int32_t)get_u32(bytes + AT_PAYLOAD + 8);
    command->ticks_per_turn = get_u32(bytes + AT_PAYLOAD + 12);
    command->ttl_ms = get_u16(bytes + AT_PAYLOAD + 16);
    command->flags = bytes[AT_PAYLOAD + 18];
    reader->count = 0;
    return true;
}

void write_state(const state_t *state, uint8_t *bytes)
{
    uint8_t *at = bytes;
    *at++ = HEAD_0;
    *at++ = HEAD_1;
    *at++ = STATE_BYTES - AT_PAYLOAD - CRC_BYTES;
    *at++ = FRAME_STATE;
    at = put_u32(at, state->seq);
    at = put_u32(at, state->boot);
    at = put_u32(at, state->echo_boot);
    at = put_u32(at, state->echo_seq);
    at = put_u32(at, state->time_us);
    at = put_u32(at, (uint32_t)state->left_ticks);
    at = put_u32(at, (uint32_t)state->right_ticks);
    at = put_u32(at, (uint32_t)state->left_mradps);
    at = put_u32(at, (uint32_t)state->right_mradps);
    at = put_u16(at, state->current_ma);
    at = put_u16(at, state->battery_mv);
    *at++ = state->bits;
    put_u16(at, crc_xmodem(bytes + AT_LENGTH, STATE_BYTES - AT_LENGTH - CRC_BYTES));
}
