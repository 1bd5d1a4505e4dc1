/* SPDX-License-Identifier: Apache-2.0 */
/* The controller for firmware in C: one call a tick of 1 ms, from CAN frames in to CAN frames out.
 *
 *   static striker_controller controller;
 *   striker_init(&controller, random_number());
 *   every 1 ms:
 *     count = striker_step(&controller, received, received_count, tick, answers, STRIKER_MOST_ANSWERS);
 *     send answers[0] to answers[count - 1], in this order
 *
 * No heap, no floating point, no exceptions, no statics: all state is in the object, which may lie anywhere,
 * be copied, and exist several times. One thread at a time for each object. Nothing here waits or fails:
 * what goes wrong becomes a latched fault and torque 0, which the answers tell. firmware/can/striker.dbc has
 * the messages.
 */
#ifndef STRIKER_H
#define STRIKER_H

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Frames that a step takes: 1 ms of a 1 Mbit/s bus holds 21 of the shortest. Further ones are ignored. */
#define STRIKER_MOST_FRAMES 24

/* Frames that a step makes, at most. */
#define STRIKER_MOST_ANSWERS 12

/* A classic CAN 2.0A data frame. */
typedef struct striker_frame {
  uint16_t id;     /* 11 bits */
  uint8_t length;  /* 0 to 8 */
  uint8_t data[8]; /* those from `length` on are 0 */
} striker_frame;

typedef enum striker_state {
  STRIKER_BOOT = 0,      /* no step yet */
  STRIKER_SELF_TEST = 1, /* golden vectors, one a tick */
  STRIKER_STANDBY = 2,   /* torque 0; an operator's frame arms */
  STRIKER_ACTIVE = 3,    /* armed: the network drives */
  STRIKER_FAULT = 4      /* latched; torque 0 until an operator's frame clears it */
} striker_state;

/* Opaque; only its size is told here. The library does not compile if the controller outgrows it. */
typedef struct striker_controller {
  uint64_t storage[176];
} striker_controller;

/* Fresh from boot. Once before anything else; again to restart. `seed`: another number at every start, never 0: from it
 * follows what an operator has to confirm, and no recording of another run may fit. */
void striker_init(striker_controller* controller, uint32_t seed);

/* One tick. `frames` are those received since the last step, in the order of reception; may be null if
 * `count` is 0. `tick` is the time in ms; it wraps, and may jump forward where ticks were missed. Writes at
 * most `capacity` answers, in the order of sending, and returns how many the step made: more than `capacity`
 * means that the last were lost, the wheel command among them: give it room for STRIKER_MOST_ANSWERS.
 *
 * Cost: firmware/policy/README.md. */
size_t striker_step(striker_controller* controller, const striker_frame* frames, size_t count, uint32_t tick,
                    striker_frame* answers, size_t capacity);

striker_state striker_get_state(const striker_controller* controller);

/* The latched fault, as `code` of the message FaultReport numbers them; 0 without one. */
uint8_t striker_get_fault(const striker_controller* controller);

#ifdef __cplusplus
}
#endif

#endif
