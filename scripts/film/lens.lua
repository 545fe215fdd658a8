-- The camera of a shot: the positions of a plane's points on the frame, and the gel that darkens
-- the corners.

local lens = {}

local WIDTH, HEIGHT, FOCAL = 1920, 1080, 1000

lens.film, lens.FOCAL = { WIDTH, HEIGHT }, FOCAL

local deep = celspan.gel(0.34, 0.33, 0.52)
local gel = circle { 0, 0, 1.5, fill = radial {
  centre = { 0, 0 }, radius = 1, { 0, celspan.gel(1, 1, 1) }, { 0.5, celspan.gel(1, 1, 1) },
  { 0.78, celspan.gel(0.74, 0.74, 0.84) }, { 1, deep } } }

--- Clear in the middle of the frame, a deep blue in its corners.
lens.vignette = celspan.cel { gel:scale(1180, 760):translate(WIDTH / 2,
  HEIGHT / 2) }:named "vignette"

--- The position under the camera of the point (x, y) of a plane that is drawn as seen at rest, and
--- its enlargement. The arithmetic is that of celspan.multiplane with `fit`.
function lens.project(camera, z, x, y)
  local rest = (FOCAL + z) / FOCAL
  local scale = FOCAL / (FOCAL + z - camera.z)
  return WIDTH / 2 + ((x - WIDTH / 2) * rest - camera.x) * scale,
    HEIGHT / 2 + ((y - HEIGHT / 2) * rest - camera.y) * scale, rest * scale
end

-- ---------------------------------------------------------------- the stack of a shot

local Stack = {}
Stack.__index = Stack

--- Collects the planes under the camera of a shot; `fields` are passed to multiplane.
function lens.stack(camera, fields)
  fields.film, fields.focal, fields.camera, fields.fit = lens.film, FOCAL, camera, true
  return setmetatable({ scene = fields }, Stack)
end

--- A cel of these objects at depth z, under this front light.
function Stack:plane(name, z, front, ...)
  self:add(z, celspan.cel { union { ... }, front = front }:named(name))
end

--- Cels at depth z; nil values are left out.
function Stack:add(z, ...)
  for i = 1, select("#", ...) do
    local cel = select(i, ...)
    if cel then self.scene[#self.scene + 1] = { cel, z = z } end
  end
end

--- The rostrum.
function Stack:shoot() return multiplane(self.scene) end

return lens
