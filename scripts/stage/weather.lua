--- A map of the weather: two islands in a sea, lines of equal pressure, sun, cloud and rain.
local sea = rect { 0, 0, 480, 270, fill = linear { from = { 0, 0 }, to = { 480, 270 },
  { 0, "#2f6f95" }, { 1, "#1f4f78" } } }
local land = path { d = [[M30 86 Q58 40 104 52 C140 28 190 44 196 84 C230 104 214 152 180 158
  C168 196 120 206 92 186 C60 196 24 160 34 132 Q18 104 30 86 Z]], fill = "#a9c77b" }
  | path { d = "M208 30 Q236 12 262 26 C276 44 258 62 236 58 C214 60 200 46 208 30 Z",
    fill = "#a9c77b" }
local relief = clip(path { d = "M60 150 L92 96 L116 132 L134 104 L172 158 Z", fill = "#8fae66" },
  land)

local ray = stroke { d = "M0 -19 V-25", width = 4, cap = "round", fill = "#ffd24a" }
local rays = {}
for i = 0, 7 do rays[i + 1] = ray:rotate(45 * i) end
local sun = circle { 0, 0, 14, fill = "#ffd24a" } | union(rays)
local cloud = path { fill = "#fff", d = [[M-24 12 C-36 12 -36 -6 -22 -6 C-20 -22 4 -24 8 -10
  C24 -16 32 12 16 12 Z]] }
local drops = stroke { d = "M-14 18 L-18 28 M0 18 L-4 28 M13 18 L9 28", width = 3.5, cap = "round",
  fill = "#bfe2ff" }

local lines = {}
for i = 0, 4 do
  local radius = 60 + 42 * i
  lines[i + 1] = ellipse { 330, 60, radius * 1.25, radius }:stroke { width = 1.6,
    fill = "#ffffff60" }
end

--- The map at a share of its loop: the sun turns, rain falls.
return function(u)
  local falls = 3 * math.sin(2 * math.pi * 3 * u)
  return union { sea, union(lines), land:translate(3, 5):paint "#18405f", land, relief,
    sun:rotate(90 * u):translate(86, 84), (cloud | drops:translate(0, falls)):translate(150, 128),
    cloud:scale(0.8):translate(240, 40) }
end
