-- SPDX-FileCopyrightText: 2026 The graspd authors
-- SPDX-License-Identifier: BSD-3-Clause
-- golden.lua GOLDEN_FOLDER OUT_FOLDER TYPE...: decodes the golden messages by lcm-gen's code, writes their values as JSON and
-- encodes them again.
local function json(value)
  if type(value) == 'string' then return '"' .. value:gsub('[\\"]', '\\%0') .. '"' end
  if type(value) == 'number' then return string.format('%.17g', value) end
  local parts = {}
  if #value > 0 then
    for i, part in ipairs(value) do parts[i] = json(part) end
    return '[' .. table.concat(parts, ',') .. ']'
  end
  for name, member in pairs(value) do parts[#parts + 1] = '"' .. name .. '":' .. json(member) end
  return '{' .. table.concat(parts, ',') .. '}'
end

local function write(path, data)
  local file = assert(io.open(path, 'wb'))
  file:write(data)
  file:close()
end

for i = 3, #arg do
  local file = assert(io.open(arg[1] .. '/' .. arg[i] .. '.bin', 'rb'))
  local message = require('graspd.' .. arg[i]).decode(file:read('*a'))
  file:close()
  write(arg[2] .. '/' .. arg[i] .. '.json', json(message))
  write(arg[2] .. '/' .. arg[i] .. '.bin', message:encode())
end
