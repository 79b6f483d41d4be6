-- SPDX-FileCopyrightText: 2026 The graspd authors
-- SPDX-License-Identifier: BSD-3-Clause
-- Publishes one cloud, a box on a table seen from above:
-- ../bindings lua build && LUA_PATH='build/?.lua;build/?/init.lua' lua5.2 publish.lua
local lcm = require('lcm')
local point_cloud_t = require('graspd.point_cloud_t')
local point_field_t = require('graspd.point_field_t')

local cloud = point_cloud_t:new()
cloud.utime, cloud.frame_name, cloud.width, cloud.height = 1, 'lua', 80, 60
for i, name in ipairs({'x', 'y', 'z'}) do
  local field = point_field_t:new()
  field.name, field.offset, field.datatype, field.count = name, 4 * (i - 1), point_field_t.FLOAT32, 1
  cloud.fields[i] = field
end
cloud.num_fields, cloud.point_step = 3, 12
for v = -30, 29 do
  for u = -40, 39 do
    local on_box = math.abs(u) < 8 and math.abs(v) < 16
    local z = on_box and 0.74 or 0.8  -- metres from the sensor
    -- LCM packs the most significant byte first, clouds hold the least significant one first.
    local packed = lcm._pack.pack('>fff', z, v * 0.003, u * 0.003):reverse()
    for i = 1, 12 do cloud.data[#cloud.data + 1] = packed:byte(i) end
  end
end
cloud.data_size = #cloud.data
lcm.lcm.new():publish('GRASPD_CLOUD', cloud:encode())
