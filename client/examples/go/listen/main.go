// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause

// Prints handles as CSV: go run ./listen
package main

import (
	"fmt"
	"log"

	"graspd/graspd"
	"graspd/lcm"
)

func printAnswer(data []byte) {
	var answer graspd.HandleList
	if err := graspd.Decode(data, &answer); err != nil {
		log.Print("no handle_list_t: ", err)
		return
	}
	for _, h := range answer.Handles {
		fmt.Printf("%s,%.6f,%.6f,%.6f,", answer.FrameName, h.Position[0], h.Position[1], h.Position[2])
		fmt.Printf("%.6f,%.6f,%.6f,%.6f,", h.Orientation[0], h.Orientation[1], h.Orientation[2], h.Orientation[3])
		fmt.Printf("%.6f,%.6f\n", h.Width, h.Score)
	}
}

func main() {
	bus, err := lcm.New()
	if err == nil {
		err = bus.Subscribe("GRASPD_HANDLES", printAnswer)
	}
	fmt.Println("frame,px,py,pz,qw,qx,qy,qz,width,score")
	for err == nil {
		err = bus.Handle()
	}
	log.Fatal(err)
}
