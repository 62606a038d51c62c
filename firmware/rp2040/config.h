/* What your build is: the one file to edit. docs/firmware.md has the wiring.
 *
 * Radius and track are not here: they are robot.toml's. What the motors do without torque is not
 * here either: they brake. */
#ifndef PONS_CONFIG_H
#define PONS_CONFIG_H

/* The motor driver. IN_IN: two inputs a motor and PWM on both (DRV8833). PWM_IN_IN: two inputs for the
 * sense and one for PWM (TB6612FNG). All at 3.3 V: an L298N wants 5. */
#define DRIVER_PWM_IN_IN 1
#define DRIVER_IN_IN 2
#ifndef DRIVER
#define DRIVER DRIVER_PWM_IN_IN
#endif

#define PWM_HZ 20000UL

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

/* Stop input GP2: a contact to ground that a pressed button OPENS, so that a broken wire stops too.
 * Without a button, join GP2 to ground by a wire. It can't be configured away. */

/* Contacts to ground that close when touched; 1 where one is fitted. */
#define HAS_BUMPER_FRONT 0 /* GP3 */
#define HAS_BUMPER_REAR 0  /* GP4 */
#define HAS_CLIFF 0        /* GP5 */

/* What 3.3 V at the pin stand for; 0 where it isn't fitted. More than 3.3 V kills the pin. */
#ifndef BATTERY_FULL_SCALE_MV
#define BATTERY_FULL_SCALE_MV 0UL /* GP26, through a divider: 33k over 10k gives 14190 */
#endif
#ifndef CURRENT_FULL_SCALE_MA
#define CURRENT_FULL_SCALE_MA 0UL /* GP27, of both motors together */
#endif
#ifndef MOST_MA
#define MOST_MA 0 /* more for 0.1 s takes the torque away; 0: not watched */
#endif

#define BAUD 115200UL

#endif
