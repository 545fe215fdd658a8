-- Figure 4: the colour model of RGBA (above) and the Beta colour model (below). Above: three paints
-- that only cover, opaque, half and a fifth. Below: the same, but each paint filters the part that
-- it does not cover, like a sheet of gelatine; the last is only a filter.

local cream = "#f4ead5"

--- The background: a page of stripes and a sun, lit from the back.
local function ground()
  local parts = { rect { 0, 0, 1920, 1080, fill = cream } }
  for i = 0, 11 do
    parts[#parts + 1] = rect { i * 160, 0, 80, 1080, fill = "#2b3a55" }
  end
  for row = 0, 1 do
    for column = 0, 2 do
      local x, y = 340 + column * 620, 290 + row * 500
      parts[#parts + 1] = circle { x, y, 96, fill = "#e2a72e" }
    end
  end
  return union(parts)
end

local betas = { 1, 0.5, 0.2 }
local pigments = { { 0.75, 0.06, 0.05 }, { 0.03, 0.35, 0.38 }, { 0.30, 0.05, 0.28 } }
local media = { { 0.95, 0.35, 0.30 }, { 0.25, 0.85, 0.75 }, { 0.75, 0.35, 0.90 } }

local function leaf(texture, turn)
  return path { fill = texture, d =
    "M0 -216C120 -190 226 -110 226 0C226 120 120 206 0 206"
    .. "C-130 206 -226 120 -226 -10C-226 -120 -130 -230 0 -216Z" }
    :rotate(turn)
end

return film { frames = 48, frame = function(f)
  local turn = 360 * f.index / f.count
  local art = {}
  for column = 1, 3 do
    local x = 340 + (column - 1) * 620
    local alpha = paint { pigment = pigments[column], beta = betas[column] }
    local beta = paint { pigment = pigments[column], medium = media[column],
                         beta = column == 3 and 0 or betas[column] }
    art[#art + 1] = leaf(alpha, turn + column * 40):translate(x, 290)
    art[#art + 1] = leaf(beta, turn + column * 40):translate(x, 790)
  end
  return { ground(), cel(art) }
end }
