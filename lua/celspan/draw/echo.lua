--- Echoes: an object with its earlier moments, fainter, behind it: celspan.echo.
--
--   celspan.echo(function(k) return ball(f.time - k / 12) end, { count = 6, fade = 0.7 })
--
--   k = 5   4   3   2   1   0         0 is now, in front and whole; each one behind it is fainter.
--       .   :   o   o   O   O
local celspan = require "celspan"
local native = require "celspan.native"
local fields = require "celspan.fields"

local echo = {}

local MOST = 1000

local function refuse(text, ...) native.refuse("echo: " .. text:format(...)) end

--- An object with its earlier moments, fainter, behind it.
---@param draw fun(k: integer): celspan.object? The object k steps ago; nil: nothing
---@param options? { count?: integer, fade?: number } Default 5, 0.7
---@return celspan.object
function echo.trail(draw, options)
  options = options or {}
  fields.expect_kind(type(draw) == "function", draw, "echo: the first argument must be a function")
  fields.check("echo", options, { count = "number", fade = "number" })
  local count, fade, objects = options.count or 5, options.fade or 0.7, {}
  fields.must(fade >= 0 and fade <= 1, "echo: field 'fade'", "from 0 to 1", fade)
  for k = fields.whole("echo: field 'count'", count, 1, MOST) - 1, 0, -1 do
    local object = draw(k)
    if object and not fields.is_object(object) then
      refuse("the function must return an object or nil, got %s for %d", fields.kind(object), k)
    end
    if object then objects[#objects + 1] = k > 0 and object:fade(fade ^ k) or object end
  end
  return celspan.union(objects)
end

return fields.seal("echo", echo)
