--- Any bytes as JSON: a value of numbers, strings, booleans, null and tables of them, or nil and a
--- sentence that names a line of the text.
local json = require "celspan.json"

local target = {}

local MOST_DEPTH = 100 -- levels

--- Raises an error if a value contains anything that JSON does not have, or is nested too deep.
local function check(value, depth)
  assert(depth <= MOST_DEPTH + 1, "nested deeper than allowed")
  if type(value) == "table" and value ~= json.null then
    for name, one in pairs(value) do
      assert(type(name) == "string" or math.type(name) == "integer", "a name of another kind")
      check(one, depth + 1)
    end
  elseif type(value) == "number" then
    assert(value == value, "a number that is not a number")
  else
    assert(type(value) == "string" or type(value) == "boolean" or value == json.null,
      "a value of another kind")
  end
end

function target.try_bytes(bytes)
  local value, message = json.decode(bytes)
  if value == nil then
    local line = tonumber(message:match "^line (%d+): %g")
    local _, ends = bytes:gsub("\n", "")
    assert(line and line <= ends + 1 and #message < 300, "no sentence that names the line")
  else
    check(value, 1)
  end
end

return target
