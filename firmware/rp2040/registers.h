/* The few registers of the RP2040 that this port uses, named and placed by its datasheet. */
#ifndef PONS_REGISTERS_H
#define PONS_REGISTERS_H

#include <stdint.h>

#define REGISTER(address) (*(volatile uint32_t *)(address))

/* Of the peripherals up to 0x5fffffff: writes there set or clear bits and leave the others alone. */
#define SET_BITS(address) REGISTER((address) + 0x2000UL)
#define CLEAR_BITS(address) REGISTER((address) + 0x3000UL)

#define RESETS_RESET 0x4000c000UL
#define RESETS_DONE 0x4000c008UL
enum { RESET_ADC = 1 << 0, RESET_IO = 1 << 5, RESET_PADS = 1 << 8, RESET_PWM = 1 << 14, RESET_TIMER = 1 << 21,
       RESET_UART0 = 1 << 22 };

#define CLK_REF_CTRL 0x40008030UL /* 0 to 1: 2 is the crystal */
#define CLK_REF_SELECTED 0x40008038UL
#define CLK_SYS_CTRL 0x4000803cUL /* 0: clk_ref */
#define CLK_SYS_SELECTED 0x40008044UL
#define CLK_PERI_CTRL 0x40008048UL /* 11: on; 5 to 7: 0 is clk_sys */
#define CLK_ADC_CTRL 0x40008060UL /* 11: on; 5 to 7: 3 is the crystal */
#define XOSC_CTRL 0x40024000UL
#define XOSC_STATUS 0x40024004UL
#define XOSC_STARTUP 0x4002400cUL
#define ROSC_RANDOMBIT 0x4006001cUL

#define WATCHDOG_CTRL 0x40058000UL
#define WATCHDOG_LOAD 0x40058004UL
#define WATCHDOG_TICK 0x4005802cUL
#define PSM_WDSEL 0x40010008UL
#define TIMER_RAW_LOW 0x40054028UL

#define GPIO_CTRL(pin) (0x40014004UL + 8UL * (pin))
#define GPIO_EDGES(pin) (0x400140f0UL + 4UL * ((pin) / 8))   /* raw; writing 1 forgets an edge */
#define GPIO_ENABLES(pin) (0x40014100UL + 4UL * ((pin) / 8)) /* to the first processor */
enum { EDGE_LOW = 1 << 2, EDGE_HIGH = 1 << 3 };              /* four bits a pin */
enum { FUNCTION_UART = 2, FUNCTION_PWM = 4, FUNCTION_SIO = 5 };
#define PAD(pin) (0x4001c004UL + 4UL * (pin))
enum { PAD_INPUT = 1 << 6, PAD_PULL_UP = 1 << 3, PAD_PULL_DOWN = 1 << 2, PAD_SCHMITT = 1 << 1,
       PAD_4_MA = 1 << 4, PAD_NO_OUTPUT = 1 << 7 };

#define ADC_CONTROL 0x4004c000UL /* 12 to 14: the input */
#define ADC_RESULT 0x4004c004UL
enum { ADC_ON = 1 << 0, ADC_START = 1 << 2, ADC_READY = 1 << 8, ADC_FAILED = 1 << 9 };

#define SIO_IN 0xd0000004UL
#define SIO_OUT_SET 0xd0000014UL
#define SIO_OUT_CLEAR 0xd0000018UL
#define SIO_OUTPUTS_SET 0xd0000024UL

#define PWM_CSR(slice) (0x40050000UL + 0x14UL * (slice)) /* 0: on, 1: phase correct */
#define PWM_DIVIDER(slice) (0x40050004UL + 0x14UL * (slice))
#define PWM_LEVELS(slice) (0x4005000cUL + 0x14UL * (slice)) /* A low half, B high half */
#define PWM_TOP(slice) (0x40050010UL + 0x14UL * (slice))

#define UART_DATA 0x40034000UL
#define UART_FLAGS 0x40034018UL
#define UART_WHOLE_DIVIDER 0x40034024UL
#define UART_PART_DIVIDER 0x40034028UL
#define UART_LINE 0x4003402cUL
#define UART_CONTROL 0x40034030UL
#define UART_INTERRUPTS 0x40034038UL
enum { UART_SENDER_FULL = 1 << 5, UART_NOTHING_HEARD = 1 << 4 };
enum { UART_8_BITS = 3 << 5, UART_QUEUES = 1 << 4 };
enum { UART_ON = 1 << 0, UART_SENDS = 1 << 8, UART_HEARS = 1 << 9 };
enum { UART_HEARD = 1 << 4, UART_HAS_ROOM = 1 << 5, UART_HEARD_AND_IDLE = 1 << 6 };

#define NVIC_ENABLE 0xe000e100UL
enum { IRQ_GPIO = 13, IRQ_UART0 = 20 };

#endif
