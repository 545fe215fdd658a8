-- The plan of the town: the positions of its houses, and their parts. The painter draws the houses
-- of this plan, and the film lights their windows.
local house = require "film.house"

local plan = {}

plan.LEFT, plan.TOP, plan.WIDTH, plan.HEIGHT = -320, -560, 2560, 1760
plan.MIDDLE = 1000

local WALLS = { { "#7774bb", "#55529c" }, { "#8673b4", "#5e4c92" }, { "#6a78bc", "#48559a" },
                { "#9079b0", "#665089" }, { "#7f86c6", "#5a60a6" } }

--- The ground of row r at x: 1 is the highest, 5 the street at the bottom, 6 is hidden by the bank.
function plan.ground(r, x)
  local off = (x - plan.MIDDLE) / 1000
  local steep = ({ 330, 300, 235, 150, 40, 20 })[r]
  local level = ({ 560, 618, 694, 790, 905, 1080 })[r]
  return level + steep * off * off + 7 * math.sin(x / 61 + 2 * r) * (r < 5 and 1 or 0.5)
end

--- Rows of houses: the extent to both sides, the width of a house, the space between two.
local rows = {
  { reach = 330, width = 62, gap = 6 }, { reach = 520, width = 74, gap = 10 },
  { reach = 760, width = 92, gap = 20 }, { reach = 1080, width = 116, gap = 44 },
}

local function windows_of(random)
  local kinds = {
    { { 0.5, at = 1.08 }, { 0.28, 0.72, at = 0.62 } },
    { { 0.3, 0.7, at = 0.8 }, { 0.7, at = 0.36 } },
    { { 0.5, at = 0.95 }, { 0.3, 0.7, at = 0.5 } },
    { { 0.32, 0.68, at = 0.66 } },
  }
  return kinds[random("kind", #kinds)]
end

--- The x at which the road up the hill crosses row r, which may be a fraction.
function plan.road(r) return plan.MIDDLE + 60 + 110 * math.sin(r * 1.9) end

--- Whether something at x, w wide, may stand in row r: not in the church, nor on the road.
local function is_free(r, x, w)
  if r == 1 then return math.abs(x + w / 2 - plan.MIDDLE) >= 40 end
  local road = plan.road(r)
  return x >= road + 34 or x + w <= road - 34
end

--- House i of row r, w wide, at x.
local function settle(r, i, x, w, random)
  local y = plan.ground(r, x + w / 2) + 4
  local height = w * (0.75 + 0.5 * random "height")
  local object, panes = house.draw("town" .. r .. "." .. i, x, y, w, height, {
    wall = WALLS[random("wall", #WALLS)], rise = w * (0.42 + 0.22 * random "rise"),
    lean = 5 * (random "lean" - 0.5), rows = windows_of(random), window = 0.17, frame = "#3a3870",
    chimney = random "smoke" < 0.6 and 0.2 + 0.5 * random "chimney" })
  return { row = r, object = object, panes = panes, x = x + w / 2, y = y - w * 0.4, width = w }
end

--- All houses, rearmost row first: { row =, object =, panes =, x =, y =, width = }.
local function settle_all()
  local list = {}
  for r, row in ipairs(rows) do
    local x, i = plan.MIDDLE - row.reach, 0
    while x < plan.MIDDLE + row.reach do
      i = i + 1
      local random = celspan.random(("house %d %d"):format(r, i))
      local w = row.width * (0.82 + 0.4 * random "width")
      if is_free(r, x, w) and random "bare" > 0.1 then
        list[#list + 1] = settle(r, i, x, w, random)
      end
      x = x + w + row.gap * (0.4 + 1.2 * random "gap")
    end
  end
  return list
end

--- The church at the top: its tower, its spire, and a round window.
local function church()
  local x, y = plan.MIDDLE - 4, plan.ground(1, plan.MIDDLE) + 6
  local wall = linear { from = { x - 30, 0 }, to = { x + 34, 0 }, { 0, "#8a80c2" },
    { 1, "#5c5298" } }
  local tower = polygon { { x - 26, y }, { x - 24, y - 150 }, { x + 24, y - 150 },
    { x + 26, y }, fill = wall }
  local spire = polygon { { x - 32, y - 146 }, { x, y - 290 }, { x + 32, y - 146 },
    fill = "#4a4590" }
  local snow = polygon { { x - 34, y - 144 }, { x, y - 292 }, { x + 4, y - 250 },
    { x - 12, y - 176 }, { x - 6, y - 144 },
    fill = "#dfe4fb" }
  local nave, panes = house.draw("nave", x + 18, y, 84, 64,
    { wall = WALLS[2], rise = 46, rows = { { 0.3, 0.7, at = 0.72 } },
    window = 0.16, frame = "#3a3870" })
  local rose = circle { x, y - 112, 11, fill = "#2c3370" }
  local door = path { fill = "#2c3370",
    d = ("M%g %gv-22a9 9 0 0 1 18 0v22z"):format(x - 9, y - 44) }
  panes[#panes + 1], panes[#panes + 2] = rose, door
  local star = circle { x, y - 296, 4, fill = "#8a7a70" }
  return { row = 1, object = union { nave, tower, spire, snow, rose, door, star },
    panes = panes, x = x, y = y - 90,
    width = 90 }
end

plan.houses = settle_all()
table.insert(plan.houses, 1, church())

--- Lamps: {x, y of the foot, scale}. The first is the one of the story, the second stands where the
--- road goes up between the houses, the others along the street.
local bend = plan.road(4) + 22
plan.lamps = { { 1236, 925, 0.17 }, { bend, plan.ground(4, bend) + 10, 0.138 } }
for i, x in ipairs { 640, 330, 1640, 1900 } do
  plan.lamps[#plan.lamps + 1] = { x, plan.ground(5, x) + 14 + i % 2 * 6, 0.165 }
end

return plan
