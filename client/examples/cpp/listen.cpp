// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// Prints handles as CSV: ../bindings cpp build && g++ listen.cpp -Ibuild -llcm -o listen
#include <cstdio>
#include <lcm/lcm-cpp.hpp>

#include "graspd/handle_list_t.hpp"

struct Printer {
  void on_answer(const lcm::ReceiveBuffer*, const std::string&, const graspd::handle_list_t* answer) {
    for (const graspd::handle_t& h : answer->handles) {
      std::printf("%s,%.6f,%.6f,%.6f,", answer->frame_name.c_str(), h.position[0], h.position[1],
                  h.position[2]);
      std::printf("%.6f,%.6f,%.6f,%.6f,", h.orientation[0], h.orientation[1], h.orientation[2],
                  h.orientation[3]);
      std::printf("%.6f,%.6f\n", h.width, h.score);
    }
    std::fflush(stdout);
  }
};

int main() {
  lcm::LCM lcm;  // LCM_DEFAULT_URL, else a group that stays on this machine
  if (!lcm.good()) return 1;
  Printer printer;
  lcm.subscribe("GRASPD_HANDLES", &Printer::on_answer, &printer);
  std::printf("frame,px,py,pz,qw,qx,qy,qz,width,score\n");
  std::fflush(stdout);
  while (lcm.handle() == 0) {
  }
  return 1;
}
