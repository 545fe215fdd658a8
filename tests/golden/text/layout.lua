-- Lines that wrap within a width, left-aligned, centred and right-aligned, with tracking;
-- right-to-left lines, in which signs and numbers are reordered around letters that are not.
local celspan = require "celspan"
local function set(phrase, x, y, more)
  local fields = { phrase, font = "../../../scripts/type/block.ttf", size = 9, at = { x, y },
    leading = 1.1,
    texture = "#fff" }
  for name, value in pairs(more or {}) do fields[name] = value end
  return celspan.text(fields)
end
local words = "ink on a cel"
return celspan.film { size = { 96, 64 }, frame = function()
  return celspan.rostrum { antialias = "none", back = { 0, 0, 0, 1 }, celspan.cel {
    set(words, 1, 9, { width = 28 }), set(words, 33, 9, { width = 28, align = "centre" }),
    set(words, 65, 9, { width = 28, align = "right" }), set("hold\nit", 1, 42, { tracking = 250 }),
    set("go (12) no.", 62, 60, { direction = "rtl", align = "right", width = 33, at = { 62, 42 } }),
    set("go no.", 1, 62, { direction = "ltr" }) } }
end }
