--- A street at night after rain: houses, a shop, lamps, and all of it again in the wet stones.
local W, GROUND = 480, 206
local sky = rect { 0, 0, W, 270, fill = linear { from = { 0, 0 }, to = { 0, GROUND },
  { 0, "#101a33" }, { 1, "#2b3a5c" } } }

--- A house: its wall and roof, and its windows, of which some are lit.
local function house(x, width, eaves, wall, seed)
  local chance, parts, lit = random(seed), {}, {}
  parts[1] = rect { x, eaves, width, GROUND - eaves, fill = wall }
  parts[2] = polygon { { x - 5, eaves }, { x + width * 0.2, eaves - 26 },
    { x + width * 0.8, eaves - 26 }, { x + width + 5, eaves }, fill = "#141a2e" }
  for row = 0, (GROUND - eaves - 84) // 34 do
    for column = 0, width // 34 - 1 do
      local pane = rect { x + 12 + column * (width - 14) / (width // 34), eaves + 12 + 34 * row,
        14, 20, radius = 1 }
      local is_lit = chance(10 * row + column) < 0.4
      lit[#lit + 1] = is_lit and pane:paint "#ffcf7d" or nil
      parts[#parts + 1] = pane:paint "#18203a"
    end
  end
  return union(parts), union(lit)
end

local first, first_lit = house(-20, 120, 62, "#32405f", "first")
local second, second_lit = house(100, 106, 92, "#3d3c5a", "second")
local third, third_lit = house(206, 150, 44, "#2d3a56", "third")
local fourth, fourth_lit = house(356, 140, 80, "#423f5b", "fourth")

local shop = rect { 222, 146, 118, 60, fill = "#1a2238" } | rect { 228, 154, 76, 46,
  fill = "#ffd890" } | rect { 312, 154, 22, 52, fill = "#f2b865" }
  | rect { 264, 154, 3, 46, fill = "#1a2238" }
local awning = path { d = "M216 140 H346 L352 156 H210 Z", fill = "#b8404a" }
local goods = union { circle { 242, 194, 6, fill = "#a34d2d" }, circle { 254, 193, 7, fill =
  "#7e3a28" }, rect { 274, 184, 9, 16, fill = "#8a5030" }, rect { 287, 188, 9, 12, fill =
  "#6f3d2a" } }

local function lamp(x, foot, size)
  local post = rect { -2.5, -118, 5, 118, fill = "#0d1220" } | rect { -7, -6, 14, 6, fill =
    "#0d1220" } | path { d = "M-12 -138 H12 L7 -118 H-7 Z M-14 -140 L0 -152 L14 -140 Z",
    fill = "#0d1220" }
  local flame = path { d = "M-10 -137 H10 L6 -119 H-6 Z", fill = "#fff3d2" }
  return (post | flame):scale(size):translate(x, foot)
end

local back = union { sky, first, first_lit, second, second_lit, third, third_lit, fourth,
  fourth_lit, shop, goods, awning, lamp(80, 212, 0.8), lamp(404, 218, 1) }
local wet = clip(back:scale(1, -0.8, 0, GROUND), rect { 0, GROUND, W, 64 })
local stones = rect { 0, GROUND, W, 64, fill = "#131a2d" }
local kerb = rect { 0, GROUND, W, 3, fill = "#46506b" }
local still = group { back, stones, wet:blur(2.5):fade(0.4), kerb }

--- A walker under an umbrella, with a bag; `step` is a share of two steps.
local function walker(step)
  local swing = math.sin(2 * math.pi * step)
  local lift = 2 * math.abs(math.cos(2 * math.pi * step))
  local function leg(side)
    local foot, rise = 24 * side, math.cos(2 * math.pi * step) * (side < 0 and 10 or -10)
    local up = math.max(0, rise) * (1 - math.abs(side))
    local hip, knee = { 0, -60 }, { foot * 0.5 + 4, -31 - up / 2 }
    return stroke { points = { hip, knee, { foot, -5 - up } }, width = 13, cap = "round",
      join = "round", fill = "#1d2133" }
      | path { d = "M-7 -7 H6 L15 0 H-7 Z", fill = "#12151f" }:translate(foot, -up)
  end
  local coat = path { fill = "#2b3046",
    d = "M-12 -118 C-22 -90 -24 -66 -28 -40 Q-2 -34 24 -40 C20 -74 18 -94 12 -118 Z" }
  local head = circle { 2, -130, 11, fill = "#54413f" }
    | path { d = "M-12 -133 C-12 -148 14 -148 15 -134 Z M-12 -135 H20 V-132 H-12 Z",
      fill = "#1c2032" }
  local arm = stroke { d = "M-2 -108 C6 -92 14 -88 24 -100", width = 9, cap = "round",
    fill = "#252a3f" }
  local umbrella = stroke { d = "M24 -98 L18 -176", width = 3, fill = "#14171f" }
    | path { d = "M-42 -146 C-36 -196 62 -202 76 -158 Q66 -164 56 -156 Q44 -162 32 -153 Q18"
      .. " -158 6 -150 Q-8 -154 -18 -146 Q-30 -150 -42 -146 Z", fill = "#8e2f3c" }
  local bag = stroke { d = "M-8 -104 L-17 -70", width = 2.5, fill = "#14171f" }
    | rect { -32, -74, 24, 22, radius = 4, fill = "#6b4a33" }
  return union { leg(-swing), leg(swing), union { coat, head, arm, umbrella, bag }
    :translate(0, lift) }
end

return { still = still, walker = walker }
