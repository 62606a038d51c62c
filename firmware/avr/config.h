/* What your build is: the one file to edit. docs/firmware.md has the wiring; `make flash` takes it over.
 *
 * Radius and track are not here: they are robot.toml's. What the motors do without torque is not
 * here either: they brake. */
#ifndef PONS_CONFIG_H
#define PONS_CONFIG_H

/* The motor driver. IN_IN: two inputs a motor and PWM on both (DRV8833). PWM_IN_IN: two inputs for the
 * sense and one for PWM (TB6612FNG, L298N with its enable jumpers taken off). */
#define DRIVER_PWM_IN_IN 1
#define DRIVER_IN_IN 2
#ifndef DRIVER
#define DRIVER DRIVER_PWM_IN_IN
#endif

#define PWM_HZ 20000UL /* above what is heard; an L298N gets warm by it: 2000 */

/* -1 turns a motor's or an encoder's sense round. `pons robot try` says which. */
#define LEFT_MOTOR_SENSE 1
#define RIGHT_MOTOR_SENSE 1
#define LEFT_ENCODER_SENSE 1
#define RIGHT_ENCODER_SENSE 1

/* The wheel at full duty, unloaded, and the duty (per mille) at which it begins to turn. */
#define FREE_RADPS 20
#define START_DUTY 60
/* The regulation: duty (per mille) per rad/s of error, and per rad. */
#define KP 30
#define KI 150
/* A wheel that stands, or turns the wrong way, so long at 40 % duty or more takes the torque away. */
#define TRIP_MS 500

/* Stop input D8: a contact to ground that a pressed button OPENS, so that a broken wire stops too.
 * Without a button, join D8 to ground by a wire. It can't be configured away. */

/* Contacts to ground that close when touched; 1 where one is fitted. */
#define HAS_BUMPER_FRONT 0 /* D2 */
#define HAS_BUMPER_REAR 0  /* D12 */
#define HAS_CLIFF 0        /* A4 */

/* What 5 V at the pin stand for; 0 where it isn't fitted. */
#define BATTERY_FULL_SCALE_MV 0UL /* A6, through a divider: 10k over 3k3 gives 20152 */
#define CURRENT_FULL_SCALE_MA 0UL /* A7, of both motors together */
#define MOST_MA 0                 /* more for 0.1 s takes the torque away; 0: not watched */

#define BAUD 115200UL

#endif
