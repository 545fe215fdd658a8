-- The three gradients as a painter's still life: radial for the balls and the shadows, linear for
-- the vase, the wall and the table, the triangle of three colours for the facets of the stone.

local function linear(x0, y0, x1, y1, ...)
  local texture = { from = { x0, y0 }, to = { x1, y1 } }
  for i, stop in ipairs { ... } do texture[i] = stop end
  return celspan.linear(texture)
end

local function shadow(x, y, w, h)
  local dark = radial { centre = { 0, 0 }, radius = w,
                        { 0, "#1a0d1ec0" }, { 0.55, "#1a0d1e66" }, { 1, "#1a0d1e00" } }
  return circle { 0, 0, w, fill = dark }:scale(1,
    h / w):translate(x, y)
end

local function ball(x, y, r, light, middle, dark, rim)
  return circle { x, y, r, fill = radial {
    centre = { x - r * 0.36, y - r * 0.42 }, radius = r * 1.5,
    { 0, light }, { 0.35, middle }, { 0.82, dark }, { 1, rim } } }
end

local vase = path {
  d = "M648 250C640 330 690 360 640 440C560 540 540 640 600 760C620 800 640 806 660 812"
    .. "Q760 832 860 812C880 806 900 800 920 760C980 640 960 540 880 440C830 360 880 330 872 250"
    .. "C800 268 720 268 648 250Z",
  fill = linear(560, 0, 960, 0, { 0, "#0f5a63" }, { 0.22, "#7fd0c4" }, { 0.36, "#2f9a97" },
                { 0.75, "#0c3f4e" }, { 1, "#175766" }) }
local mouth = ellipse { 760, 252, 112, 20, fill =
  linear(648, 0, 872, 0, { 0, "#062a35" }, { 1, "#1f6a72" }) }

--- A cut stone: facets between a crown and a point, each a triangle with a colour at each corner.
local function stone(x, y, r, turn)
  local facets = {}
  local function corner(i)
    local a = math.rad(i * 60 + turn)
    local light = 0.5 + 0.5 * math.cos(a + 2.2)
    return { x + r * math.cos(a), y - r * 0.5 + r * 0.3 * math.sin(a) }, light
  end
  local function colour(u) return mix("#3c0a4a", "#ffb3b8", u) end
  local function facet(a, b, c, ua, ub, uc)
    facets[#facets + 1] = triangle { a, b, c, fill = gradient {
      { a[1], a[2], colour(ua) }, { b[1], b[2], colour(ub) }, { c[1], c[2], colour(uc) } } }
  end
  local point, crown = { x, y + r }, { x, y - r * 0.5 }
  for i = 0, 5 do
    local a, ua = corner(i)
    local b, ub = corner(i + 1)
    if a[1] > b[1] then facet(a, b, point, ua, ub * 0.8, 0.05) end
    facet(a, b, crown, ua * 0.9, ub, 0.95)
  end
  return union(facets)
end

local wall = rect { 0, 0, 1920, 700, fill =
  linear(0, 0, 1920, 500, { 0, "#e9c9a0" }, { 0.55, "#b98273" }, { 1, "#5a3b52" }) }
local board = rect { 0, 690, 1920, 390, fill =
  linear(0, 690, 0, 1080, { 0, "#7a3f4a" }, { 0.08, "#a35a50" }, { 1, "#dd9a68" }) }

return film { frames = 48, frame = function(f)
  local turn = 60 * f.index / f.count
  return cel {
    wall, board,
    shadow(860, 815, 420, 52), vase, mouth,
    shadow(1330, 868, 330, 44), ball(1230, 700, 176, "#fff0c4", "#f2a93b", "#a2431f", "#c9673a"),
    shadow(500, 930, 230, 30), ball(420, 838, 104, "#ffd9cf", "#d9483b", "#6d1426", "#a3303a"),
    shadow(1000, 1000, 300, 30), stone(900, 852, 156, turn),
  }
end }
