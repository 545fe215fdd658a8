--- A house for each level of a list: its windows are lit as high as the level.
local floors = "574869357684953768459367"
local tints = { "#191230", "#201739", "#140e28" }

local function city(levels)
  local houses, lit, dark = {}, {}, {}
  for i = 1, #floors do
    local high = tonumber(floors:sub(i, i)) + 2
    houses[i] = rect { 20 * i - 20, 258 - 14 * high, 20, 14 * high + 12,
      fill = tints[i % 3 + 1] }
    for k = 0, 2 * high - 1 do
      -- two windows a floor
      local pane = rect { 20 * i - 17 + 8 * (k % 2), 248 - 14 * (k // 2), 5, 7 }
      table.insert(k // 2 + 0.5 < 1.25 * levels[i] * high and lit or dark, pane)
    end
  end
  return { cel(houses), cel { union(dark):paint "#2e2552", union(lit):paint "#ffcf6b" } }
end

local sky = linear { from = { 0, 0 }, to = { 0, 270 }, { 0, "#141a3c" },
  { 0.55, "#5a3d7c" }, { 1, "#e08a74" } }

return { city = city, sky = sky, count = #floors }
