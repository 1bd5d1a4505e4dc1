/* SPDX-License-Identifier: Apache-2.0 */
/* The controller in a main loop in C: 1,000 ticks on a bus where nobody else is, and no waiting. */
#include "striker.h"

static striker_controller controller;
static striker_frame answers[STRIKER_MOST_ANSWERS];

int main(void) {
  uint32_t tick;
  size_t sent = 0;
  striker_init(&controller, 4); /* on a board: another number at every start */
  for (tick = 1; tick <= 1000; ++tick) {
    sent += striker_step(&controller, NULL, 0, tick, answers, STRIKER_MOST_ANSWERS);
  }
  if (striker_get_state(&controller) != STRIKER_STANDBY || striker_get_fault(&controller) != 0) {
    return 1;
  }
  return sent >= 1000 ? 0 : 1; /* a wheel command a tick, at least */
}
