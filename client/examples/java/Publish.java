// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// Publishes one cloud, a box on a table seen from above:
// ../bindings java build && java -cp build/graspd-types.jar:/usr/share/java/lcm.jar Publish.java
import graspd.point_cloud_t;
import graspd.point_field_t;
import java.nio.ByteBuffer;
import java.nio.ByteOrder;
import lcm.lcm.LCM;

public class Publish {
    public static void main(String[] args) throws Exception {
        point_cloud_t cloud = new point_cloud_t();
        cloud.utime = 1;
        cloud.frame_name = "java";
        cloud.width = 80;
        cloud.height = 60;
        cloud.num_fields = 3;
        cloud.fields = new point_field_t[3];
        for (int i = 0; i < 3; ++i) {
            cloud.fields[i] = new point_field_t();
            cloud.fields[i].name = "xyz".substring(i, i + 1);
            cloud.fields[i].offset = 4 * i;
            cloud.fields[i].datatype = point_field_t.FLOAT32;
            cloud.fields[i].count = 1;
        }
        cloud.point_step = 12;
        ByteBuffer points = ByteBuffer.allocate(12 * 80 * 60).order(ByteOrder.LITTLE_ENDIAN);
        for (int v = -30; v < 30; ++v) {
            for (int u = -40; u < 40; ++u) {
                boolean onBox = Math.abs(u) < 8 && Math.abs(v) < 16;
                points.putFloat((float) (u * 0.003)).putFloat((float) (v * 0.003));
                points.putFloat(onBox ? 0.74f : 0.8f);  // metres from the sensor
            }
        }
        cloud.data = points.array();
        cloud.data_size = cloud.data.length;
        LCM lcm = new LCM();
        lcm.publish("GRASPD_CLOUD", cloud);
        lcm.close();
    }
}
