-- Layers: a painting of many layers under the multiplane camera. The painter's groups become planes
-- at different depths; a dolly and a pan separate them, and the focus moves from near to far.
local layers = require "celspan.layers"

local tree = assert(layers.read "paintings/valley.ora")

--- {group or layer, depth}
local depths = { { "sky", 2600 }, { "sun", 2600 }, { "glow", 2600 }, { "far", 1800 },
  { "hills", 1100 },
                 { "wood", 500 }, { "near", 0 } }

return film { frames = 48, frame = function(f)
  local scale = 1.1 * f.height / tree.height -- edges that are out of focus lie beyond the frame
  local move = ease "inOutSine"(f.progress) -- a camera has weight: it starts and stops slowly
  local left, top = (tree.width * scale - f.width) / 2, (tree.height * scale - f.height) / 2
  local scene = { film = { f.width, f.height }, focal = 900, fit = true, aperture = 26,
                  focus = 900 + 1300 * ease "inOutQuad"(f.progress),
                  camera = { x = -90 + 180 * move, y = 0, z = 160 * move } }
  for _, plane in ipairs(depths) do
    for _, cel in ipairs(tree:cels { only = { plane[1] } }) do
      scene[#scene + 1] = { cel:scale(scale):translate(-left, -top), z = plane[2] }
    end
  end
  return multiplane(scene)
end }
