-- Figure 1: a sample image made from five cels. The rearmost is a picture, of pixels; the others
-- are drawn with closed NURBS and are sharp at every size.
--   celspan render scripts/paper/figure01.lua --allow scripts -o 1.png -- view.jpg
local cast = require "cast"
local pixels = require "pixels"

local blob = cast.blob
local W, H = 960, 720

local function line(points, width, colour, taper)
  return stroke { points = points, width = width, degree = 3, cap = "round", taper = taper,
    fill = colour }
end

--- 1: the view.
local function view(file)
  local texture = pixels.texture(pixels.given(file,
    function() return { file = "../pictures/canal.png" } end),
    { box = { -80, -40, 1280, 720 }, wrap = "clamp" })
  return cel { rect { 0, 0, W, H, fill = texture }, front = { 0.9, 0.86, 0.82 } }
end

--- 2: the evening, a sheet of gelatine that filters the view, and a low sun.
local function evening()
  local gel = linear { from = { 0, 0 }, to = { 0, H }, { 0, celspan.gel(1, 0.84, 0.62) },
    { 1, celspan.gel(0.62, 0.5, 0.72) } }
  local sun = blob({ { 812, 14 }, { 902, 14 }, { 922, 104 }, { 857, 159 }, { 792, 104 } },
    paint { pigment = "#ffcf7a", medium = { 1, 0.9, 0.7 }, beta = 0.75 })
  return cel { rect { 0, 0, W, H, fill = gel }, sun }
end

--- 3: the window sill, with a pot of herbs.
local function sill()
  local board = rect { 0, 590, W, 130,
    fill = linear { from = { 0, 590 }, to = { 0, 720 },
    { 0, "#e9d2ae" }, { 0.16, "#c79a6e" }, { 1, "#6d4636" } } }
  local pot = blob({ { 690, 470 }, { 850, 470 }, { 870, 480 }, { 836, 610 }, { 800, 630 },
    { 740, 630 }, { 704, 610 },
    { 670, 480 } }, linear { from = { 680, 0 }, to = { 860, 0 }, { 0, "#d8774f" },
      { 1, "#8e3f31" } })
  local function shadow(x, y, rx)
    return ellipse { x, y, rx, 15,
      fill = celspan.gel(0.62, 0.5, 0.5) }
  end
  local art = { board, shadow(345, 634, 190), shadow(782, 622, 84) }
  for i, leaf in ipairs { { -46, 120 }, { -24, 150 }, { 2, 168 }, { 26, 146 }, { 48, 118 },
    { -62, 84 }, { 64, 86 } } do
    local green = i % 2 == 0 and "#5f8f55" or "#3f7046"
    art[#art + 1] = blob({ { -10, 0 }, { -34, -leaf[2] * 0.7 }, { 0, -leaf[2] * 1.25 },
      { 34, -leaf[2] * 0.7 }, { 10, 0 } },
      green):rotate(leaf[1] * 0.7):translate(770 + leaf[1] * 0.5, 490)
  end
  art[#art + 1] = pot
  return cel { union(art), front = { 1, 0.9, 0.82 } }
end

--- 4: a cat that looks out.
local function cat()
  local fur = linear { from = { 150, 0 }, to = { 480, 0 }, { 0, "#2c2530" },
    { 0.75, "#4a3a44" },
    { 1, "#a8735c" } }
  local body = blob({ { 310, 300 }, { 392, 330 }, { 420, 450 }, { 470, 560 }, { 440, 640 },
    { 310, 636 }, { 180, 640 },
    { 150, 560 }, { 200, 450 }, { 228, 330 } }, fur)
  local head = blob({ { 310, 196 }, { 392, 204 }, { 424, 280 }, { 372, 344 }, { 310, 352 },
    { 248, 344 }, { 196, 280 },
    { 228, 204 } }, fur)
  local function ear(side)
    return blob({ { 20, 40 }, { 20, 40 }, { 56, -52 }, { 56, -52 }, { 58, -50 }, { 96, 50 },
      { 96, 50 }, { 60, 70 } }, fur)
      :scale(side, 1):translate(310, 214)
  end
  local tail = line({ { 400, 610 }, { 540, 650 }, { 590, 560 }, { 520, 500 }, { 560, 440 } }, 44,
    fur, { 0, 60 })
  return cel { union { tail, body, ear(1), ear(-1), head },
    front = { 1, 0.92, 0.9 } }
end

--- 5: a branch of the tree in front of the window, out of focus.
local function branch()
  local art = { line({ { -40, 60 }, { 180, 30 }, { 380, 80 }, { 620, 20 }, { 760, 50 } }, 16,
    "#3a2530", { 0, 200 }) }
  for i = 0, 12 do
    local x = 20 + 56 * i
    art[#art + 1] = blob({ { 0, 0 }, { 26, 26 }, { 0, 84 }, { -26, 26 } },
      i % 3 == 0 and "#8c3b3f" or "#4d2c3a")
      :rotate(i % 2 == 0 and 24 or -150):translate(x, 46 + 12 * math.sin(i))
  end
  return cel { union(art), defocus = 7, front = { 0.9, 0.8, 0.8 } }
end

local file = ...
return film { title = "Figure 1", size = { W, H }, frames = 1, frame = function()
  return { view(file):named "view", evening():named "evening", sill():named "sill",
    cat():named "cat", branch():named "branch" }
end }
