-- Areas between lines, and areas that are followed: made drawings whose areas are known, and
-- refusals. With CELSPAN_VERBOSE the shares are printed, and those of a second opinion.
local celspan = require "celspan"
local ink = require "celspan.ink"
local autoclose = require "tests.support.autoclose"
local figures = require "tests.support.figures"
local inked = require "tests.support.inked"
local raises = require "tests.support.raised"
local workbench = require "tests.support.workbench"
local raised = raises.message

local W, H = inked.width, inked.height
local NOTHING = celspan.union {}
local FEW = 3 -- pixels: a gap is closed straight, where the line had been curved
local MANY = 40 -- pixels: paint ran out

local function colour_of(i) return ("#%02x%02xff"):format(i, 255 - i) end

--- The codes of a drawing, with its whole lines above what is painted.
local function codes(drawing, art)
  local rostrum = celspan.rostrum { antialias = "none",
    celspan.cel { art, inked.strokes(drawing, drawing.whole, "black") } }
  return assert(celspan.pixels(rostrum, { size = { W, H }, film = { W, H } })):bytes()
end

local function truth_of(drawing)
  local list = {}
  for i, cell in ipairs(drawing.cells) do
    local points = { fill = colour_of(i) }
    for k = 1, #cell.outline, 2 do
      points[#points + 1] = { cell.outline[k], cell.outline[k + 1] }
    end
    list[i] = celspan.polygon(points)
  end
  return celspan.union(list)
end

--- For each cell how many pixels it lacks, and how many it has beyond.
local function compare(count, truth, got)
  local lacks, beyond = {}, {}
  for i = 1, count do lacks[i], beyond[i] = 0, 0 end
  for at = 1, #truth, 4 do
    if truth:sub(at, at + 3) ~= got:sub(at, at + 3) then
      local i, k = truth:byte(at), got:byte(at)
      if truth:byte(at + 2) == 255 and lacks[i] then lacks[i] = lacks[i] + 1 end
      if got:byte(at + 2) == 255 and beyond[k] then beyond[k] = beyond[k] + 1 end
    end
  end
  return lacks, beyond
end

local GAP = 12

local function fill(drawing, lines, gap)
  local seeds = {}
  for i, cell in ipairs(drawing.cells) do seeds[i] = { cell.x, cell.y, colour_of(i) } end
  return ink.areas { lines, gap = gap, colours = seeds, fallback = NOTHING }
end

local function fill_ours(drawing)
  return fill(drawing, inked.strokes(drawing, drawing.lines), GAP)
end

--- By the second opinion's closings alone. Lines end half of their width before their ink does.
local function fill_theirs(drawing)
  local closings = autoclose(drawing.lines, GAP + drawing.line)
  return fill(drawing, inked.strokes(drawing, drawing.lines) | inked.strokes(drawing, closings), 0)
end

local function count_cell(sum, cell, lacks, beyond)
  if cell.has_door then
    sum.doors, sum.cut = sum.doors + 1, sum.cut + (lacks > FEW and 1 or 0)
  else
    sum.areas = sum.areas + 1
    sum.right = sum.right + (lacks + beyond <= FEW and 1 or 0)
  end
  sum.spilled = sum.spilled + (beyond > MANY and 1 or 0)
end

--- Fills made drawings: how many areas there are and are right, how many have paint of others
--- without an error, and how many passages there are and are cut.
local function tally(first, last, has_doors, by)
  local sum = { areas = 0, right = 0, spilled = 0, refused = 0, doors = 0, cut = 0 }
  for seed = first, last do
    local drawing = inked.make(seed, has_doors)
    local good, art = pcall(by or fill_ours, drawing)
    if not good then sum.refused, art = sum.refused + 1, NOTHING end
    local lacks, beyond = compare(#drawing.cells, codes(drawing, truth_of(drawing)),
      codes(drawing, art))
    for i, cell in ipairs(drawing.cells) do
      count_cell(sum, cell, lacks[i], beyond[i])
    end
  end
  if os.getenv "CELSPAN_VERBOSE" then
    for name, value in pairs(sum) do
      print(by and "second opinion" or "ours", has_doors and "with doors" or "plain", name, value)
    end
  end
  return sum
end

local function check(first, last)
  local sum = tally(first, last, false)
  assert.truthy(sum.right >= 0.97 * sum.areas, ("%d of %d are right"):format(sum.right, sum.areas))
  assert.equal(0, sum.spilled)
  local doors = tally(first, last, true) -- the end of a stub may take that of a wall
  assert.truthy(doors.spilled <= 0.003 * doors.areas, doors.spilled .. " areas are spilled into")
  return sum, doors
end

-- Of 300 drawings; `--all` tries all of them.
local HAS_ALL = (tonumber(os.getenv "CELSPAN_SCENES") or 0) >= 300
local SCENES = HAS_ALL and 300 or 60

describe("areas between lines", function()
  it("are those of made drawings with gaps", function() check(1, 1) end)
  it("are closed at tips with notches between pixels", function()
    assert.equal(0, tally(84, 84, false).refused)
  end)
  it("do not take in one that is near a corner of theirs", function() check(41, 41) end)
  it("are those of many made drawings, and more than by a second opinion #full", function()
    local plain, doors = check(3, 2 + SCENES)
    assert.truthy(plain.right > tally(3, 2 + SCENES, false, fill_theirs).right)
    assert.truthy(doors.right > tally(3, 2 + SCENES, true, fill_theirs).right)
  end)
end)

--- A square of lines with an opening of 9 at its lower right.
local function square()
  return celspan.stroke { width = 4, points = { { 200, 189 }, { 200, 100 }, { 100, 100 },
    { 100, 200 }, { 200, 200 } } }
end

describe("the area around a point", function()
  it("says where it runs out, and which gap closes it", function()
    local leak = ink.leak { square(), at = { 150, 150 }, gap = 6 }
    assert.near(9, leak.width, 0.5)
    assert.near(200, leak.at[1], 3)
    assert.near(193.5, leak.at[2], 2)
    assert.truthy(leak.gap >= 9 and leak.gap <= 11)
    assert.equal(nil, ink.leak { square(), at = { 150, 150 }, gap = leak.gap })
    local text = raised(ink.area, { square(), at = { 150, 150 }, gap = 6 })
    assert.truthy(text:find "the area at %(150, 150%) runs out through an opening of [%d.]+ at %(")
    assert.truthy(text:find(("gap = %g would close it"):format(leak.gap), 1, true))
  end)

  it("says so of wide openings, too", function()
    local line = celspan.stroke { width = 8, d = "M20 20H1880V1060H20V300" }
    local leak = ink.leak { line, at = { 100, 90 }, scale = 0.3 }
    assert.near(276, leak.width, 8)
    assert.truthy(leak.gap >= 268 and leak.gap <= 290)
  end)

  it("is outside where lines cover less than half of their pixels", function()
    local leak = ink.leak { square():fade(0.4), at = { 150, 150 }, scale = 0.5 }
    assert.equal("the point (150, 150) is outside: no lines go around it", leak.message)
    assert.equal(nil, leak.width)
  end)

  it("needs the memory of one gap at a time", function()
    local bench = workbench.new()
    bench:write("gaps.lua", [[
local ink = require "celspan.ink"
local line = stroke { width = 4, d = "M100 100H200V200H100Z" }
for gap = 0, 11 do assert(not ink.leak { line, at = { 150, 150 }, gap = gap, scale = 10 }) end
return film { size = { 9, 9 }, frame = function() return line end }
]])
    local code, _, text = bench:celspan_inside("render gaps.lua --hash --limit memory=48M")
    bench:remove()
    assert.equal(0, code, text)
  end)

  it("is refused on lines and outside, or what is given instead is shown", function()
    local x, y = raised(ink.area, { square(), at = { 100, 150 }, gap = 12 })
      :match "%(100, 150%) lies on a line; %((%S+), (%S+)%) is beside it"
    assert.truthy(ink.area { square(), at = { tonumber(x), tonumber(y) }, gap = 12 })
    assert.truthy(raised(ink.area, { square(), at = { 5, 5 } }):find "is outside")
    assert.truthy(raised(ink.area, { NOTHING, at = { 5, 5 } }):find "is outside")
    assert.equal(NOTHING, ink.area { square(), at = { 5, 5 }, fallback = NOTHING })
  end)

  it("may have a gap that is larger than the picture", function()
    assert.truthy(ink.area { square(), at = { 150, 150 }, gap = 5000 }:contains(150, 150))
  end)

  it("reaches to the middle of lines, or to their edge", function()
    local under = ink.area { square(), at = { 150, 150 }, gap = 12 }
    local beside = ink.area { square(), at = { 150, 150 }, gap = 12, under = false }
    assert.truthy(under:contains(100.5, 150))
    assert.falsy(under:contains(99.5, 150))
    assert.truthy(beside:contains(102.2, 150))
    assert.falsy(beside:contains(101.8, 150))
  end)

  it("is found between lines that are thin", function()
    local thin = celspan.stroke { width = 0.5, closed = true, points = { { 0, 0 }, { 900, 0 },
      { 900, 900 }, { 0, 900 } } }
    assert.truthy(ink.area { thin, at = { 450, 450 }, gap = 0 }:contains(899, 450))
    assert.truthy(raised(ink.area, { thin, at = { 450, 450 }, scale = 5 })
      :find "above 0, up to 4%.")
  end)
end)

describe("many areas", function()
  it("are refused where one has two colours", function()
    local wall = celspan.union { square(), celspan.stroke { width = 4,
      points = { { 150, 100 }, { 150, 140 } } }, celspan.stroke { width = 4,
      points = { { 150, 170 }, { 150, 200 } } } }
    local text = raised(ink.areas, { wall, gap = 12,
      colours = { { 120, 150, "red" }, { 180, 150, "blue" } } })
    assert.truthy(text:find("colours[1] and colours[2] are in one area", 1, true))
    assert.truthy(text:find "an opening of [23][09][%d.]* at %(1%d%d, 155")
    assert.truthy(text:find "gap = 3%d would close it")
    assert.truthy(ink.areas { wall, gap = 32, colours = { { 120, 150, "red" },
      { 180, 150, "blue" } } }:contains(180, 150))
  end)

  it("are refused where two points are one", function()
    assert.truthy(raised(ink.areas, { square(), gap = 12, colours = { { 150, 150, "#f00" },
      { 150, 150, "#00f" } } })
      :find("colours[1] and colours[2] are at one place: leave one of them out", 1, true))
  end)

  it("may be ten thousand", function()
    local contours, colours = {}, {}
    for i = 0, 100 do
      local at = 10 * i
      contours[2 * i + 1] = { 0, at, 0, at, 1000, at, 1000, at }
      contours[2 * i + 2] = { at, 0, at, 0, at, 1000, at, 1000 }
    end
    for i = 0, 9999 do
      colours[i + 1] = { 10 * (i % 100) + 5, 10 * (i // 100) + 5, i % 2 == 0 and "red" or "blue" }
    end
    local art = ink.areas { celspan.stroke { width = 2, contours = contours }, colours = colours,
      scale = 2 }
    assert.equal(10000, #art)
    assert.truthy(art[5050]:contains(10 * 49 + 5, 505))
  end)
end)

--- Follows made characters: how many areas there are, are right, are listed, and are wrong but not
--- listed.
local function follow_all(first, last, count)
  local sum = { areas = 0, right = 0, listed = 0, wrong = 0 }
  for seed = first, last do
    local figure = figures.make(seed, count)
    local cels, unsure = ink.follow(figure.drawings, figure.seeds, { gap = 0, scale = 1 })
    sum.listed = sum.listed + #unsure
    for k, drawing in ipairs(figure.drawings) do
      for name, cel in pairs(cels[k]) do
        local is_right = figures.part_at(drawing, cel.at[1], cel.at[2]) == name
        sum.areas = sum.areas + 1
        sum.right = sum.right + (cel.object and is_right and 1 or 0)
        sum.wrong = sum.wrong + (cel.object and not is_right and 1 or 0)
        assert.truthy(not cel.object or cel.object:contains(cel.at[1], cel.at[2]))
      end
    end
  end
  if os.getenv "CELSPAN_VERBOSE" then
    for name, value in pairs(sum) do print("followed", name, value) end
  end
  assert.equal(sum.areas, sum.right + sum.listed)
  assert.equal(0, sum.wrong)
  assert.truthy(sum.right >= 0.95 * sum.areas, ("%d of %d are right"):format(sum.right, sum.areas))
end

--- A box with a small circle in it, moved.
local function box(x)
  return celspan.stroke { width = 4, closed = true, points = { { x, 100 }, { x + 200, 100 },
    { x + 200, 220 }, { x, 220 } } }
    | celspan.stroke { width = 4,
      d = ("M%d 160a20 20 0 1 0 40 0a20 20 0 1 0 -40 0"):format(x + 40) }
end

local SEEDS = { face = { 250, 160, "red" }, eye = { 160, 160, "blue" } }

describe("followed areas", function()
  it("of made characters are named, or listed", function() follow_all(1, 1, 6) end)
  it("of twenty made characters are named, or listed #full", function()
    follow_all(1, HAS_ALL and 20 or 2, 24)
  end)

  it("have the paint of their seeds", function()
    local cels, unsure = ink.follow({ [3] = box(100), [7] = box(130) }, SEEDS)
    assert.equal(0, #unsure)
    assert.truthy(cels[7].eye.object:contains(190, 160))
    assert.truthy(cels[7].face.object:contains(320, 160))
    assert.falsy(cels[7].face.object:contains(190, 160))
    local codes_of = celspan.pixels(celspan.rostrum { celspan.cel { cels[7].face.object } },
      { size = { 400, 300 }, film = { 400, 300 } }):bytes()
    local at = 4 * (160 * 400 + 280)
    assert.equal("\255\0\0\255", codes_of:sub(at + 1, at + 4))
  end)

  it("that are not there are listed, and found later", function()
    local without = celspan.stroke { width = 4, closed = true,
      points = { { 110, 100 }, { 310, 100 }, { 310, 220 }, { 110, 220 } } }
    local cels, unsure = ink.follow({ box(100), without, NOTHING, box(120) }, SEEDS,
      { fallback = NOTHING })
    assert.same({ 2, 3, 3 }, { unsure[1].drawing, unsure[2].drawing, unsure[3].drawing })
    assert.equal("eye", unsure[1].name)
    assert.near(170, unsure[1].at[1], 12)
    assert.equal(NOTHING, cels[2].eye.object)
    assert.equal(0, cels[3].face.sure)
    assert.truthy(cels[4].eye.object:contains(180, 160) and cels[4].eye.sure >= 0.5)
  end)

  it("are refused where the first drawing has none", function()
    local function of(seeds, drawings)
      return function() ink.follow(drawings or { box(100) }, seeds) end
    end
    raises.each {
      ["drawings[1]: seeds.a: the point (140, 160) lies on a line"] = of { a = { 140, 160 } },
      ["drawings[1]: seeds.a: the point (5, 5) is outside"] = of { a = { 5, 5 } },
      ["drawings[2]: seeds.a: the point (5, 5) is outside"] = of({ a = { 5, 5 } },
        { [2] = NOTHING }),
      ["seeds.a and seeds.b are in one area"] = of { a = { 250, 160 }, b = { 260, 160 } },
      ["takes one or more seeds {x, y [, paint]} by name"] = of {},
      ["follow takes one or more seeds {x, y [, paint]} by name"] = of { { 250, 160 } },
      ["seeds.a must be {x, y [, paint]}"] = of { a = 5 },
      ["takes lines of one or more drawings by number"] = of(SEEDS, {}),
      ["follow takes lines of one or more drawings by number"] = of(SEEDS, { box(100),
        ["1"] = box(100) }),
      ["drawings[2]: lines must be an object, or a drawing with one"] = of(SEEDS,
        { box(100), false }),
      ["drawings[2]: "] = of(SEEDS, { box(100), celspan.rect { 0, 0, 9, 9,
        texture = celspan.picture { file = "no/such.png" } } }),
    }
  end)
end)
