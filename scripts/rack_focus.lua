-- Focus pulled through a multiplane set: a lamp near the camera, a house, far hills and stars.

local WIDTH, HEIGHT, FOCAL = 960, 400, 1000
-- Depths, film units away from the camera's plane.
local LAMP, HOUSE, HILLS, SKY = 0, 900, 2600, 5200

local function disc(x, y, radius, texture)
  return circle { x, y, radius, fill = texture }
end

-- A plane's art is drawn about the film's centre, enlarged to make up for its distance.
local function at_depth(z, art)
  local scale = (FOCAL + z) / FOCAL
  return cel { art:translate(-WIDTH / 2, -HEIGHT / 2):scale(scale)
    :translate(WIDTH / 2, HEIGHT / 2) }
end

local function sky()
  local stars = {}
  for i = 1, 60 do
    local x, y = (i * 377) % WIDTH, (i * i * 53) % 260
    stars[i] = disc(x, y, 0.8 + (i % 5) * 0.3, "#fff6d8")
  end
  local dusk = linear { from = { 0, 0 }, to = { 0, HEIGHT },
    { 0, "#0c1838" }, { 0.7, "#6a4a78" }, { 1, "#f08a5c" } }
  return rect { -200, -200, WIDTH + 400, HEIGHT + 400, fill = dusk }
    | union(stars) | disc(690, 90, 26, "#fff0c0")
end

local function hills()
  return path {
    d = "M-300 330 C 60 120 240 180 400 290 S 760 120 1260 310 L1260 700 L-300 700 Z",
      fill = "#2c2a52" }
    | path {
      d = "M-300 360 C 100 300 300 350 520 330 S 980 260 1260 350 L1260 700 L-300 700 Z",
      fill = "#1d2244" }
end

local function house()
  local panes = {}
  for i = 0, 5 do
    panes[#panes + 1] = rect { 338 + i % 3 * 62, 218 + i // 3 * 60, 34, 38,
      fill = "#ffd070" }
  end
  return rect { 310, 190, 214, 240, fill = "#3a2030" }
    | polygon { { 288, 194 }, { 417, 110 }, { 546, 194 }, fill = "#5c2c34" }
    | union(panes)
    | rect { -300, 384, 1560, 300, fill = "#141a2a" }
end

local function lamp()
  return rect { 754, 130, 14, 400, fill = "#10131c" }
    | path { d = "M724 130 L798 130 L784 60 L738 60 Z", fill = "#ffe9a8" }
    | path { d = "M726 60 L796 60 L761 34 Z", fill = "#10131c" }
    | polygon { { 100, 480 }, { 20, 250 }, { 60, 330 }, { 70, 190 }, { 110, 320 },
      { 150, 210 },
      { 150, 330 }, { 190, 270 }, { 160, 480 }, fill = "#0d1a14" }
end

local planes = {
  { at_depth(SKY, sky()), z = SKY },
  { at_depth(HILLS, hills()), z = HILLS },
  { at_depth(HOUSE, house()), z = HOUSE },
  { at_depth(LAMP, lamp()), z = LAMP },
}

-- Focus distances: the lamp, the house, the sky; held, then pulled.
local focus = keys {
  { 0, FOCAL + LAMP }, { 0.6, FOCAL + LAMP }, { 1.8, FOCAL + HOUSE, "inOutCubic" },
  { 2.6, FOCAL + HOUSE }, { 4, FOCAL + SKY, "inOutCubic" },
}

return film {
  title = "Rack focus", size = { WIDTH, HEIGHT }, fps = 24, duration = 4.5,
  frame = function(f)
    local set = { film = { WIDTH, HEIGHT }, camera = { x = 20 * f.progress, y = 0, z = 0 },
      focal = FOCAL, focus = focus:at(f.time), aperture = 26 }
    for i, plane in ipairs(planes) do set[i] = plane end
    return multiplane(set)
  end,
}
