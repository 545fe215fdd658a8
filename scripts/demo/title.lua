-- The name, written into the sky with a round pen: letters of arcs and lines on a grid of 100.

local title = {}

--- letter -> its width and the path of the pen; the baseline is y = 0, small letters are 100 high.
local letters = {
  c = { 92, "M83.5 -87.2A50 50 0 1 0 83.5 -12.8" },
  e = { 104, "M4 -50H100A50 50 0 1 0 87.2 -16.5" },
  l = { 26, "M10 -150V0" },
  s = { 74, "M56.5 -87A26 26 0 1 0 25.1 -49.6L42.6 -48.5A25 25 0 1 1 12.3 -12.5" },
  p = { 104, "M0 -100V46M0 -50a50 50 0 0 1 100 0a50 50 0 0 1 -100 0" },
  a = { 104, "M100 -50a50 50 0 0 0 -100 0a50 50 0 0 0 100 0M100 -100V0" },
  n = { 84, "M0 0V-100M0 -62a38 38 0 0 1 76 0V0" },
}

local flow = ease "inOutSine"

--- The word, written up to `progress`, 0 to 1.
function title.write(word, progress, texture)
  local parts, x = {}, 0
  for i = 1, #word do
    local letter = letters[word:sub(i, i)]
    local part = flow(math.max(0, math.min(1, progress * (#word + 2) / 3 - (i - 1) / 3)))
    parts[i] = stroke { d = letter[2], width = 17, cap = "round", join = "round", to = part,
                        fill = texture }:translate(x, 0)
    x = x + letter[1] + 34
  end
  return union(parts), x - 34
end

return title
