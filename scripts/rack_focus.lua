-- Focus pulled through a multiplane set: a lantern near the camera, a house, a wood, mountains.

local WIDTH, HEIGHT, FOCAL = 960, 400, 1000
-- Depths, film units away from the camera's plane.
local LANTERN, HOUSE, WOOD, FAR = 0, 900, 2600, 5200

-- A plane's art is drawn about the film's centre, enlarged to make up for its distance.
local function at_depth(z, ...)
  local scale = (FOCAL + z) / FOCAL
  return cel { union { ... }:translate(-WIDTH / 2, -HEIGHT / 2):scale(scale)
    :translate(WIDTH / 2, HEIGHT / 2) }
end

local function down(y0, y1, top, foot)
  return linear { from = { 0, y0 }, to = { 0, y1 }, { 0, top }, { 1, foot } }
end

--- The first light over a lake: birds, and mountains that are as pale as the air.
local function far()
  local flock = {}
  for i = 0, 6 do
    local x, y = 560 + 27 * i + 9 * (i % 3), 70 + 26 * math.abs(i - 2) * 0.6
    flock[i + 1] = stroke { width = 2.4, cap = "round", fill = "#3e6668",
      d = ("M%g %g q6 -8 10 0 q5 -8 10 0"):format(x, y) }
  end
  return rect { -300, -300, WIDTH + 600, HEIGHT + 600, fill = down(0, 300, "#9fcfc4", "#fff0cf") },
    path { fill = down(90, 290, "#6fa9a6", "#c3dcc4"),
      d = "M-300 300 L-40 190 L60 236 L190 120 L262 176 L352 96 L470 214 L560 168 L690 250 L820 150"
        .. " L930 222 L1260 170 V500 H-300 Z" },
    path { fill = "#f4fbf0", d = "M352 96 L318 130 L340 126 L350 142 L368 124 L388 132 Z M190 120"
      .. " L164 142 L184 140 L196 152 L208 138 Z M820 150 L792 174 L812 170 L824 184 L844 168 Z" },
    union(flock)
end

local function firs(y, size, step, colour)
  local trees, chance = {}, random(colour)
  for x = -300, 1260, step do
    local h = size * (0.7 + 0.6 * chance(x))
    trees[#trees + 1] = polygon { { x, y - h }, { x + h * 0.24, y + 9 }, { x - h * 0.24, y + 9 } }
  end
  return union(trees):paint(colour) | rect { -300, y, 1560, 500, fill = colour }
end

--- A house at the edge of the wood, with a cat in its lit window.
local function house()
  local wall = rect { 330, 196, 230, 150, fill = down(196, 346, "#b9694a", "#8f4a38") }
  local boards = {}
  for i = 1, 9 do
    boards[i] = rect { 330, 196 + 15 * i, 230, 1.4, fill = "#7c3d30" }
  end
  local pane = rect { 412, 222, 88, 78, fill = "#ffd978" }
  local cat = path { fill = "#33221f", d = [[M438 300 C434 282 440 270 448 266 L446 248 L455 255
    Q459 253 464 255 L472 248 L471 266 C480 274 484 290 480 300 Z M480 300 C498 298 494 280 488 276
    C496 276 504 300 480 304 Z]] }
  local frame = union { rect { 406, 216, 100, 6, fill = "#f6ead2" }, rect { 406, 298, 100, 8,
    fill = "#f6ead2" }, rect { 406, 216, 6, 88, fill = "#f6ead2" }, rect { 500, 216, 6, 88,
    fill = "#f6ead2" }, rect { 454, 222, 4, 30, fill = "#f6ead2" } }
  local smoke = stroke { d = "M506 84 C494 62 522 50 508 26 C498 8 520 -8 512 -30", width = 15,
    cap = "round", taper = { 30, 90 }, fill = "#ffffffa0" }
  return firs(322, 118, 46, "#3f7470"), smoke, rect { 492, 90, 28, 60, fill = "#7c4a3c" }, wall,
    union(boards), polygon { { 306, 204 }, { 352, 112 }, { 538, 112 }, { 584, 204 },
      fill = down(112, 204, "#3a4f55", "#2a3b42") }, pane, cat, frame,
    path { fill = "#5c8a5f",
      d = "M-300 352 C60 322 320 340 480 338 S 900 320 1260 350 V700 H-300 Z" }
end

--- A branch near the camera, and a lantern that hangs from it.
local function near()
  local leaves, chance = {}, random "leaves"
  for i = 1, 34 do
    local u = i / 34
    local x, y = 960 - 480 * u, 22 + 46 * u * u + 12 * (chance(i) - 0.5)
    leaves[i] = path { d = "M0 0 C14 -16 34 -14 46 0 C32 10 12 10 0 0 Z",
      fill = i % 3 == 0 and "#1f4038" or "#14302b" }
      :scale(0.7 + 0.5 * chance(2 * i)):rotate(40 + 110 * chance(3 * i)):translate(x, y)
  end
  local glow = circle { 742, 226, 150, fill = radial { centre = { 742, 226 }, radius = 150,
    { 0, "#ffcf6690" }, { 0.4, "#ffb84a38" }, { 1, "#ffb84a00" } } }
  return stroke { points = { { 1010, 4, 26 }, { 820, 26, 17 }, { 640, 46, 9 }, { 470, 78, 3 } },
    degree = 2, cap = "round", fill = "#1c2622" }, union(leaves), glow,
    stroke { d = "M742 36 V142", width = 3, fill = "#1c2622" },
    stroke { d = "M722 160 C722 132 762 132 762 160", width = 5, fill = "#1c2622" },
    path { d = "M704 172 L722 154 H762 L780 172 Z M700 282 H784 V294 H700 Z", fill = "#1c2622" },
    path { d = "M710 172 H774 L780 282 H704 Z", fill = down(172, 282, "#ffe9a8", "#f9a63a") },
    path { d = "M742 272 C724 256 734 240 742 212 C750 240 760 256 742 272 Z", fill = "#fff8e0" },
    stroke { d = "M710 172 L704 282 M774 172 L780 282 M742 172 V182", width = 5, fill = "#1c2622" },
    path { d = "M-20 420 C10 330 60 306 96 330 C110 292 168 300 176 344 C210 340 226 372 220 420 Z",
      fill = "#122a26" }
end

local planes = {
  { at_depth(FAR, far()), z = FAR },
  { at_depth(WOOD, firs(268, 70, 30, "#7fb0a8")), z = WOOD },
  { at_depth(HOUSE, house()), z = HOUSE },
  { at_depth(LANTERN, near()), z = LANTERN },
}

-- Focus distances: the lantern, the house, the mountains; held, then pulled.
local focus = keys {
  { 0, FOCAL + LANTERN }, { 0.6, FOCAL + LANTERN }, { 1.8, FOCAL + HOUSE, "inOutCubic" },
  { 2.6, FOCAL + HOUSE }, { 4, FOCAL + FAR, "inOutCubic" },
}

return film {
  title = "Rack focus", size = { WIDTH, HEIGHT }, fps = 24, duration = 4.5,
  frame = function(f)
    local set = { film = { WIDTH, HEIGHT }, camera = { x = 20 * f.progress, y = 0, z = 0 },
      focal = FOCAL, focus = focus:at(f.time), aperture = 26 }
    for i, plane in ipairs(planes) do set[i] = plane end
    return multiplane(set)
  end,
}
