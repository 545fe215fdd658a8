--- The display font of the scripts: heavy letters of stems and bars with round corners, which
--- become as narrow or as broad as a title needs, while their stems stay nearly as heavy.
---
---   lua5.4 tests/support/poster.lua OUT.ttf     scripts/type/poster.ttf is what it makes
---
--- A letter is a list of parts. "T": a tube that turns at right angles through points x,y, where a
--- point with a "!" is a sharp corner, and "O": the same, closed. "P": a polygon. x is written as
--- a*w + b*S: a share of the letter's width and of a stem, such as w-.5S; y counts from the
--- baseline, in thousandths of an em, or in bars: 700-.5H. Contours overlap, as those of block.lua.
package.path = "./?.lua;" .. package.path
local truetype = require "tests.support.truetype"
local block = require "tests.support.block"

-- ---------------------------------------------------------------- letters
-- How broad, as a share of O; room at both sides; parts. l, r, c: middles of the left and of the
-- right stem, and of the letter; t, m, b: middles of the bars at the top, in the middle, below.

local capitals = {
  A = { 1.06, 8, "P 0,0 .5w-.55S,700 .5w+.55S,700 S,0", "P w,0 .5w+.55S,700 .5w-.55S,700 w-S,0",
    "P .22w,130 .22w,225 .78w,225 .78w,130" },
  B = { 1, 30, "T l,0 l,700", "T c,t r-.04S,t r-.04S,m c,m", "T c,m r,m r,b c,b",
    "P .5S,700 .5S,700-H .5w,700-H .5w,700", "P .5S,350+.5H .5S,350-.5H .5w,350-.5H .5w,350+.5H",
    "P .5S,H .5S,0 .5w,0 .5w,H" },
  C = { 1, 26, "T r,450 r,t l,t l,b r,b r,250" },
  D = { 1, 30, "O l,t! r,t r,b l,b!" },
  E = { 0.82, 30, "T w,t l,t! l,b! w,b", "T l,m .92w,m" },
  F = { 0.8, 30, "T w,t l,t! l,0", "T l,m .92w,m" },
  G = { 1, 26, "T r,470 r,t l,t l,b r,b! r,370-.5H! .52w,370-.5H" },
  H = { 1, 30, "T l,0 l,700", "T r,0 r,700", "T l,m r,m" },
  I = { 0, 30, "T l,0 l,700" },
  J = { 0.8, 22, "T r,700 r,b l,b l,230" },
  K = { 1.02, 30, "T l,0 l,700", "P 0,170 .2w+.42S,170 w+.05S,700 .8w-.37S,700",
    "P .3w-.25S,330 .5w+.12S,330 w+.06S,0 .8w-.42S,0" },
  L = { 0.8, 30, "T l,700 l,b! w,b" },
  M = { 1.5, 30, "T l,0 l,700", "T r,0 r,700", "P 0,700 S,700 .5w+.42S,90 .5w-.42S,90",
    "P w,700 w-S,700 .5w-.42S,90 .5w+.42S,90" },
  N = { 1.06, 30, "T l,0 l,700", "T r,0 r,700", "P 0,700 S,700 w,0 w-S,0" },
  O = { 1, 26, "O l,t r,t r,b l,b" },
  P = { 1, 30, "T l,0 l,700", "T l,t r,t r,330-.5H l,330-.5H" },
  Q = { 1, 26, "O l,t r,t r,b l,b", "P .46w,190 .46w+.8S,190 w+.12S,-70 w-.7S,-70" },
  R = { 1, 30, "T l,0 l,700", "T l,t r,t r,m l,m", "P .3w,340 .3w+S,340 w+.04S,0 w-S,0" },
  S = { 1, 24, "T r,490 r,t l,t l,m r,m r,b l,b l,210" },
  T = { 0.9, 8, "T 0,t w,t", "T c,0 c,700" },
  U = { 1, 28, "T l,700 l,b r,b r,700" },
  V = { 1.06, 8, "P 0,700 .5w-.55S,0 .5w+.55S,0 S,700", "P w,700 .5w+.55S,0 .5w-.55S,0 w-S,700" },
  W = { 1.62, 8, "P 0,700 .28w-.5S,0 .28w+.5S,0 S,700",
    "P .28w-.5S,0 .28w+.5S,0 .5w+.5S,640 .5w-.5S,640",
    "P .72w-.5S,0 .72w+.5S,0 .5w+.5S,640 .5w-.5S,640", "P w,700 .72w+.5S,0 .72w-.5S,0 w-S,700" },
  X = { 1.04, 8, "P 0,700 .1w+.8S,700 w,0 .9w-.8S,0",
    "P w,700 .9w-.8S,700 0,0 .1w+.8S,0" },
  Y = { 1.04, 2, "P 0,700 1.06S,700 .5w+.5S,250 .5w-.5S,250",
    "P w,700 w-1.06S,700 .5w-.5S,250 .5w+.5S,250", "T c,0 c,260" },
  Z = { 0.92, 18, "T .02w,t w,t", "T 0,b w,b", "P w,700-H .92w-.9S,700-H 0,H .08w+.9S,H" },
}

local small = {
  a = { 0.92, 22, "T .05w,x r,x r,0", "T r,312-.5h l,312-.5h l,d r,d" },
  b = { 0.94, 26, "T l,0 l,700", "O l,x! r,x r,d l,d!" },
  c = { 0.9, 24, "T r,350 r,x l,x l,d r,d r,180" },
  d = { 0.94, 26, "T r,0 r,700", "O l,x r,x! r,d! l,d" },
  e = { 0.92, 24, "T l+.3S,e r,e! r,x l,x l,d r,d r,165" },
  f = { 0.56, 10, "T w,700-.5h l+.3S,700-.5h l+.3S,0", "T -.1S,x w,x" },
  g = { 0.94, 26, "O l,x r,x! r,d! l,d", "T r,520 r,-170+.5h .05w,-170+.5h" },
  h = { 0.94, 28, "T l,0 l,700", "T l,x! r,x r,0" },
  i = { 0, 28, "T l,0 l,520", "T l,585 l,705" },
  j = { 0, 28, "T l,520 l,-170+.5h -.45S,-170+.5h", "T l,585 l,705" },
  k = { 0.94, 28, "T l,0 l,700", "P 0,120 .2w+.42S,120 w+.03S,520 .8w-.39S,520",
    "P .3w-.22S,240 .5w+.12S,240 w+.06S,0 .8w-.42S,0" },
  l = { 0, 28, "T l,0 l,700" },
  m = { 1.66, 28, "T l,0 l,520", "T l,x! c,x c,0", "T l,x! r,x r,0" },
  n = { 0.94, 28, "T l,0 l,520", "T l,x! r,x r,0" },
  o = { 0.94, 24, "O l,x r,x r,d l,d" },
  p = { 0.94, 26, "T l,-170 l,520", "O l,x! r,x r,d l,d!" },
  q = { 0.94, 26, "T r,-170 r,520", "O l,x r,x! r,d! l,d" },
  r = { 0.44, 24, "T l,0 l,520", "T l,x! w,x" },
  s = { 0.86, 20, "T r,385 r,x l,x l,e r,e r,d l,d l,140" },
  t = { 0.6, 10, "T l+.3S,640 l+.3S,d w,d", "T -.1S,x w,x" },
  u = { 0.94, 28, "T r,520 r,0", "T l,520 l,d r,d!" },
  v = { 0.92, 2, "P 0,520 .5w-.5S,0 .5w+.5S,0 S,520", "P w,520 .5w+.5S,0 .5w-.5S,0 w-S,520" },
  w = { 1.5, 2, "P 0,520 .28w-.46S,0 .28w+.46S,0 .94S,520",
    "P .28w-.46S,0 .28w+.46S,0 .5w+.44S,470 .5w-.44S,470",
    "P .72w-.46S,0 .72w+.46S,0 .5w+.44S,470 .5w-.44S,470",
    "P w,520 .72w+.46S,0 .72w-.46S,0 w-.94S,520" },
  x = { 0.92, 2, "P 0,520 .16w+.62S,520 w,0 .84w-.62S,0",
    "P w,520 .84w-.62S,520 0,0 .16w+.62S,0" },
  y = { 0.94, 28, "T r,520 r,-170+.5h .05w,-170+.5h", "T l,520 l,d r,d!" },
  z = { 0.84, 16, "T .02w,x w,x", "T 0,d w,d", "P w,520-h .82w-.63S,520-h 0,h .18w+.63S,h" },
  ["ı"] = { 0, 28, "T l,0 l,520" },
}

local signs = {
  ["0"] = { 1, 24, "O l,t r,t r,b l,b" },
  ["1"] = { 0.34, 22, "T r,0 r,700", "P w-.5S,700 w-.5S,700-1.1H -.2S,560-H -.2S,560" },
  ["2"] = { 0.96, 22, "T l,500 l,t r,t r,m l,m l,b! w,b" },
  ["3"] = { 0.98, 22, "T l,500 l,t r,t r,m .4w,m", "T .4w,m r,m r,b l,b l,200" },
  ["4"] = { 1.04, 10, "T r-.25S,0 r-.25S,700", "T 0,215-.5H w+.04S,215-.5H",
    "P 0,215 1.1S,215 w-.75S,700 w-1.75S,700" },
  ["5"] = { 0.98, 24, "T .97w,t l,t! l,430-.5H! r,430-.5H r,b l,b l,190" },
  ["6"] = { 1, 24, "T r,500 r,t l,t l,b r,b r,400-.5H l,400-.5H" },
  ["7"] = { 0.88, 10, "T 0,t w,t", "P w,700-H w-1.05S,700-H .16w,0 .16w+1.05S,0" },
  ["8"] = { 1, 22, "O l+.03S,t r-.03S,t r-.03S,m l+.03S,m", "O l,m r,m r,b l,b" },
  ["9"] = { 1, 24, "T l,200 l,b r,b r,t l,t l,300+.5H r,300+.5H" },
  ["."] = { 0, 26, "T l,0 l,130" },
  [","] = { 0, 26, "P 0,130 S,130 S,0 .5S,-130 0,-130 .3S,0 0,0" },
  [":"] = { 0, 26, "T l,0 l,130", "T l,350 l,480" },
  [";"] = { 0, 26, "P 0,130 S,130 S,0 .5S,-130 0,-130 .3S,0 0,0", "T l,350 l,480" },
  ["!"] = { 0, 28, "P -.04S,700 1.04S,700 .84S,190 .16S,190", "T l,0 l,130" },
  ["?"] = { 0.94, 16, "T l,500 l,t r,t r,370-.5H c,370-.5H! c,190", "T c,0 c,130" },
  ["-"] = { 0.5, 20, "T 0,m w,m" }, ["–"] = { 0.9, 20, "T 0,m w,m" },
  ["—"] = { 1.8, 10, "T 0,m w,m" },
  ["'"] = { 0, 22, "P 0,700 S,700 .8S,460 .2S,460" },
  ["\""] = { 0.55, 22, "P 0,700 .8S,700 .64S,460 .16S,460",
    "P w,700 w-.8S,700 w-.64S,460 w-.16S,460" },
  ["’"] = { 0, 22, "P 0,700 S,700 S,570 .5S,440 0,440 .3S,570 0,570" },
  ["‘"] = { 0, 22, "P S,440 0,440 0,570 .5S,700 S,700 .7S,570 S,570" },
  ["("] = { 0.45, 20, "T w,t+40 l,t+40 l,b-40 w,b-40" },
  [")"] = { 0.45, 20, "T 0,t+40 r,t+40 r,b-40 0,b-40" },
  ["/"] = { 0.7, 4, "P 0,-40 .9S,-40 w,740 w-.9S,740" },
  ["+"] = { 0.95, 22, "T 0,m w,m", "T c,130 c,570" }, ["−"] = { 0.95, 22, "T 0,m w,m" },
  ["="] = { 0.95, 22, "T 0,450 w,450", "T 0,250 w,250" },
  ["×"] = { 0.9, 18, "P 0,520 .2w+.42S,520 w,180 .8w-.42S,180",
    "P w,520 .8w-.42S,520 0,180 .2w+.42S,180" },
  ["%"] = { 2.5, 16, "O l,t .44w-.5S,t .44w-.5S,330 l,330",
    "O .56w+.5S,370 r,370 r,b .56w+.5S,b",
    "P .5w-.25w,0 .5w-.25w+.8S,0 .75w,700 .75w-.8S,700" },
  ["&"] = { 1.1, 16, "T w+.1S,m l,m l,b r-.25S,b r-.25S,m",
    "T .5w,m l+.12S,m l+.12S,t r-.35S,t r-.35S,530" },
  ["#"] = { 1.2, 16, "T 0,470 w,470", "T 0,230 w,230", "T .3w,0 .3w,700", "T .7w,0 .7w,700" },
  ["*"] = { 0.7, 16, "T c,400 c,700", "P 0,640 .3S,690 w,460 w-.3S,410",
    "P w,640 w-.3S,690 0,460 .3S,410" },
  ["…"] = { 2.2, 26, "T l,0 l,130", "T c,0 c,130", "T r,0 r,130" },
  ["·"] = { 0, 26, "T l,285 l,415" },
  ["→"] = { 1.7, 20, "T 0,m w-.6S,m", "P w+.1S,350 w-1.3S,610 w-1.3S,90" },
  ["€"] = { 1.06, 20, "T r,470 r,t l+.2S,t l+.2S,b r,b r,230", "T -.2S,415 .7w,415",
    "T -.2S,275 .64w,275" },
  ["$"] = { 1, 22, "T r,490 r,t l,t l,m r,m r,b l,b l,210", "T c,680 c,780", "T c,20 c,-80" },
  ["Æ"] = { 1.6, 8, "P 0,0 .55w-.9S,700 .55w+.1S,700 S,0", "T w,t .55w,t! .55w,b! w,b",
    "T .55w,m .96w,m", "P .2w,130 .2w,225 .55w,225 .55w,130" },
  ["Ø"] = { 1, 26, "O l,t r,t r,b l,b", "P -.1S,-30 .07w+.2S,-30 w+.1S,730 .93w-.2S,730" },
  ["ø"] = { 0.94, 24, "O l,x r,x r,d l,d", "P -.1S,-30 .07w+.2S,-30 w+.1S,550 .93w-.2S,550" },
  ["ß"] = { 1, 26, "T l,0 l,700-.5h r-.1S,700-.5h r-.1S,390-.5h c,390-.5h",
    "T c,390-.5h r,390-.5h r,d .48w,d" },
}

--- Accents, drawn about x = 0 from y = 0 upwards, and the letters that bear them: the capital, and
--- its two accented forms.
local accents = {
  { "P -40,0 60,0 140,150 -10,150", "AÁá CĆć EÉé IÍí NŃń OÓó SŚś UÚú YÝý ZŹź" },
  { "P 40,0 -60,0 -140,150 10,150", "AÀà EÈè IÌì OÒò UÙù" },
  { "P -150,0 -50,0 0,70 50,0 150,0 60,140 -60,140", "AÂâ EÊê IÎî OÔô UÛû" },
  { "P -150,140 -50,140 0,70 50,140 150,140 60,0 -60,0", "CČč DĎď EĚě NŇň RŘř SŠš TŤť ZŽž" },
  { "P -150,0 -30,0 -30,120 -150,120", "P 30,0 150,0 150,120 30,120",
    "AÄä EËë IÏï OÖö UÜü YŸÿ" },
  { "P -160,10 -160,110 -40,140 60,95 160,125 160,25 40,0 -60,45", "AÃã NÑñ OÕõ" },
  { "P -130,10 130,10 130,105 -130,105", "AĀā EĒē IĪī OŌō UŪū" },
  { "P -130,0 -40,0 20,150 -100,150", "P 20,0 110,0 170,150 50,150", "OŐő UŰű" },
  { "P -65,0 65,0 65,120 -65,120", "CĊċ EĖė GĠġ ZŻż" },
  { "O -60,125 60,125 60,25 -60,25", "AÅå UŮů" },
  { "P -50,-20 50,-20 40,-80 10,-170 -90,-170 -50,-80", "CÇç SŞş TŢţ", is_below = true },
  { "P 60,0 110,0 50,-90 130,-90 130,-160 -30,-160 -30,-80", "AĄą EĘę", is_below = true },
}

local kerning = { { "A", "T", -60 }, { "A", "V", -70 }, { "A", "W", -60 }, { "A", "Y", -70 },
  { "F", "A", -60 }, { "L", "T", -70 }, { "L", "V", -70 }, { "L", "Y", -70 }, { "P", "A", -60 },
  { "T", "A", -60 }, { "T", "a", -50 }, { "T", "e", -50 }, { "T", "o", -50 }, { "V", "A", -70 },
  { "W", "A", -60 }, { "Y", "A", -70 }, { "Y", "o", -50 } }

-- ---------------------------------------------------------------- tubes

--- The three forms of a letter: the width of O, of a stem, and of a bar of capitals and of small
--- letters.
local forms = {
  least = { o = 296, stem = 110, bar = 100, low = 88 },
  contours = { o = 430, stem = 142, bar = 112, low = 98 },
  most = { o = 960, stem = 168, bar = 122, low = 108 },
}

local function rounded(x) return math.floor(x + 0.5) end

--- A number such as "w-.5S" or "700-.5H": the sum of its parts.
local function number_of(text, units)
  local sum = 0
  for sign, factor, unit in text:gmatch "([+-]?)([%d.]*)(%a?)" do
    if factor ~= "" or unit ~= "" then
      local value = (tonumber(factor) or 1) * (unit == "" and 1 or units[unit])
      sum = sum + (sign == "-" and -value or value)
    end
  end
  return sum
end

local function units_of(form, width)
  local s, h, l = form.stem, form.bar, form.low
  return { w = width, S = s, H = h, h = l, l = s / 2, r = width - s / 2, c = width / 2,
    t = 700 - h / 2, m = 350, b = h / 2, x = 520 - l / 2, e = 266, d = l / 2 }
end

--- The points of a part, with `is_sharp` where they have a "!".
local function points_of(part, units)
  local points = {}
  for x, y, mark in part:sub(2):gmatch "([^%s,]+),([^%s!]+)(!?)" do
    points[#points + 1] = { number_of(x, units), number_of(y, units), is_sharp = mark == "!" }
  end
  return points
end

local function area_of(contour)
  local sum, last = 0, contour[#contour]
  for _, p in ipairs(contour) do
    sum, last = sum + last[1] * p[2] - p[1] * last[2], p
  end
  return sum
end

local function reversed(contour)
  local back = {}
  for i = #contour, 1, -1 do back[#back + 1] = contour[i] end
  return back
end

--- A contour in whole numbers, clockwise if it is solid.
local function whole(contour, is_hole)
  local points = {}
  for i, p in ipairs(contour) do points[i] = { rounded(p[1]), rounded(p[2]), p[3] ~= false } end
  return (area_of(contour) > 0) == not is_hole and reversed(points) or points
end

local function sign_of(x) return x > 0.01 and 1 or x < -0.01 and -1 or 0 end

--- How far a round corner may reach along a line of a tube, `thick` across: to the end of the line,
--- or to its middle, if the next corner is round as well.
local function room_of(corner, next_one, is_end, thick, axis)
  local long = math.abs(next_one[axis] - corner[axis])
  if is_end then return long + thick / 2 end
  return next_one.is_sharp and long or (long + thick) / 2
end

--- The reach of a corner of a tube, along x and along y.
local function reach_of(points, i, is_closed, width, height, most)
  local count, reach = #points, { most[1], most[2] }
  for _, k in ipairs { (i - 2) % count + 1, i % count + 1 } do
    local axis = math.abs(points[k][2] - points[i][2]) > 0.01 and 2 or 1
    local is_end = not is_closed and (k == 1 or k == count)
    local room = room_of(points[i], points[k], is_end, axis == 1 and width or height, axis)
    reach[axis] = math.min(reach[axis], room)
  end
  return reach
end

--- One side of a tube through its points: 1 is left of the way, -1 right of it.
local function side_of(points, side, is_closed, width, height, most)
  local line, count = {}, #points
  for i, p in ipairs(points) do
    local before = points[i - 1] or is_closed and points[count]
    local after = points[i + 1] or is_closed and points[1]
    local ax, ay = sign_of(p[1] - (before or p)[1]), sign_of(p[2] - (before or p)[2])
    local bx, by = sign_of((after or p)[1] - p[1]), sign_of((after or p)[2] - p[2])
    local x = p[1] - side * (ay + by) * width / 2
    local y = p[2] + side * (ax + bx) * height / 2
    local turn = ax * by - ay * bx -- 1: to the left
    if turn == 0 or p.is_sharp then
      line[#line + 1] = { x, y }
    else
      local reach = reach_of(points, i, is_closed, width, height, most)
      local is_inner = turn == side
      local rx = is_inner and math.max(reach[1] - width, 12) or reach[1]
      local ry = is_inner and math.max(reach[2] - height, 12) or reach[2]
      line[#line + 1] = { x - ax * rx, y - ay * ry }
      line[#line + 1] = { x, y, false }
      line[#line + 1] = { x + bx * rx, y + by * ry }
    end
  end
  return line
end

--- The contours of a letter's parts.
local function draw(parts, first, form, units, bar)
  local contours = {}
  for i = first, #parts do
    local kind, points = parts[i]:sub(1, 1), points_of(parts[i], units)
    local reach = { math.min(units.w / 2, 250), math.min(bar == form.bar and 196 or 176, 196) }
    if kind == "P" then
      contours[#contours + 1] = whole(points)
    else
      local left = side_of(points, 1, kind == "O", form.stem, bar, reach)
      local right = side_of(points, -1, kind == "O", form.stem, bar, reach)
      if kind == "O" then
        local is_left_outside = math.abs(area_of(left)) > math.abs(area_of(right))
        contours[#contours + 1] = whole(left, not is_left_outside)
        contours[#contours + 1] = whole(right, is_left_outside)
      else
        contours[#contours + 1] = whole(table.move(reversed(right), 1, #right, #left + 1, left))
      end
    end
  end
  return contours
end

-- ---------------------------------------------------------------- the font

local poster = {}

local function width_of(letter, form) return letter[1] * (form.o - form.stem) + form.stem end

--- A glyph of a letter: its contours and its advances in all forms.
local function glyph_of(character, letter, is_low)
  local glyph = { characters = { utf8.codepoint(character) }, advances = {} }
  for name, form in pairs(forms) do
    local width = width_of(letter, form)
    local contours = draw(letter, 3, form, units_of(form, width), is_low and form.low or form.bar)
    for _, contour in ipairs(contours) do
      for _, p in ipairs(contour) do p[1] = p[1] + letter[2] end
    end
    glyph[name] = contours
    glyph.advances[name] = rounded(width) + 2 * letter[2]
  end
  glyph.advance = glyph.advances.contours
  return glyph
end

--- The parts of an accent, about 0.
local function accent_glyph(accent)
  local glyph = { characters = {}, advance = 0 }
  for name, form in pairs(forms) do
    local thin = { stem = 62, bar = 50, low = 50 }
    local parts = table.move(accent, 1, #accent - 1, 1, {})
    glyph[name] = draw(parts, 1, thin, units_of(form, 120), 50)
  end
  return glyph
end

--- Where an accent lies on a letter, in one form: the letter, and the accent moved.
local function placed(letter, number, mark, form, accent, height)
  local middle = letter[2] + width_of(letter, form) * (accent[2] == "AĄą EĘę" and 0.7 or 0.5)
  return { { number, 0, 0 }, { mark, rounded(middle), accent.is_below and 0 or height } }
end

local function add_accents(glyphs, number)
  for _, accent in ipairs(accents) do
    glyphs[#glyphs + 1] = accent_glyph(accent)
    local mark = #glyphs
    for base, capital, low in accent[#accent]:gmatch "(%a)([\xc0-\xff][\x80-\xbf])(%S+)" do
      for k, character in ipairs { capital, low } do
        local name = k == 1 and base or base == "I" and "ı" or base:lower()
        local letter = k == 1 and capitals[name] or small[name]
        local height = k == 1 and 745 or base:find "[DT]" and 745 or 570
        local glyph = { characters = { utf8.codepoint(character) },
          advance = glyphs[number[name]].advance, advances = glyphs[number[name]].advances }
        for field, form in pairs(forms) do
          glyph[field] = placed(letter, number[name], mark, form, accent, height)
        end
        glyph.components, glyph.contours = glyph.contours, nil
        glyphs[#glyphs + 1] = glyph
      end
    end
  end
end

local function sorted_names(letters)
  local names = {}
  for name in pairs(letters) do names[#names + 1] = name end
  table.sort(names)
  return names
end

--- The description that truetype.build takes.
function poster.font()
  local missing = { 0.8, 30, "O l,t! r,t! r,b! l,b!" }
  local glyphs = { glyph_of("\u{fffd}", missing), glyph_of(" ", { 0.1, 20 }) }
  glyphs[1].characters, glyphs[2].characters = {}, { 0x20, 0xa0 }
  local number = {}
  for _, letters in ipairs { capitals, small, signs } do
    for _, name in ipairs(sorted_names(letters)) do
      local is_low = letters == small or name == "ø" or name == "ß"
      glyphs[#glyphs + 1] = glyph_of(name, letters[name], is_low)
      number[name] = #glyphs
    end
  end
  add_accents(glyphs, number)
  local pairs_of = {}
  for i, one in ipairs(kerning) do pairs_of[i] = { number[one[1]], number[one[2]], one[3] } end
  table.sort(pairs_of, function(a, b)
    return a[1] < b[1] or a[1] == b[1] and a[2] < b[2]
  end)
  return { name = "Celspan Poster", units = 1000, ascent = 900, descent = -200, cap_height = 700,
    x_height = 520, glyphs = glyphs, kerning = pairs_of,
    axis = { tag = "wdth", name = "Width", least = 70, default = 100, most = 225 } }
end

if arg and arg[0] and arg[0]:match "tests/support/poster%.lua$" then
  block.write(assert(arg[1]), truetype.build(poster.font()))
end

return poster
