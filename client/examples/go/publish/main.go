// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause

// Publishes one cloud, a box on a table seen from above: go run ./publish
package main

import (
	"encoding/binary"
	"log"
	"math"

	"graspd/graspd"
	"graspd/lcm"
)

func makeCloud() graspd.PointCloud {
	cloud := graspd.PointCloud{Utime: 1, FrameName: "go", Width: 80, Height: 60, NumFields: 3, PointStep: 12}
	for i, name := range []string{"x", "y", "z"} {
		field := graspd.PointField{Name: name, Offset: int32(4 * i), Count: 1}
		field.Datatype = graspd.PointFieldFloat32
		cloud.Fields = append(cloud.Fields, field)
	}
	for v := -30; v < 30; v++ {
		for u := -40; u < 40; u++ {
			z := 0.8 // metres from the sensor
			if u > -8 && u < 8 && v > -16 && v < 16 {
				z = 0.74
			}
			for _, value := range []float64{float64(u) * 0.003, float64(v) * 0.003, z} {
				cloud.Data = binary.LittleEndian.AppendUint32(cloud.Data, math.Float32bits(float32(value)))
			}
		}
	}
	cloud.DataSize = int32(len(cloud.Data))
	return cloud
}

func main() {
	bus, err := lcm.New()
	if err != nil {
		log.Fatal(err)
	}
	cloud := makeCloud()
	data, err := graspd.Encode(&cloud)
	if err == nil {
		err = bus.Publish("GRASPD_CLOUD", data)
	}
	if err != nil {
		log.Fatal(err)
	}
}
