/* The second stage of booting: 256 bytes at the start of flash, which the chip's ROM copies to its own
 * memory, checks by CRC, and calls. It makes flash readable in its place by the slowest command that
 * every flash chip has (03h), and starts what lies behind it. image.py puts the CRC at its end. */
    .syntax unified
    .cpu cortex-m0plus
    .thumb

    .equ SSI, 0x18000000
    .equ SSI_CTRLR0, 0x00
    .equ SSI_CTRLR1, 0x04
    .equ SSI_ENABLE, 0x08
    .equ SSI_DIVIDER, 0x14
    .equ SSI_SPI_CTRLR0, 0xf4

    .section .boot2, "ax"
    .global boot2
    .thumb_func
boot2:
    ldr r3, =SSI
    movs r0, #0
    str r0, [r3, #SSI_ENABLE]
    movs r0, #4                     /* even; of 12 MHz 3 remain */
    str r0, [r3, #SSI_DIVIDER]
    ldr r0, =(31 << 16) | (3 << 8)  /* 32 bits a frame; send a command, then read */
    str r0, [r3, #SSI_CTRLR0]
    ldr r0, =(0x03 << 24) | (2 << 8) | (6 << 2) /* read; command of 8 bits, address of 24 */
    ldr r1, =SSI + SSI_SPI_CTRLR0
    str r0, [r1]
    movs r0, #0
    str r0, [r3, #SSI_CTRLR1]       /* one frame at a time */
    movs r0, #1
    str r0, [r3, #SSI_ENABLE]

    ldr r0, =0x10000100             /* the table behind these 256 bytes */
    ldr r1, =0xe000ed08             /* VTOR */
    str r0, [r1]
    ldmia r0!, {r1, r2}
    msr msp, r1
    bx r2
    .ltorg
