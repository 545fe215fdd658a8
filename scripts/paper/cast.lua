-- Portraits in place of the paper's photographs of people: drawn with closed NURBS, and then
-- converted to pictures of pixels. Units of a portrait: the head is about 200 high, its middle at
-- (0, 0); y goes down.

local cast = {}

--- A smooth closed shape near these points.
function cast.blob(points, texture)
  return nurbs { points = points, closed = "periodic", fill = texture }
end

local blob = cast.blob

--- A paint that goes from `from` at (x0, y0) to `to` at (x1, y1).
local function fade(x0, y0, x1, y1, from, to)
  return linear { from = { x0, y0 }, to = { x1, y1 }, { 0, from }, { 1, to } }
end

local function disc(x, y, rx, ry, texture)
  return ellipse { x, y, rx, ry, fill = texture }
end

local function line(points, width, colour)
  return stroke { points = points, width = width, degree = 3, cap = "round",
    taper = { 14, 14 }, fill = colour }
end

--- An eye that looks `look` units aside.
local function eye(x, look)
  return union {
    blob({ { x - 24, 2 }, { x, -16 }, { x + 24, 2 }, { x, 14 } }, "#fdf6ea"),
    disc(x + look, -1, 8, 9, "#3d5a52"), disc(x + look, -1, 4, 5, "#15110f"),
    disc(x + look - 3, -5, 2.2, 2.4, "#ffffff"),
    line({ { x - 25, 2 }, { x - 8, -15 }, { x + 10, -14 }, { x + 26, 2 } }, 5, "#2b1a18"),
  }
end

--- The face alone, in one skin: { light, dark, lip }.
local function face(skin)
  local light, dark, lip = table.unpack(skin)
  local head = blob({ { 0, -128 }, { 84, -104 }, { 92, -10 }, { 70, 66 }, { 0, 128 }, { -70, 66 },
                      { -92, -10 }, { -84, -104 } }, fade(-70, -60, 80, 60, light, dark))
  local cheek = rgb("#d8604f", 0.28)
  local marks = union {
    disc(-42, 34, 19, 14, cheek), disc(40, 34, 17, 13, cheek),
    line({ { 4, -8 }, { 14, 18 }, { 10, 30 }, { -4, 30 } }, 5, dark),
    line({ { -24, 56 }, { -10, 64 }, { 10, 64 }, { 24, 54 } }, 9, lip),
    line({ { -54, -32 }, { -40, -42 }, { -24, -42 }, { -12, -34 } }, 7, "#3a241f"),
    line({ { 54, -32 }, { 40, -42 }, { 24, -42 }, { 12, -34 } }, 7, "#3a241f"),
  }
  return head | marks
end

--- Shoulders and neck, in a coat of { light, dark }.
local function bust(skin, coat)
  return union {
    blob({ { -200, 330 }, { -196, 190 }, { -70, 120 }, { 70, 120 }, { 196, 190 }, { 200, 330 },
           { 60, 420 }, { -60, 420 } }, fade(-150, 120, 150, 320, coat[1], coat[2])),
    blob({ { -34, 40 }, { 34, 40 }, { 44, 130 }, { 0, 190 }, { -44, 130 } },
         fade(0, 60, 0, 150, skin[2], skin[1])),
  }
end

--- A woman with long dark hair and a red coat.
function cast.woman()
  local skin = { "#f7d0ac", "#cf8d6c", "#b23b3f" }
  local hair = fade(-100, -120, 120, 140, "#6a3a2a", "#2a1516")
  return union {
    blob({ { 0, -176 }, { 130, -130 }, { 122, 40 }, { 150, 190 }, { 70, 170 }, { -70, 170 },
      { -150, 190 }, { -122, 40 }, { -130, -130 } }, hair),
    bust(skin, { "#c4472f", "#7d2420" }), face(skin), eye(-36, 3), eye(36, 3),
    blob({ { -10, -150 }, { 90, -140 }, { 112, -30 }, { 88, -16 }, { 60, -84 }, { -30, -96 },
      { -86, -20 }, { -112, -10 }, { -104, -120 } }, hair),
  }
end

--- A man with short grey hair, a beard and a green coat.
function cast.man()
  local skin = { "#e9bd98", "#b07a58", "#8f4038" }
  local hair = fade(-90, -120, 100, 60, "#a7a29a", "#5c5853")
  local beard = blob({ { -92, 0 }, { -70, 50 }, { -30, 44 }, { 0, 50 }, { 30, 44 }, { 70, 50 },
    { 92, 0 }, { 84, 110 }, { 0, 168 }, { -84, 110 } }, hair)
  local mouth = line({ { -22, 66 }, { -8, 72 }, { 8, 72 }, { 22, 65 } }, 8, skin[3])
  return union {
    bust(skin, { "#3f7f6c", "#1c4440" }), face(skin), beard, mouth, eye(-36, -4), eye(36, -4),
    blob({ { 0, -160 }, { 104, -130 }, { 106, -40 }, { 84, -44 }, { 60, -98 }, { -60, -98 },
      { -84, -44 }, { -106, -40 }, { -104, -130 } }, hair),
  }
end

--- One flower: petals around (x, y), of radius r.
local function flower(x, y, r, turn, petal, heart)
  local petals = {}
  for i = 0, 6 do
    petals[#petals + 1] = blob({ { 0, 0 }, { 0.55 * r, -0.6 * r }, { 0, -1.25 * r },
      { -0.55 * r, -0.6 * r } }, petal)
      :rotate(turn + 360 / 7 * i):translate(x, y)
  end
  petals[#petals + 1] = disc(x, y, 0.28 * r, 0.28 * r, heart)
  return union(petals)
end

--- A bunch of flowers in a glass vase, about 420 high; (0, 0) is the middle of its foot.
function cast.flowers()
  local stem = "#3d6b3c"
  local heads = { { -110, -330, 62, 10, "#f2c14e" }, { -10, -390, 70, 30, "#f6e7d8" },
                  { 104, -336, 60, 0, "#e2725b" }, { -58, -262, 54, 20, "#d96a8a" },
                  { 56, -270, 58, 44, "#f2b632" } }
  local art = {}
  for _, head in ipairs(heads) do
    art[#art + 1] = line({ { head[1], head[2] }, { head[1] * 0.7, -220 }, { head[1] * 0.2, -150 },
      { 0, -20 } }, 9, stem)
  end
  for _, x in ipairs { -130, 120 } do
    art[#art + 1] = blob({ { 0, -130 }, { x * 0.4, -230 }, { x * 1.3, -250 }, { x * 0.8, -150 } },
      "#52834a")
  end
  for _, head in ipairs(heads) do
    art[#art + 1] = flower(head[1], head[2], head[3], head[4],
      fade(0, -80, 0, 0, head[5], "#b5563f"), "#5b3320")
  end
  art[#art + 1] = nurbs { closed = "periodic",
    points = { { -46, -170 }, { 46, -170 }, { 34, -110 }, { 84, -40 }, { 60, 8 }, { -60, 8 },
      { -84, -40 }, { -34, -110 } },
    fill = paint { pigment = "#8fb7c4", medium = { 0.72, 0.86, 0.9 }, beta = 0.4 } }
  return union(art)
end

return cast
