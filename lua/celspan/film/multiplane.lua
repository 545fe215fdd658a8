--- The multiplane camera: cels at depths, seen in perspective.
--
--   multiplane{ film = {1920, 1080}, camera = { x = 0, y = 0, z = 0 }, focal = 1000,
--               focus = 1000, aperture = 0, { hills, z = 800 }, { tree, z = 0 } }  -> rostrum
--
-- A plane at depth z (away from the camera, film units) is drawn at the scale focal / distance
-- about the film's centre, distance being focal + z - camera.z, and panned by -camera.x, -camera.y
-- times that scale. Farther planes come first. A plane whose distance differs from `focus`
-- (default: focal) by d is defocused by aperture |d| / distance, in addition to its cel's defocus.
-- focus_on = z keeps the depth z sharp instead, wherever the camera is.
-- Planes at or behind the camera are not visible. front, back, brightness and antialias are passed
-- to the rostrum.
--
-- fit = true: each plane's cel is drawn for the film's frame and first enlarged by
-- (focal + z) / focal about its centre, so that it fills the film at any depth while the camera is
-- at z = 0.
--
-- over = {cel, ...}: in front of everything; the camera does not move them.
local celspan = require "celspan"
local native = require "celspan.native"
local fields = require "celspan.fields"
local scenes = require "celspan.scenes"

local known = { "planes", film = "table", camera = "table", focal = "number", focus = "number",
                focus_on = "number", aperture = "number", fit = "boolean", over = "any",
                front = "any", back = "any", brightness = "number", antialias = "any" }
local known_plane = { "cel", z = "number", fit = "boolean" }
local known_camera = { x = "number", y = "number", z = "number" }

--- Whether a plane is enlarged to fill the film at rest.
local function fits(plane, scene)
  if plane.fit ~= nil then return plane.fit end
  return scene.fit
end

--- A cel at a distance as a lens sees it.
local function seen(cel, lens, distance)
  local blur = lens.aperture * math.abs(distance - lens.focus) / distance
  cel = cel:translate(-lens.cx - lens.x, -lens.cy - lens.y)
    :scale(lens.focal / distance):translate(lens.cx, lens.cy)
  if blur == 0 then return cel end
  local own = cel.defocus or 0
  local radius = type(own) == "table" and own.radius or own
  local kernel = type(own) == "table" and own.kernel or "gaussian"
  radius = math.sqrt(radius * radius + blur * blur) -- variances add
  return cel:with { defocus = { radius = radius, kernel = kernel } }
end

--- The cels of planes, { cel, z = depth or nil }, that a lens sees. Without a depth: over all.
local function see(planes, lens)
  local cels = {}
  for _, plane in ipairs(planes) do
    local distance = plane.z and lens.focal + plane.z - lens.z
    if not distance or distance > 0 then
      cels[#cels + 1] = distance and seen(plane[1], lens, distance) or plane[1]
    end
  end
  return cels
end

local function check(scene)
  if not scene.film then
    native.refuse("multiplane: field 'film' must be {width, height}, the size of the film, got nil")
  end
  fields.numbers("multiplane", "film[%d]", scene.film, 2, "{width, height}")
  fields.must((scene.aperture or 0) >= 0, "multiplane: field 'aperture'", "0 or more",
    scene.aperture)
  if scene.focus and scene.focus_on then
    native.refuse("multiplane: 'focus' is a distance from the camera and 'focus_on' a depth: give "
      .. "one of them")
  end
  fields.must((scene.focal or 1) > 0, "multiplane: field 'focal'", "above 0", scene.focal)
  for i = 1, rawlen(scene) do
    local plane = scene[i]
    if type(plane) ~= "table" or not plane[1] then
      native.refuse(("multiplane: plane %d must be {cel, z = depth}, got %s"):format(i,
        type(plane) == "table" and ("{%s}"):format(fields.kind(plane[1])) or fields.kind(plane)))
    end
    fields.check("multiplane: plane " .. i, plane, known_plane)
    if type(plane[2]) == "number" then
      native.refuse(("multiplane: plane %d: write z = %s for its depth"):format(i, plane[2]))
    end
    if fits(plane, scene) and (plane.z or 0) <= -(scene.focal or 1000) then
      native.refuse(("multiplane: plane %d lies at or behind the camera at rest (z = %s,"
        .. " focal = %s); it cannot fill the film there"):format(i, plane.z, scene.focal or 1000))
    end
  end
end

--- The content of a plane: { a, z = 1 }, { { a, b }, z = 1 } or { a, b, z = 1 }.
local function content(plane)
  local count = rawlen(plane)
  return count > 1 and table.move(plane, 1, count, 1, {}) or plane[1]
end

--- Adds planes with what is shown there: an object, a cel or a list of them.
local function add_planes(planes, name, value, z, scale, lens)
  for _, cel in ipairs(native.cels("multiplane: " .. name, value)) do
    if scale then cel = cel:scale(scale, nil, lens.cx, lens.cy) end
    planes[#planes + 1] = { cel, z = z, place = #planes }
  end
end

local function multiplane(_, scene)
  fields.check("multiplane", scene, known)
  check(scene)
  fields.check("multiplane: camera", scene.camera or {}, known_camera)
  local camera, focal, planes = scene.camera or {}, scene.focal or 1000, {}
  local lens = { x = camera.x or 0, y = camera.y or 0, z = camera.z or 0, focal = focal,
                 aperture = scene.aperture or 0, cx = scene.film[1] / 2, cy = scene.film[2] / 2 }
  lens.focus = scene.focus_on and focal + scene.focus_on - lens.z or scene.focus or focal
  for i = 1, rawlen(scene) do
    local plane, z = scene[i], scene[i].z or 0
    local scale = fits(plane, scene) and (focal + z) / focal
    add_planes(planes, "plane " .. i, content(plane), z, scale, lens)
  end
  table.sort(planes, function(a, b)
    if a.z ~= b.z then return a.z > b.z end
    return a.place < b.place
  end)
  add_planes(planes, "over", scene.over)
  local cels = see(planes, lens)
  cels.front, cels.back = scene.front, scene.back
  cels.brightness, cels.antialias = scene.brightness, scene.antialias
  return scenes.keep(celspan.rostrum(cels), planes, lens, see)
end

---@class celspan.multiplane
---@overload fun(scene: table): celspan.rostrum
return fields.publish("multiplane", setmetatable({}, { __call = native.entry(multiplane) }))
