-- The scene of figures 15(c) and 15(d): a face and flowers out of one frame of film, a view of a
-- town, and a translucent clover drawn with NURBS. Each source has its own lights, which balance
-- them. Arguments: the frame of film (2048 x 1536, coded by its density) and the view (768 x 512);
-- without them both are made here.
local cast = require "cast"
local pixels = require "pixels"

local scene = {}

local FRAME = { 2048, 1536 } -- pixels of a frame of film
local VIEW = { 768, 512 }    -- pixels of the view

local woman = cast.woman():scale(3):translate(760, 620)
local flowers = cast.flowers():scale(2.4):translate(1640, 1460)

--- The frame of film: a woman and flowers before a grey wall, in the flat light of a studio.
local function frame()
  local wall = rect { 0, 0, FRAME[1], FRAME[2], fill = "#8d9094" }
  return pixels.film(union { wall, woman, flowers }, FRAME[1], FRAME[2],
    { 0.32, 0.30, 0.27 })
end

--- The view: houses on a canal, a picture of the project, as pixels of the paper's size.
local function view()
  local picture = image { file = "../pictures/canal.png", x = 0, y = 0, w = VIEW[1],
    h = VIEW[2], fit = "cover" }
  return pixels.of(picture, VIEW[1], VIEW[2])
end

--- The outlines to cut out of a given frame, in its pixels: an oval each.
local given = {
  face = ellipse { 760, 760, 560, 760 },
  flowers = ellipse { 1640, 900, 400, 620 },
}

--- The part of the frame of film inside an outline.
local function cut(film, outline)
  return clip(rect { 0, 0, FRAME[1], FRAME[2], fill = film }, outline)
end

--- Four leaves around (0, 0): red, and more translucent towards the top.
local function clover()
  local leaves = {}
  for turn = 0, 3 do
    leaves[turn + 1] = nurbs { closed = "periodic",
      points = { { 0, 0 }, { 0, 0 }, { 0, 0 }, { 120, -110 }, { 190, -230 }, { 90, -330 },
        { 0, -230 }, { -90, -330 }, { -190, -230 }, { -120, -110 } } }:rotate(20 + 90 * turn)
  end
  local glass = linear { from = { 0, -260 }, to = { 0, 260 },
    { 0, paint { pigment = "#d0202a", medium = { 1, 0.5, 0.45 }, beta = 0.15 } },
    { 1, paint { pigment = "#b3121f", medium = { 0.9, 0.2, 0.2 }, beta = 0.95 } } }
  return clip(rect { -400, -400, 800, 800, fill = glass }, union(leaves))
end

--- The window of 15(d) in the film of 960 x 720: {x, y, w, h}.
scene.close_up = { 592, 368, 120, 90 }

--- The cels of the scene in a film of 960 x 720. `sampling` is that of both pictures.
function scene.cels(frame_file, view_file, sampling)
  local film = pixels.texture(pixels.given(frame_file, frame),
    { box = { 0, 0, FRAME[1], FRAME[2] }, sampling = sampling })
  local town = pixels.texture(pixels.given(view_file, view),
    { box = { 0, 0, 1080, 720 }, sampling = sampling })
  local is_given = frame_file and frame_file ~= ""
  local face = cut(film, is_given and given.face or woman)
  local bunch = cut(film, is_given and given.flowers or flowers)
  return {
    cel { rect { 0, 0, 1080, 720, fill = town }:translate(-60, 0),
      front = { 0.8, 0.85, 0.95 } }:named "view",
    cel { clover():scale(0.72):translate(575, 268) }:named "clover",
    cel { bunch:scale(0.34):translate(262, 210),
      front = { 3.3, 3.3, 3.6 } }:named "flowers",
    cel { face:scale(0.42):translate(-54, 112), front = { 3.1, 3.2, 3.4 } }:named "face",
  }
end

return scene
