/* A board with the firmware's own bytes on it: an ATmega328P in simavr, a TB6612FNG, two encoders.
 *
 * Usage: board FIRMWARE.elf. In turns, on its standard input and output, little-endian:
 *   in:  run_us u32 | left, right i32, edges a second x 1000 | battery_mv u16, at the pin | inputs u8
 *        (1 stop pressed) | faults u8 (1 reset, 2 the clock stands) | count u16 | bytes to the UART
 *   out: left, right duty i16, per mille | left, right bridge u8 (0 coasts, 1 drives, 2 brakes) |
 *        count u16 | bytes from the UART
 * Time is the processor's own: what comes out is the same on every computer. */
#define _POSIX_C_SOURCE 200809L
#include <sim_avr.h>
#include <sim_elf.h>
#include <sim_io.h>
#include <avr_adc.h>
#include <avr_ioport.h>
#include <avr_uart.h>

#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { HZ = 16000000, MOST_BYTES = 4096 };
enum { PINB_DDR = 0x24, PINB_PORT = 0x25, PIND_DDR = 0x2A, PIND_PORT = 0x2B };
enum { REG_TCCR0B = 0x45, REG_TCCR1A = 0x80, REG_ICR1 = 0x86, REG_OCR1A = 0x88, REG_OCR1B = 0x8A };
enum { COASTS, DRIVES, BRAKES };
enum { INPUT_STOP = 1 };
enum { FAULT_RESET = 1, FAULT_CLOCK = 2 };

#pragma pack(push, 1)
struct request {
    uint32_t run_us;
    int32_t left_medges, right_medges;
    uint16_t battery_mv;
    uint8_t inputs, faults;
    uint16_t count;
};
struct reply {
    int16_t left_duty, right_duty;
    uint8_t left_bridge, right_bridge;
    uint16_t count;
};
#pragma pack(pop)

struct encoder {
    uint8_t pin_a, pin_b, phase;
    double turned; /* edges, with their fraction */
    int64_t edges;
};

static avr_t *avr;
static uint8_t said[MOST_BYTES], waiting[MOST_BYTES];
static unsigned said_count, waiting_count, waiting_at;
static bool has_room = true;
static struct encoder left = {0, 1, 0, 0.0, 0}, right = {2, 3, 0, 0.0, 0};

static void on_said(struct avr_irq_t *irq, uint32_t value, void *param)
{
    (void)irq;
    (void)param;
    if (said_count < MOST_BYTES)
        said[said_count++] = (uint8_t)value;
}

static void on_room(struct avr_irq_t *irq, uint32_t value, void *param)
{
    (void)irq;
    (void)value;
    has_room = param != NULL;
}

/* Both: the level now, and what the port is to read again after each write to it, which else would
 * show its pull-up. */
static void set_pin(char port, int pin, int level)
{
    static uint8_t masks[128], values[128];
    masks[(int)port] |= (uint8_t)(1 << pin);
    values[(int)port] = (uint8_t)((values[(int)port] & ~(1 << pin)) | level << pin);
    avr_ioport_external_t outside = {
        .name = (unsigned)port, .mask = masks[(int)port], .value = values[(int)port]};
    avr_ioctl(avr, AVR_IOCTL_IOPORT_SET_EXTERNAL(port), &outside);
    avr_raise_irq(avr_io_getirq(avr, AVR_IOCTL_IOPORT_GETIRQ(port), pin), level);
}

static void turn_encoder(struct encoder *encoder, double edges)
{
    static const uint8_t gray[4] = {0, 1, 3, 2};
    encoder->turned += edges;
    int64_t whole = (int64_t)encoder->turned - (encoder->turned < (double)(int64_t)encoder->turned);
    if (whole == encoder->edges)
        return;
    encoder->edges += whole > encoder->edges ? 1 : -1;
    uint8_t phases = gray[encoder->edges & 3];
    set_pin('C', encoder->pin_a, phases & 1);
    set_pin('C', encoder->pin_b, phases >> 1);
}

/* A pin that nobody drives is high: the wiring has pull-ups on all inputs of the motor driver. */
static bool is_high(int ddr, int port, int bit)
{
    return !(avr->data[ddr] & 1 << bit) || (avr->data[port] & 1 << bit);
}

static unsigned word_at(int address)
{
    return avr->data[address] | (unsigned)avr->data[address + 1] << 8;
}

static void read_bridge(int in_1, int in_2, int pwm_bit, int compare, int connected, int16_t *duty,
                        uint8_t *bridge)
{
    bool one = is_high(PIND_DDR, PIND_PORT, in_1), two = is_high(PIND_DDR, PIND_PORT, in_2);
    unsigned top = word_at(REG_ICR1);
    bool is_pwm = avr->data[PINB_DDR] & 1 << pwm_bit && avr->data[REG_TCCR1A] & connected && top;
    int share = is_pwm ? (int)(word_at(compare) * 1000u / top)
                       : is_high(PINB_DDR, PINB_PORT, pwm_bit) ? 1000 : 0;
    *duty = 0;
    *bridge = one == two ? (one ? BRAKES : COASTS) : share ? DRIVES : BRAKES;
    if (*bridge == DRIVES)
        *duty = (int16_t)(one ? share : -share);
}

static void put_faults(uint8_t faults)
{
    if (faults & FAULT_RESET)
        avr_reset(avr);
    avr_io_addr_t io = AVR_DATA_TO_IO(REG_TCCR0B);
    if (faults & FAULT_CLOCK && avr->io[io].w.c)
        avr->io[io].w.c(avr, REG_TCCR0B, 0, avr->io[io].w.param);
}

static bool run(uint32_t run_us, double left_step, double right_step)
{
    avr_irq_t *input = avr_io_getirq(avr, AVR_IOCTL_UART_GETIRQ('0'), UART_IRQ_INPUT);
    avr_cycle_count_t end = avr->cycle + (uint64_t)run_us * (HZ / 1000000);
    while (avr->cycle < end) {
        avr_cycle_count_t before = avr->cycle;
        int state = avr_run(avr);
        if (state == cpu_Crashed || state == cpu_Done)
            return false;
        double cycles = avr->cycle > before ? (double)(avr->cycle - before) : 0.0;
        turn_encoder(&left, left_step * cycles);
        turn_encoder(&right, right_step * cycles);
        while (waiting_at < waiting_count && has_room)
            avr_raise_irq(input, waiting[waiting_at++]);
    }
    return true;
}

static bool begin(const char *path)
{
    elf_firmware_t firmware;
    memset(&firmware, 0, sizeof firmware);
    if (elf_read_firmware(path, &firmware) != 0)
        return false;
    avr = avr_make_mcu_by_name("atmega328p");
    if (!avr || avr_init(avr) != 0)
        return false;
    avr->log = LOG_ERROR;
    firmware.frequency = HZ;
    avr->vcc = avr->avcc = avr->aref = 5000;
    avr_load_firmware(avr, &firmware);
    avr->frequency = HZ;
    uint32_t flags = 0;
    avr_ioctl(avr, AVR_IOCTL_UART_SET_FLAGS('0'), &flags);
    avr_irq_t *irq = avr_io_getirq(avr, AVR_IOCTL_UART_GETIRQ('0'), 0);
    avr_irq_register_notify(irq + UART_IRQ_OUTPUT, on_said, NULL);
    avr_irq_register_notify(irq + UART_IRQ_OUT_XON, on_room, &has_room);
    avr_irq_register_notify(irq + UART_IRQ_OUT_XOFF, on_room, NULL);
    return true;
}

int main(int argc, char **argv)
{
    struct request request;
    FILE *replies = fdopen(dup(STDOUT_FILENO), "wb");
    dup2(STDERR_FILENO, STDOUT_FILENO); /* simavr prints there what it thinks */
    if (!replies || argc != 2 || !begin(argv[1])) {
        fprintf(stderr, "board: expected the path of a firmware for the ATmega328P\n");
        return 2;
    }
    while (fread(&request, sizeof request, 1, stdin) == 1) {
        if (waiting_at == waiting_count)
            waiting_at = waiting_count = 0;
        if (request.count > MOST_BYTES - waiting_count
            || fread(waiting + waiting_count, 1, request.count, stdin) != request.count)
            return 3;
        waiting_count += request.count;
        set_pin('B', 0, !!(request.inputs & INPUT_STOP));
        avr_raise_irq(avr_io_getirq(avr, AVR_IOCTL_ADC_GETIRQ, ADC_IRQ_ADC6), request.battery_mv);
        put_faults(request.faults);
        said_count = 0;
        if (!run(request.run_us, request.left_medges / 1000.0 / HZ, request.right_medges / 1000.0 / HZ))
            return 4;
        struct reply reply = {.count = (uint16_t)said_count};
        read_bridge(4, 5, 1, REG_OCR1A, 0x80, &reply.left_duty, &reply.left_bridge);
        read_bridge(6, 7, 2, REG_OCR1B, 0x20, &reply.right_duty, &reply.right_bridge);
        fwrite(&reply, sizeof reply, 1, replies);
        fwrite(said, 1, said_count, replies);
        fflush(replies);
    }
    return 0;
}
