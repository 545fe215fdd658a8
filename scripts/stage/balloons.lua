local function view(sky, ground, art)
  -- a composition is an object like any other
  return rostrum { size = { 480, 270 }, cel {
    rect { 0, 0, 480, 270, fill = sky },
    path { d = "M0 226 C120 196 260 206 480 222 V270 H0 Z", fill = ground },
    art } }
end

local function balloon(one, other)
  local bag = path {
    d = "M0 54 C-14 34 -50 14 -50 -22 C-50 -82 50 -82 50 -22 C50 14 14 34 0 54 Z",
    fill = one }
  local stripe = clip(ellipse { 0, -14, 18, 74, fill = other }, bag)
  return bag
    | stripe
    | stroke { d = "M-11 44 L-8 62 M11 44 L8 62", width = 1.6, fill = "#5b4636" }
    | rect { -11, 60, 22, 17, radius = 4, fill = "#8a5a34" }
end

return { view = view, balloon = balloon }
