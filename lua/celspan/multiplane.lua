--- The multiplane camera: cels at depths, seen in perspective.
--
--   multiplane{ film = {1920, 1080}, camera = { x = 0, y = 0, z = 0 }, focal = 1000,
--               focus = 1000, aperture = 0, { hills, z = 800 }, { tree, z = 0 } }  -> rostrum
--
-- A plane at depth z (away from the camera, film units) is drawn at the scale focal / distance
-- about the film's centre, distance being focal + z - camera.z, and panned by -camera.x, -camera.y
-- times that scale. Farther planes come first. A plane whose distance differs from `focus`
-- (default: focal) by d is defocused by aperture |d| / distance, on top of what its cel has. Planes
-- at or behind the camera are not seen. front, back, brightness and antialias go to the rostrum.
local celspan = require "celspan"
local fields = require "celspan.fields"

local known = { film = "table", camera = "table", focal = "number", focus = "number",
                aperture = "number", front = "any", back = "any", brightness = "number",
                antialias = "any" }
local known_plane = { z = "number" }
local known_camera = { x = "number", y = "number", z = "number" }

--- The cel of a plane as the camera sees it.
local function seen(plane, scene, scale, blur)
  local cx, cy = scene.film[1] / 2, scene.film[2] / 2
  local camera = scene.camera or {}
  local cel = plane[1]:translate(-cx - (camera.x or 0), -cy - (camera.y or 0))
    :scale(scale):translate(cx, cy)
  if blur == 0 then return cel end
  local own = cel.defocus or 0
  local radius = type(own) == "table" and own.radius or own
  local kernel = type(own) == "table" and own.kernel or "gaussian"
  radius = math.sqrt(radius * radius + blur * blur) -- variances add
  return cel:with { defocus = { radius = radius, kernel = kernel } }
end

local function check(scene)
  local film = scene.film
  if not film or math.type(film[1]) == nil or math.type(film[2]) == nil then
    error("multiplane: field 'film' must be {width, height}, the size of the film", 3)
  end
  if scene.focal and scene.focal <= 0 then
    error(("multiplane: field 'focal' must be above 0, got %s"):format(scene.focal), 3)
  end
  for i = 1, #scene do
    local plane = scene[i]
    if type(plane) ~= "table" or type(plane[1]) ~= "userdata" then
      error(("multiplane: plane %d must be {cel, z = depth}, got %s"):format(i,
        type(plane) == "table" and "another table" or type(plane)), 3)
    end
    fields.check("multiplane: plane " .. i, plane, known_plane, 4)
  end
end

local function multiplane(_, scene)
  fields.check("multiplane", scene, known)
  check(scene)
  fields.check("multiplane: camera", scene.camera or {}, known_camera)
  local focal = scene.focal or 1000
  local focus, aperture = scene.focus or focal, scene.aperture or 0
  local order = {}
  for i = 1, #scene do order[i] = i end
  table.sort(order, function(a, b)
    local za, zb = scene[a].z or 0, scene[b].z or 0
    if za ~= zb then return za > zb end
    return a < b
  end)
  local cels = { front = scene.front, back = scene.back, brightness = scene.brightness,
                 antialias = scene.antialias }
  for _, i in ipairs(order) do
    local distance = focal + (scene[i].z or 0) - (scene.camera and scene.camera.z or 0)
    if distance > 0 then
      local blur = aperture * math.abs(distance - focus) / distance
      cels[#cels + 1] = seen(scene[i], scene, focal / distance, blur)
    end
  end
  return celspan.rostrum(cels)
end

---@class celspan.multiplane
---@overload fun(scene: table): celspan.rostrum
return setmetatable({}, { __call = multiplane })
