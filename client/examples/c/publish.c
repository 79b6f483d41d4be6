/* SPDX-FileCopyrightText: 2026 The graspd authors
 * SPDX-License-Identifier: BSD-3-Clause
 * Publishes one cloud, a box on a table seen from above:
 * ../bindings c build && gcc publish.c -Ibuild build/libgraspd_types.a -llcm -o publish */
#include <lcm/lcm.h>
#include <stdlib.h>

#include "graspd_point_cloud_t.h"

#define WIDTH 80
#define HEIGHT 60

int main(void) {
  static float points[HEIGHT][WIDTH][3]; /* little-endian on every machine that this is for */
  for (int v = 0; v < HEIGHT; ++v) {
    for (int u = 0; u < WIDTH; ++u) {
      const int on_box = abs(u - 40) < 8 && abs(v - 30) < 16;
      points[v][u][0] = (float)((u - 40) * 0.003);
      points[v][u][1] = (float)((v - 30) * 0.003);
      points[v][u][2] = on_box ? 0.74f : 0.8f; /* metres from the sensor */
    }
  }
  graspd_point_field_t fields[3] = {{"x", 0, GRASPD_POINT_FIELD_T_FLOAT32, 1},
                                    {"y", 4, GRASPD_POINT_FIELD_T_FLOAT32, 1},
                                    {"z", 8, GRASPD_POINT_FIELD_T_FLOAT32, 1}};
  const graspd_point_cloud_t cloud = {.utime = 1,
                                      .frame_name = "c",
                                      .width = WIDTH,
                                      .height = HEIGHT,
                                      .num_fields = 3,
                                      .fields = fields,
                                      .point_step = 12,
                                      .data_size = sizeof(points),
                                      .data = (uint8_t*)points};
  lcm_t* lcm = lcm_create(NULL);
  if (!lcm) return 1;
  const int failed = graspd_point_cloud_t_publish(lcm, "GRASPD_CLOUD", &cloud) != 0;
  lcm_destroy(lcm);
  return failed;
}
