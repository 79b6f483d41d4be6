/* SPDX-FileCopyrightText: 2026 The graspd authors
 * SPDX-License-Identifier: BSD-3-Clause
 * Prints handles as CSV: ../bindings c build && gcc listen.c -Ibuild build/libgraspd_types.a -llcm -o listen
 */
#include <lcm/lcm.h>
#include <stdio.h>

#include "graspd_handle_list_t.h"

static void on_answer(const lcm_recv_buf_t* buffer, const char* channel, const graspd_handle_list_t* answer,
                      void* user) {
  (void)buffer, (void)channel, (void)user;
  for (int i = 0; i < answer->num_handles; ++i) {
    const graspd_handle_t* h = &answer->handles[i];
    printf("%s,%.6f,%.6f,%.6f,", answer->frame_name, h->position[0], h->position[1], h->position[2]);
    printf("%.6f,%.6f,%.6f,%.6f,", h->orientation[0], h->orientation[1], h->orientation[2],
           h->orientation[3]);
    printf("%.6f,%.6f\n", h->width, h->score);
  }
  fflush(stdout);
}

int main(void) {
  lcm_t* lcm = lcm_create(NULL); /* LCM_DEFAULT_URL, else a group that stays on this machine */
  if (!lcm) return 1;
  graspd_handle_list_t_subscribe(lcm, "GRASPD_HANDLES", on_answer, NULL);
  printf("frame,px,py,pz,qw,qx,qy,qz,width,score\n");
  fflush(stdout);
  while (lcm_handle(lcm) == 0) {
  }
  lcm_destroy(lcm);
  return 1;
}
