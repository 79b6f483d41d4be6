// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause

// Package graspd has graspd's LCM types and their encoding.
package graspd

import (
	"bytes"
	"encoding/binary"
	"errors"
	"fmt"
	"math"
	"reflect"
)

// Message is one of the types that go on a channel by themselves.
type Message interface{ fingerprint() uint64 }

var errShort = errors.New("the message ends before its last member")

// Encode gives the bytes of a message, which is a pointer to one of this package's types. Each slice must be as
// long as the member that counts it says.
func Encode(message Message) ([]byte, error) {
	var out bytes.Buffer
	binary.Write(&out, binary.BigEndian, message.fingerprint())
	err := encodeStruct(&out, reflect.ValueOf(message).Elem())
	return out.Bytes(), err
}

// Decode reads a message from its bytes.
func Decode(data []byte, message Message) error {
	if len(data) < 8 || binary.BigEndian.Uint64(data) != message.fingerprint() {
		return fmt.Errorf("not a %T", message)
	}
	rest, err := decodeStruct(data[8:], reflect.ValueOf(message).Elem())
	if err == nil && len(rest) > 0 {
		err = fmt.Errorf("%d bytes after the end of a %T", len(rest), message)
	}
	return err
}

// The member that counts a slice is named by the slice's tag.
func count(parent reflect.Value, field reflect.StructField) int {
	return int(parent.FieldByName(field.Tag.Get("count")).Int())
}

func encodeStruct(out *bytes.Buffer, value reflect.Value) error {
	for i := 0; i < value.NumField(); i++ {
		field := value.Type().Field(i)
		if field.Type.Kind() == reflect.Slice && value.Field(i).Len() != count(value, field) {
			return fmt.Errorf("%s has %d elements, %s says %d", field.Name, value.Field(i).Len(),
				field.Tag.Get("count"), count(value, field))
		}
		if err := encode(out, value.Field(i)); err != nil {
			return err
		}
	}
	return nil
}

func encode(out *bytes.Buffer, value reflect.Value) error {
	switch value.Kind() {
	case reflect.Struct:
		return encodeStruct(out, value)
	case reflect.Slice, reflect.Array:
		if value.Type().Elem().Kind() == reflect.Uint8 && value.Kind() == reflect.Slice {
			out.Write(value.Bytes())
			return nil
		}
		for i := 0; i < value.Len(); i++ {
			if err := encode(out, value.Index(i)); err != nil {
				return err
			}
		}
		return nil
	case reflect.String:
		binary.Write(out, binary.BigEndian, int32(value.Len()+1))
		out.WriteString(value.String())
		return out.WriteByte(0)
	default:
		return binary.Write(out, binary.BigEndian, value.Interface())
	}
}

func decodeStruct(data []byte, value reflect.Value) ([]byte, error) {
	var err error
	for i := 0; i < value.NumField() && err == nil; i++ {
		field := value.Type().Field(i)
		if field.Type.Kind() == reflect.Slice {
			n := count(value, field)
			if n < 0 || n > len(data) { // an element takes a byte at least
				return nil, errShort
			}
			value.Field(i).Set(reflect.MakeSlice(field.Type, n, n))
		}
		data, err = decode(data, value.Field(i))
	}
	return data, err
}

func decode(data []byte, value reflect.Value) ([]byte, error) {
	switch value.Kind() {
	case reflect.Struct:
		return decodeStruct(data, value)
	case reflect.Slice, reflect.Array:
		var err error
		for i := 0; i < value.Len() && err == nil; i++ {
			data, err = decode(data, value.Index(i))
		}
		return data, err
	case reflect.String:
		return decodeString(data, value)
	}
	size := int(value.Type().Size())
	if len(data) < size {
		return nil, errShort
	}
	bits := uint64(0)
	for _, b := range data[:size] {
		bits = bits<<8 | uint64(b)
	}
	switch value.Kind() {
	case reflect.Float64:
		value.SetFloat(math.Float64frombits(bits))
	case reflect.Uint8:
		value.SetUint(bits)
	default:
		value.SetInt(int64(bits) << (64 - 8*size) >> (64 - 8*size))
	}
	return data[size:], nil
}

func decodeString(data []byte, value reflect.Value) ([]byte, error) {
	if len(data) < 4 {
		return nil, errShort
	}
	size := int64(int32(binary.BigEndian.Uint32(data))) // with the final zero
	if size < 1 || size > int64(len(data)-4) {
		return nil, errShort
	}
	value.SetString(string(data[4 : 4+size-1]))
	return data[4+size:], nil
}
