--- A street of about 1925 in greys, which is the same again every 180 units, and a car in it.
local function line(d, width, tint)
  return stroke { d = d, width = width, cap = "round", join = "round", fill = tint }
end

--- A window with a round or a flat top.
local function window(x, y, is_round)
  local top = is_round and ("Q%g %g %g %g"):format(x + 8, y - 12, x + 16, y)
    or ("H%g"):format(x + 16)
  local shape = ("M%g %gV%g%sV%gZ"):format(x, y + 24, y, top, y + 24)
  return path { d = shape, fill = "#4c4c4c" }
    | stroke { d = shape .. ("M%g %gV%gM%g %gH%g"):format(x + 8, y - 3, y + 24, x, y + 9, x + 16),
      width = 2, fill = "#dedede" } | rect { x - 3, y + 24, 22, 3, fill = "#dedede" }
end

local awning = {}
for i = 0, 6 do
  awning[i + 1] = path { d = ("M%g 132H%gL%g 150Q%g 157 %g 150Z"):format(8 + 10 * i, 18 + 10 * i,
    16 + 11 * i, 10.5 + 11 * i, 5 + 11 * i), fill = i % 2 == 0 and "#f2f2f2" or "#6e6e6e" }
end
local shop = union { rect { 0, 20, 88, 172, fill = "#a9a9a9" },
  path { d = "M-4 22V12H92V22ZM4 12Q44 -14 84 12Z", fill = "#8b8b8b" }, window(10, 40, true),
  window(36, 40, true), window(62, 40, true), window(10, 88), window(36, 88), window(62, 88),
  rect { 6, 124, 76, 8, fill = "#5a5a5a" }, rect { 10, 146, 40, 40, fill = "#3c3c3c" },
  rect { 56, 146, 22, 46, fill = "#4b4b4b" }, rect { 60, 150, 14, 20, fill = "#7a7a7a" },
  union(awning) }
local house = union { rect { 0, 44, 84, 148, fill = "#c6c6c6" },
  path { d = "M-4 46L10 14H74L88 46Z", fill = "#6f6f6f" },
  rect { 58, -2, 12, 26, fill = "#8b8b8b" },
  path { d = "M30 40V22Q42 12 54 22V40Z", fill = "#c6c6c6" }, window(34, 22, true):scale(0.8, 0.7,
    42, 38), window(10, 62), window(58, 62), window(10, 108), window(58, 108),
  path { d = "M32 192V142Q42 126 52 142V192Z", fill = "#555555" },
  line("M34 66V88M42 66V88M50 66V88M30 66H54M30 90H54", 1.6, "#6f6f6f"),
  rect { -2, 100, 88, 3, fill = "#adadad" }, rect { 26, 190, 32, 4, fill = "#adadad" } }
local lamp = line("M0 194V92", 3.4, "#303030") | line("M-9 100H9", 2.4, "#303030")
  | path { d = "M-8 92L-5 74H5L8 92Z", fill = "#efefef" }
  | path { d = "M-8 74L0 64L8 74Z", fill = "#303030" }

local houses = {}
for i = -1, 3 do
  houses[#houses + 1] = (shop | house:translate(92, 0) | lamp:translate(90, 0))
    :translate(180 * i, 0)
end

local function wheel(x)
  local spokes = {}
  for i = 1, 6 do spokes[i] = rect { -15, -0.8, 30, 1.6, fill = "#d9d9d9" }:rotate(30 * i) end
  return union { circle { 0, 0, 23, fill = "#1a1a1a" }, circle { 0, 0, 16, fill = "#4a4a4a" },
    union(spokes), circle { 0, 0, 5, fill = "#d9d9d9" } }:translate(x, -8)
end

local driver = union { path { d = "M-16 -44C-16 -62 12 -62 12 -44Z", fill = "#7d7d7d" },
  circle { 0, -66, 10, fill = "#dcdcdc" },
  path { d = "M-12 -68C-12 -82 10 -82 11 -70L17 -67H-12Z", fill = "#3a3a3a" },
  path { d = "M-6 -57C-20 -58 -34 -64 -48 -60C-40 -56 -46 -52 -52 -48C-36 -46 -18 -50 -4 -52Z",
    fill = "#f4f4f4" }, circle { 6, -67, 3.4, fill = "#1a1a1a" } }
local car = union { driver:translate(-22, 0),
  line("M14 -42L24 -70", 2.4, "#1a1a1a"), line("M-2 -44L8 -52", 3, "#1a1a1a"),
  path { fill = "#3a3a3a",
    d = "M-96 -14C-98 -40 -86 -46 -66 -46H10L20 -40H88C94 -40 96 -34 96 -14Z" },
  path { d = "M10 -46L20 -40V-14H6V-46Z", fill = "#2a2a2a" },
  line("M34 -34V-20M44 -34V-20M54 -34V-20M64 -34V-20", 2, "#222222"),
  line("M-92 -30H6M22 -30H92", 1.4, "#8d8d8d"),
  rect { 92, -40, 7, 28, radius = 2, fill = "#d9d9d9" }, circle { 100, -34, 7, fill = "#f4f4f4" },
  rect { -110, -38, 12, 26, radius = 4, fill = "#222222" },
  path { d = "M-90 -8C-90 -40 -34 -40 -34 -8H34C34 -40 90 -40 92 -6L84 -4C80 -30 44 -30 42 -2H-42"
    .. "C-44 -30 -80 -30 -82 -4Z", fill = "#1f1f1f" }, wheel(-62), wheel(64) }:translate(0, -15)

return { car = car, houses = houses }
