--- The background of a film: a cel behind everything in each rostrum of a frame, which covers what
--- the camera sees.
local celspan = require "celspan"

local background = {}

local paint_metatable = getmetatable(celspan.clear)

--- A paint goes beyond the edges, where antialiasing with a kernel looks; a texture fits the frame.
local function sheet(surface, w, h)
  local is_flat = type(surface) == "string" or getmetatable(surface) == paint_metatable
  local x, y = is_flat and w or 0, is_flat and h or 0
  return celspan.rect { -x, -y, w + 2 * x, h + 2 * y, fill = surface }
end

--- A rostrum with the background of its film.
function background.of_rostrum(rostrum, film)
  local w, h = table.unpack(rostrum.size or film.size)
  local cel, camera = celspan.cel { sheet(film.background, w, h), front = "#fff" }, rostrum.camera
  if camera then
    local centre = camera.centre or camera.center or { w / 2, h / 2 }
    cel = cel:translate(-w / 2, -h / 2):scale((camera.width or w) / w)
      :rotate(camera.rotate or 0):translate(centre[1], centre[2])
  end
  return rostrum:with { cel:named "background", table.unpack(rostrum) }
end

return background
