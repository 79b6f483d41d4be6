// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause

// Package lcm is as much of liblcm as a listener and a publisher need.
package lcm

/*
#cgo LDFLAGS: -llcm
#include <lcm/lcm.h>
#include <stdint.h>
#include <stdlib.h>

extern void graspdArrived(lcm_recv_buf_t *, char *, void *);

static void graspd_arrived(const lcm_recv_buf_t *buffer, const char *channel, void *user) {
  graspdArrived((lcm_recv_buf_t *)buffer, (char *)channel, user);
}
static int graspd_subscribe(lcm_t *lcm, const char *channel, uintptr_t handler) {
  return lcm_subscribe(lcm, channel, graspd_arrived, (void *)handler) ? 0 : -1;
}
*/
import "C"

import (
	"errors"
	"runtime/cgo"
	"unsafe"
)

// Bus is a connection to LCM_DEFAULT_URL, else to a group that stays on this machine.
type Bus struct{ lcm *C.lcm_t }

// New connects.
func New() (*Bus, error) {
	bus := &Bus{C.lcm_create(nil)}
	if bus.lcm == nil {
		return nil, errors.New("lcm_create failed: does LCM_DEFAULT_URL name a network that is there?")
	}
	return bus, nil
}

// Subscribe has every message of the channel handed to the function, in Handle.
func (bus *Bus) Subscribe(channel string, handler func(data []byte)) error {
	name := C.CString(channel)
	defer C.free(unsafe.Pointer(name))
	if C.graspd_subscribe(bus.lcm, name, C.uintptr_t(cgo.NewHandle(handler))) != 0 {
		return errors.New("lcm_subscribe failed")
	}
	return nil
}

// Handle waits for one message.
func (bus *Bus) Handle() error {
	if C.lcm_handle(bus.lcm) != 0 {
		return errors.New("lcm_handle failed")
	}
	return nil
}

// Publish sends one encoded message.
func (bus *Bus) Publish(channel string, data []byte) error {
	name := C.CString(channel)
	defer C.free(unsafe.Pointer(name))
	bytes := C.CBytes(data)
	defer C.free(bytes)
	if C.lcm_publish(bus.lcm, name, bytes, C.uint(len(data))) != 0 {
		return errors.New("lcm_publish failed")
	}
	return nil
}

//export graspdArrived
func graspdArrived(buffer *C.lcm_recv_buf_t, _ *C.char, user unsafe.Pointer) {
	handler := cgo.Handle(uintptr(user)).Value().(func(data []byte))
	handler(C.GoBytes(buffer.data, C.int(buffer.data_size)))
}
