// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause

// golden GOLDEN_FOLDER OUT_FOLDER: decodes every golden message, writes its values as JSON and encodes it again.
package main

import (
	"encoding/json"
	"log"
	"os"
	"path/filepath"

	"graspd/graspd"
)

var messages = map[string]graspd.Message{
	"control_t":              &graspd.Control{},
	"depth_image_t":          &graspd.DepthImage{},
	"handle_list_t":          &graspd.HandleList{},
	"point_cloud_t":          &graspd.PointCloud{},
	"sealed_t":               &graspd.Sealed{},
	"segmentation_request_t": &graspd.SegmentationRequest{},
	"segmentation_t":         &graspd.Segmentation{},
	"status_t":               &graspd.Status{},
}

func check(err error) {
	if err != nil {
		log.Fatal(err)
	}
}

func main() {
	for name, message := range messages {
		data, err := os.ReadFile(filepath.Join(os.Args[1], name+".bin"))
		check(err)
		check(graspd.Decode(data, message))
		text, err := json.Marshal(message)
		check(err)
		check(os.WriteFile(filepath.Join(os.Args[2], name+".json"), text, 0o644))
		data, err = graspd.Encode(message)
		check(err)
		check(os.WriteFile(filepath.Join(os.Args[2], name+".bin"), data, 0o644))
	}
}
