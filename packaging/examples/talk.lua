-- Two who talk, in speech bubbles of a comic typeface; what one of them types is in another.
--
--   celspan watch talk.lua

local COMIC, TYPED, FPS = "fonts/ComicNeue-Bold.otf", "fonts/Courier Prime.otf", 24
local lines = { -- from, to, who, what
  { 0.3, 1.8, 1, "Did you see that?" },
  { 2.0, 3.4, 2, "The star?\nIt fell into the pond." },
  { 3.6, 5.6, 1, "I am writing it down." },
}
local heads = { { 250, 400, "#f2a65a" }, { 710, 400, "#7fb7a3" } }

local function head(x, y, colour, blinks)
  local eye = blinks and 2 or 11
  return { circle { x, y, 90, fill = colour },
    ellipse { x - 30, y - 10, 9, eye, fill = "#2b2233" },
    ellipse { x + 30, y - 10, 9, eye, fill = "#2b2233" } }
end

local function bubble(who, words)
  local x = heads[who][1]
  return { rect { x - 190, 90, 380, 150, radius = 40, fill = "#fffaf0" },
    path { d = ("M%d 230 L%d 300 L%d 230 Z"):format(x - 30, x, x + 25),
      fill = "#fffaf0" },
    text { words, x, 165, font = COMIC, size = 34, leading = 1.2,
      align = "centre", fill = "#2b2233" } }
end

local back = rect { 0, 0, 960, 540, fill = "#3b3a5a" }
local page = rect { 300, 440, 360, 80, radius = 6, fill = "#fffaf0" }
local note = "a star fell into the pond"

return film { title = "Talk", size = { 960, 540 }, fps = FPS, frames = 6 * FPS,
  frame = function(f)
    local art = { back }
    for i, at in ipairs(heads) do
      local blinks = (f.time + i) % 1.7 < 0.12
      for _, shape in ipairs(head(at[1], at[2], at[3], blinks)) do art[#art + 1] = shape end
    end
    for _, line in ipairs(lines) do
      if f.time >= line[1] and f.time < line[2] then
        for _, shape in ipairs(bubble(line[3], line[4])) do art[#art + 1] = shape end
      end
    end
    local typed = math.min(#note, math.floor((f.time - 3.8) * 14))
    if typed > 0 then
      art[#art + 1] = page
      art[#art + 1] = text { note:sub(1, typed), 320, 488, font = TYPED, size = 20,
        fill = "#2b2233" }
    end
    return cel(art)
  end }
