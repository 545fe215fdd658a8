--- What layers of Lottie cannot say: the cels of a frame from the rearmost to the last one that
--- needs it, with the ground, as they look together. These are areas (native.parcels), or else a
--- picture. Equal ones of several frames are one.
local program = ...
local affine = require "celspan.affine"
local celspan = require "celspan"
local native = require "celspan.native"

local IMAGE_MOST = 8192 -- units of a side of an image, which is --scale pixels each
local NEAR = 1e-6 -- pixels

local Bake = {}
Bake.__index = Bake

local bake = {}

--- job: script, layers, shapes, keys and pool; path: of the output; numbers: of the frames.
function bake.new(job)
  job.is_archive = program.has_ending(job.path, ".lottie")
  job.pictures, job.reasons, job.known, job.members, job.images = {}, {}, {}, {}, {}
  job.layers.film.draw = function(...) return job:image_of(...) end
  return setmetatable(job, Bake)
end

-- ---------------------------------------------------------------- what cannot be said

--- Why an object of a cel cannot be shapes.
function Bake:object_refusal(placed, map)
  local whole = affine.compose(map, placed.matrix)
  local is_upright = self.keys.is_upright(whole)
  return placed.why
    or self.shapes.refusal(placed.data, is_upright and affine.translation(0, 0) or whole)
end

--- An image alone, at a scale, in a film of its box.
function Bake:film_of(data, scale)
  local left, top, right, bottom = table.unpack(self.shapes.box(data))
  local w, h = right - left, bottom - top
  local part = math.min(scale, IMAGE_MOST / math.max(w, h))
  local size = { math.max(1, math.ceil(w * part - NEAR)), math.max(1, math.ceil(h * part - NEAR)) }
  local object = data.object:translate(-left, -top):scale(size[1] / w, size[2] / h)
  return celspan.film { size = size, space = self.script.space, frame = function()
    return celspan.rostrum { celspan.cel { object } }
  end }
end

--- Whether light passes through what is drawn of a cel.
function Bake:is_clear(cel)
  if cel.fade < 1 then return true end
  local function shines(image)
    if self.shapes.is_flat(image) then return false end
    local bytes = assert(celspan.pixels(self:film_of(image, 1))):bytes()
    for i = 4, #bytes, 4 do
      if bytes:byte(i) < 255 then return true end
    end
    return false
  end
  for _, placed in ipairs(cel) do
    if placed.fade < 1 or self.shapes.is_clear(placed.data, shines) then return true end
  end
  return false
end

--- Whether light changes the colours of an image in a cel.
function Bake:is_lit(cel)
  local front = cel.front
  if front[1] == 1 and front[2] == 1 and front[3] == 1 then return false end
  for _, placed in ipairs(cel) do
    if self.shapes.has_image(placed.data) then return true end
  end
  return false
end

--- Whether a cel is one outline over nothing, which players show as celspan does in any space.
function Bake:is_alone(structure, i)
  return i == 1 and not structure.back and #structure[1] == 1
    and self.shapes.count(structure[1][1].data) == 1
end

function Bake:cel_refusal(structure, i)
  local cel = structure[i]
  if cel.why then return cel.why end
  for _, placed in ipairs(cel) do
    local why = self:object_refusal(placed, cel.matrix)
    if why then return why end
  end
  if self:is_lit(cel) then return "a picture in another light than white" end
  if self.script.space ~= "srgb" and not self:is_alone(structure, i) and self:is_clear(cel) then
    return "light that is mixed, where players mix codes"
  end
end

--- How many cels, from the rearmost on, are a picture, and why.
function Bake:cut_of(structure)
  local back = structure.back
  if structure.why then return math.huge, structure.why end
  if back and back[4] < 1 then return math.huge, "a ground that is not opaque" end
  for i = #structure, 1, -1 do
    local why = self:cel_refusal(structure, i)
    if why then
      local name = structure[i].name
      return i, why, name and ("cel '%s'"):format(name) or ("cel %d"):format(i)
    end
  end
  return 0
end

-- ---------------------------------------------------------------- pictures

--- What a picture shows: exposures.
local function rear_of(exposures, cut)
  if cut == math.huge then return exposures end
  return { { native.scene_rear(exposures[1][1], cut), 1 } }
end

--- A text that is equal for equal exposures; nil if they have to be drawn each time.
local function key_of(exposures)
  local parts = {}
  for i, exposure in ipairs(exposures) do
    local key = native.scene_key(exposure[1])
    if not key then return nil end
    parts[i] = ("%s %.17g"):format(key, exposure[2])
  end
  return table.concat(parts, " ")
end

function Bake:picture_of(shown)
  local key = key_of(shown)
  if key and self.known[key] then return self.known[key] end
  local picture = { shown = shown, items = {}, reasons = {} }
  self.pictures[#self.pictures + 1] = picture
  if key then self.known[key] = picture end
  return picture
end

--- The frame without what a picture shows. index: of the frame.
function Bake:divide(structure, exposures, index)
  local cut, why, where = self:cut_of(structure)
  self.rest, self.picture = structure, nil
  if cut > 0 then
    self.rest = { table.unpack(structure, cut == math.huge and #structure + 1 or cut + 1) }
    self.picture = self:picture_of(rear_of(exposures, cut))
    self.reason = (where and where .. ": " or "") .. why
  end
  return self:again(index)
end

--- The frame like the one before it.
function Bake:again(index)
  if self.picture then
    self.picture.items[index] = { fade = 1 }
    local reason = self.reasons[self.reason]
    if not reason then
      reason = { text = self.reason, first = index, count = 0 }
      self.reasons[self.reason], self.reasons[#self.reasons + 1] = reason, reason
    end
    reason.count = reason.count + 1
    table.insert(self.picture.reasons, reason)
  end
  return self.rest
end

--- What can be seen in a picture, as outlines; nil: why it has none.
function Bake:parcels_of(picture)
  local plane, message = celspan.plane(program.still(self.script, picture.shown))
  if not plane then return nil, message end
  return native.parcels(plane)
end

local SIDE_MOST = 16384 -- pixels: more than players can hold

function Bake:check_size()
  local width, height = self.script:view_size()
  if math.max(width, height) > SIDE_MOST then
    program.fail("limit", "%s: pictures of %d x %d pixels; the limit is %d: give a smaller --scale",
      self.path, width, height, SIDE_MOST)
  end
end

--- A new asset: the picture of a film.
function Bake:asset_of(film)
  local bytes, width, height = program.png(film)
  local assets = self.layers.assets
  local name = #assets + 1
  local asset = { id = "picture" .. name, w = width, h = height, u = "", e = 1 }
  if self.is_archive then
    asset.u, asset.p, asset.e = "i/", ("%d.png"):format(name), 0
    self.members[#self.members + 1] = { "i/" .. asset.p, bytes }
  else
    asset.p = "data:image/png;base64," .. program.base64(bytes)
  end
  self.layers:weigh(self.is_archive and #bytes or #asset.p)
  assets[name] = asset
  return asset
end

--- The asset of an image that is shown at a scale.
function Bake:image_of(data, scale)
  local images = self.images[data] or {}
  self.images[data] = images
  images[scale] = images[scale] or self:asset_of(self:film_of(data, scale))
  return images[scale]
end

function Bake:add_drawn(picture)
  self:check_size()
  self.layers:add_picture(self:asset_of(program.still(self.script, picture.shown)), picture)
end

--- Adds the layers of all pictures, which lie behind all others.
function Bake:add_layers()
  local below, above = self.pool "lines", self.pool "areas"
  for _, picture in ipairs(self.pictures) do
    local parcels, why = self:parcels_of(picture)
    for _, reason in ipairs(picture.reasons) do
      reason[parcels and "areas" or "drawn"] = why or true
    end
    if parcels then
      local areas, lines = self.shapes.parcels(parcels)
      below:add(lines, picture.items)
      above:add(areas, picture.items)
    else
      self:add_drawn(picture)
    end
  end
  below:add_layers()
  above:add_layers()
end

--- Reports the cels that are not layers.
function Bake:report()
  local most = 8 -- sentences
  for i, reason in ipairs(self.reasons) do
    if i > most then
      return program.note("%d other reasons are not listed", #self.reasons - most)
    end
    local how = not reason.drawn and "areas" or reason.areas and "areas or a picture" or "a picture"
    if reason.drawn then how = ("%s (%s)"):format(how, reason.drawn) end
    program.note("%s: %d frame%s from frame %d on, in part as %s: %s", self.path, reason.count,
      reason.count == 1 and "" or "s", self.numbers[reason.first], how, reason.text)
  end
end

return bake
