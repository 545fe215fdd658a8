--- A text that is typed.
--
--   local typewriter = require "celspan.typewriter"
--   local typed, x, y = typewriter({ "Dear Grandma,", font = "sans.ttf", size = 30 }, f.progress)
--
-- Letters stay where they are in the whole text, so no word jumps to another line. x, y is where
-- the next letter is set, on the baseline: for a cursor.
local native = require "celspan.native"
local fields = require "celspan.fields"
local layout = require "celspan.layout"

local SLACK = 1e-9 -- u = 3 / 10 is three letters of ten

--- The first letters of a text, and the place of the next one.
---@param text celspan.text.fields As for celspan.glyphs
---@param u number 0: none, 1: all
---@param options? { by?: "letter"|"word"|"line" } What appears at once; "letter"
---@return celspan.object typed
---@return number? x, number? y Nothing for a text without letters
local function typed(_, text, u, options)
  fields.expect(fields.is_finite(u), u,
    "typewriter: the second argument must be a finite number, 0 to 1")
  options = options or {}
  fields.check("typewriter", options, { by = "string" })
  local x, y
  local object = layout.letters(text, function(letter, i, n)
    local is_typed = i <= u * n + SLACK
    if i == 1 or is_typed then
      local is_behind = is_typed and text.direction ~= "rtl" or not is_typed and
        text.direction == "rtl"
      x, y = letter.x + (is_behind and letter.advance or 0), letter.y
    end
    return is_typed and letter.object or nil
  end, { by = options.by })
  return object, x, y
end

---@class celspan.typewriter
---@overload fun(text: celspan.text.fields, u: number, options?: { by?: "letter"|"word"|"line" }): celspan.object, number?, number?
return fields.publish("typewriter", setmetatable({}, { __call = native.entry(typed) }))
