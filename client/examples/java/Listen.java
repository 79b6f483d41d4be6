// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// Prints handles as CSV: ../bindings java build && java -cp build/graspd-types.jar:/usr/share/java/lcm.jar Listen.java
import graspd.handle_list_t;
import graspd.handle_t;
import lcm.lcm.LCM;

public class Listen {
    public static void main(String[] args) throws Exception {
        LCM lcm = new LCM();  // LCM_DEFAULT_URL, else a group that stays on this machine
        System.out.println("frame,px,py,pz,qw,qx,qy,qz,width,score");
        lcm.subscribe("GRASPD_HANDLES", (bus, channel, data) -> {
            try {
                handle_list_t answer = new handle_list_t(data);
                for (handle_t h : answer.handles) {
                    System.out.printf("%s,%.6f,%.6f,%.6f,%.6f,%.6f,%.6f,%.6f,%.6f,%.6f%n", answer.frame_name,
                        h.position[0], h.position[1], h.position[2], h.orientation[0], h.orientation[1],
                        h.orientation[2], h.orientation[3], h.width, h.score);
                }
            } catch (java.io.IOException e) {
                System.err.println("no handle_list_t: " + e);
            }
        });
        Thread.currentThread().join();  // LCM receives in a thread of its own
    }
}
