--- Ink and paint: the steps between a drawing and a cel. Each function is loaded when it is first
-- read, so that a film pays for what it uses.
--
--   ink.scan("rough.####.png")          -- scans, registered by their pegs and cleaned
--   ink.area { lines, at = { 320, 88 } } -- paint between lines, although they have gaps
--   ink.follow(drawings, seeds)         -- the same areas in the drawings after
--   ink.recolour(hero, day, night)      -- a drawing in the colours of another palette
local native = require "celspan.native"
local fields = require "celspan.fields"

local ink = {}

--- The private modules, each of which returns its functions by their names here.
local parts = { area = "ink_area", areas = "ink_area", follow = "ink_follow", leak = "ink_area",
  recolour = "ink_recolour", scan = "ink_scan" }

local refuse = getmetatable(fields.seal("ink", ink)).__index

getmetatable(ink).__index = function(module, name)
  local own = type(name) == "string" and not parts[name] and native.synonym(name, true) or name
  if not parts[own] then return refuse(module, name) end
  local found = native.entry(require("celspan." .. parts[own])[own])
  rawset(module, own, found)
  return found
end

return ink
