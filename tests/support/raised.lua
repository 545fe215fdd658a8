-- The error that a call raises which must fail.
--
--   local raised = require "tests.support.raised"
--   raised.message(film.at, film, 7)                          the whole message
--   raised.sentence(function() celspan.circle { r = 3 } end)  without "x_spec.lua:12: ", and 12
--   raised.each { ["unknown field"] = function() celspan.circle { r = 3 } end }
local assert = require "luassert"

local raised = {}

--- The message of a call that must raise an error.
function raised.message(call, ...)
  local good, message = pcall(call, ...)
  assert.is_false(good, "the call raised no error")
  return message
end

--- The message after its position, and the line. The position must be in the file that contains the
--- function.
function raised.sentence(call)
  local file = debug.getinfo(call, "S").short_src:match "[^/]*$"
  local message = raised.message(call)
  local line, rest = tostring(message):match(file:gsub("%p", "%%%0") .. ":(%d+): (.*)$")
  if not line then error("the message has no line of " .. file .. ": " .. tostring(message), 2) end
  return rest, tonumber(line)
end

--- Calls that must raise errors: each message contains its words, and begins with a line of the
--- file that contains the function.
function raised.each(cases)
  for words, call in pairs(cases) do
    local file = debug.getinfo(call, "S").short_src
    local message = raised.message(call)
    assert.is_truthy(message:find(words, 1, true), message)
    assert.is_truthy(message:find("^" .. file:gsub("%p", "%%%0") .. ":%d+: "), message)
  end
end

return raised
