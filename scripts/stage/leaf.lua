local leaf = "M0 54 C-58 34 -62 -34 0 -74 C62 -34 58 34 0 54 Z"
local veins = "M0 52 V-46 M0 34 L-26 12 M0 34 L26 12 M0 6 L-22 -14 M0 6 L22 -14 M0 -20"
  .. " L-13 -33 M0 -20 L13 -33"
local green = linear { from = { -40, -60 }, to = { 40, 60 }, { 0, "#8fd16a" },
  { 1, "#1f8a70" } }
local shine = linear { from = { 0, 0 }, to = { 46, 0 }, { 0, rgb("#fff", 0) },
  { 0.5, rgb("#fff", 0.75) }, { 1, rgb("#fff", 0) } }
local gleam = rect { 0, 0, 46, 270, fill = shine }:skew(-20, 0)

return { leaf = leaf, veins = veins, green = green, gleam = gleam }
