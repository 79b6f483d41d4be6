-- SPDX-FileCopyrightText: 2026 The graspd authors
-- SPDX-License-Identifier: BSD-3-Clause
-- Prints handles as CSV: ../bindings lua build && LUA_PATH='build/?.lua;build/?/init.lua' lua5.2 listen.lua
local lcm = require('lcm')
local handle_list_t = require('graspd.handle_list_t')

local bus = lcm.lcm.new()  -- LCM_DEFAULT_URL, else a group that stays on this machine
print('frame,px,py,pz,qw,qx,qy,qz,width,score')
io.flush()
bus:subscribe('GRASPD_HANDLES', function(_, data)
  local answer = handle_list_t.decode(data)
  for _, h in ipairs(answer.handles) do
    local p, q = h.position, h.orientation
    print(string.format('%s,%.6f,%.6f,%.6f,%.6f,%.6f,%.6f,%.6f,%.6f,%.6f', answer.frame_name, p[1], p[2], p[3],
      q[1], q[2], q[3], q[4], h.width, h.score))
  end
  io.flush()
end)
while true do bus:handle() end
