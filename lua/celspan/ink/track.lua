--- Follows a region through a sequence of pictures, and places art on it.
--
--   local t = assert(track.follow("head.####.png", { from = 1, at = { 300, 120, 200, 180 } }))
--   t:place(hat, f)             -- the hat, at the position of the head in frame f
--   t:steady(picture, f)        -- the picture, moved so that the head stays as in frame 1
--   t.lost                      -- the frames in which it was not found
--
-- All positions are in pixels of the frames. In a lost frame positions are interpolated between the
-- nearest frames before and after it in which the region was found.
local celspan = require "celspan"
local native = require "celspan.native"
local fields = require "celspan.fields"
local files = require "celspan.files"
local values = require "celspan.values"

local track = {}

---@class celspan.track
---@field from integer The frame in which the region was given
---@field at number[] {x, y, w, h} of the region in that frame
---@field model "translation"|"similarity"|"perspective"
---@field width integer Of the frames, in pixels
---@field height integer
---@field frames integer[] All frames, ascending
---@field lost integer[] The frames in which the region was not found
local Track = { __name = "celspan.track" }
local methods = {}
Track.__index = fields.reads("a track", methods)

--- The data of each frame of a track: { matrix =, corners =, agreeing =, error = }, or false if the
--- region was lost. Hidden from scripts.
local sightings = setmetatable({}, { __mode = "k" })

local models = { "translation", "similarity", "perspective" }
local MOST_BYTES = 64 * 1024 * 1024 -- of a track file
local LARGEST = 1e15 -- number in a track file

-- ---------------------------------------------------------------- a value

local IDENTITY = { 1, 0, 0, 0, 1, 0, 0, 0, 1 }

--- The lists for scripts, from the data of the frames.
local function make(head, found)
  head.frames, head.lost = {}, {}
  for frame in pairs(found) do table.insert(head.frames, frame) end
  table.sort(head.frames)
  for _, frame in ipairs(head.frames) do
    if not found[frame] then table.insert(head.lost, frame) end
  end
  sightings[head] = found
  return setmetatable(head, Track)
end

--- The number of a frame, which is given as a number or as the argument of a frame function.
local function number_of(method, f)
  local number = type(f) == "userdata" and tostring(f):find "^frame" and f.number or f
  fields.expect(fields.is_finite(number), f, "track: %s takes a frame or its number", method)
  return number
end

--- The nearest frames before and after a number in which the region was found.
local function around(self, number)
  local found, before, after = sightings[self], nil, nil
  for _, frame in ipairs(self.frames) do
    if found[frame] and frame <= number then before = frame end
    if found[frame] and frame >= number and not after then after = frame end
  end
  return before or after, after or before
end

--- The motion from the first frame to another frame. Between the frames in which the region was
--- found, it is interpolated; before the first and after the last of them, it is constant.
---@param f celspan.frame|number
---@return number[] matrix Nine numbers, by rows
---@return boolean is_found Whether the region was found in this frame
function methods:motion(f)
  fields.self("track", Track, self, "motion")
  local number, found, matrix = number_of("motion", f), sightings[self], {}
  local before, after = around(self, number)
  local u = after == before and 0 or (number - before) / (after - before)
  local a, b = found[before].matrix, found[after].matrix
  for i = 1, 9 do matrix[i] = a[i] + (b[i] - a[i]) * u end
  return matrix, found[number] and true or false
end

--- Checks the arguments of a method that moves an object or a cel. Returns the motion.
local function motion_for(self, method, object, f)
  fields.self("track", Track, self, method)
  local noun = tostring(object)
  local is_drawn = type(object) == "userdata" and not noun:find "^frame" and not noun:find "^paint"
  fields.expect_kind(is_drawn, object, "track: %s takes an object or a cel", method)
  return self:motion(number_of(method, f))
end

--- Art that is positioned for the first frame, moved to its position in frame f.
---@generic T: celspan.object|celspan.cel
---@param object T
---@param f celspan.frame|number
---@return T
function methods:place(object, f)
  local motion = motion_for(self, "place", object, f)
  return object:transform(motion)
end

--- An object that shows frame f, moved so that the region stays at its position in the first frame.
---@generic T: celspan.object|celspan.cel
---@param object T
---@param f celspan.frame|number
---@return T
function methods:steady(object, f)
  local motion = motion_for(self, "steady", object, f)
  return object:transform(assert(native.inverse(motion)))
end

-- ---------------------------------------------------------------- following

local known = { from = "number", at = "any", frames = "string", model = "string" }

--- The number of a model; nil if no model has this name.
local function model_number(name)
  for i, model in ipairs(models) do
    if model == name then return i - 1 end
  end
end

--- Checks the options. Returns the number of the model.
local function check_options(options)
  fields.check("track", options, known)
  local name, at = options.model or "similarity", options.at
  local model = model_number(name) or native.refuse(("track: field 'model' must be \"%s\", got "
    .. "\"%s\""):format(table.concat(models, '", "'), name))
  fields.expect(math.tointeger(options.from), options.from,
    "track: field 'from' must be the number of a frame")
  if type(at) == "table" then
    fields.numbers("track", "at[%d]", at, 4, "{x, y, w, h} or an object")
  else -- a cel takes only objects
    fields.expect_kind(type(at) == "userdata" and pcall(celspan.cel, { at }), at,
      "track: field 'at' must be {x, y, w, h} or an object")
  end
  return model
end

--- A frame's pixels as 16-bit values.
local function codes_of(object, w, h)
  local rostrum = celspan.rostrum { antialias = "none", celspan.cel { object } }
  local image, message = celspan.pixels(rostrum, { size = { w, h }, film = { w, h } })
  return image and image:bytes { depth = 16, colour = "srgb", alpha = "premultiplied" }, message
end

--- The pixels of a frame's file: codes, width, height | nil, message.
local function read_frame(path)
  local good, image = pcall(celspan.image, { file = path, sampling = "nearest" })
  if not good then return nil, image end
  local found, problem, _, w, h = pcall(image.bounds, image)
  if not found then return nil, problem end
  local codes, message = codes_of(image, w, h)
  return codes, codes and w or message, h
end

--- The full pattern of the files, beside the caller's file or the script.
local function find_pattern(pattern, from)
  local name, message = native.frame_name(pattern, from)
  if not name then return nil, message end
  local there, tried = native.find(name)
  if tried then
    return nil, ("%s: No such file; also looked for at %s"):format(there, tried)
  end
  return there:sub(1, #there - #name) .. pattern
end

--- The requested frames after `from`, ascending, and those before it, descending; nil and a message
--- if `from` is not among them.
local function list_frames(pattern, options)
  local numbers, message = native.frames(pattern, options.frames)
  if not numbers then return nil, message end
  if #numbers == 0 then return nil, pattern .. ": there are no such files" end
  local after, before, has_from = {}, {}, false
  table.sort(numbers)
  for _, number in ipairs(numbers) do
    if number > options.from then after[#after + 1] = number end
    if number < options.from then table.insert(before, 1, number) end
    has_from = has_from or number == options.from
  end
  if has_from then return after, before end
  return nil, ("%s: frame %d, in which the region is given, is not among the frames"):format(
    pattern, options.from)
end

--- Follows the region through `numbers` in one direction; adds the data of each frame.
local function follow_some(tracker, pattern, numbers, size, found)
  for _, number in ipairs(numbers) do
    local path = native.frame_name(pattern, number)
    local codes, w, h = read_frame(path)
    if not codes then return nil, ("frame %d: %s"):format(number, w) end
    if w ~= size[1] or h ~= size[2] then
      return nil, ("%s: has %d x %d pixels, and the first frame %d x %d"):format(path, w, h,
        size[1], size[2])
    end
    local matrix, corners, agreeing, error_of = native.follow(tracker, codes, w, h)
    if not matrix and corners then return nil, ("%s: %s"):format(path, corners) end
    found[number] = matrix and { matrix = matrix, corners = corners, agreeing = agreeing,
                                 error = error_of } or false
  end
  return true
end

--- The region as {x, y, w, h}, and its mask if it is an object; nil and a message.
local function region_of(at, w, h)
  if type(at) == "table" then return { at[1], at[2], at[3], at[4] } end
  local x, y, width, height = at:bounds()
  if not x then return nil, "the object 'at' covers nothing" end
  local mask, message = codes_of(celspan.clip(celspan.rect { x, y, width, height }, at), w, h)
  if not mask then return nil, message end
  return { x, y, width, height }, mask
end

---@class celspan.track.options
---@field from integer The frame in which the region is given
---@field at number[]|celspan.object The region in that frame: {x, y, w, h}, or an object that covers it
---@field frames? string Such as "1-100"; default: all files of the pattern
---@field model? "translation"|"similarity"|"perspective" Default "similarity"

---@param pattern string Files with a number: "head.####.png"; beside the caller's file or the script
---@param options celspan.track.options
---@return celspan.track? track
---@return string? message
function track.follow(pattern, options)
  fields.takes("track: follow", "string", "the pattern of files", pattern)
  local model = check_options(options)
  local from = math.tointeger(options.from)
  local where, message = find_pattern(pattern, from)
  if not where then return nil, message end
  local after, before = list_frames(where, options)
  if not after then return nil, before end
  local codes, w, h = read_frame(native.frame_name(where, from))
  if not codes then return nil, ("frame %d: %s"):format(from, w) end
  local region, mask = region_of(options.at, w, h)
  if not region then return nil, ("%s: frame %d: %s"):format(pattern, from, mask) end
  local tracker, problem = native.tracker(codes, w, h, model, region, mask)
  if not tracker then return nil, ("%s: frame %d: %s"):format(pattern, from, problem) end
  local found = { [from] = { matrix = IDENTITY, corners = 0, agreeing = 0, error = 0 } }
  for _, numbers in ipairs { after, before } do
    local good, fault = follow_some(tracker, where, numbers, { w, h }, found)
    if not good then return nil, fault end
    native.rewind(tracker)
  end
  return make({ from = from, at = region, model = models[model + 1], width = w, height = h },
    found)
end

-- ---------------------------------------------------------------- files

local function numbers_text(list)
  local words = {}
  for i, value in ipairs(list) do words[i] = ("%.17g"):format(value) end
  return "[" .. table.concat(words, ", ") .. "]"
end

local function frame_text(number, sighting)
  if not sighting then return ('    {"frame": %d, "lost": true}'):format(number) end
  return ('    {"frame": %d, "matrix": %s, "corners": %d, "agreeing": %d, "error": %.4f}'):format(
    number, numbers_text(sighting.matrix), sighting.corners, sighting.agreeing, sighting.error)
end

--- The track as JSON: one line per frame.
function methods:text()
  fields.self("track", Track, self, "text")
  local lines = {}
  for i, number in ipairs(self.frames) do
    lines[i] = frame_text(number, sightings[self][number])
  end
  return ('{\n  "celspan": "track", "from": %d, "model": "%s",\n  "at": %s, "size": [%d, %d],\n'
    .. '  "frames": [\n%s\n  ]\n}\n'):format(self.from, self.model, numbers_text(self.at),
    self.width, self.height, table.concat(lines, ",\n"))
end

---@param path string
---@return true?
---@return string? message
function methods:write(path)
  fields.self("track", Track, self, "write")
  fields.takes("track: write", "string", "the name of a file", path)
  return files.write(path, self:text())
end

--- A list of numbers in a file.
local function numbers_in(object, where, name, count)
  local list = values.get(object, where, name, "table")
  if #list ~= count then values.fail("%s%s must be %d numbers", where, name, count) end
  for i = 1, count do
    values.number(list, where .. name .. ": ", i, -LARGEST, LARGEST)
  end
  return list
end

local function whole_in(object, where, name)
  return values.whole(object, where, name, -LARGEST, LARGEST)
end

local function sighting_in(entry, where)
  if entry.lost == true then return false end
  local matrix = numbers_in(entry, where, "matrix", 9)
  if not native.inverse(matrix) then values.fail("%smatrix must be invertible", where) end
  return { matrix = matrix, corners = whole_in(entry, where, "corners"),
    agreeing = whole_in(entry, where, "agreeing"),
    error = values.number(entry, where, "error", 0, LARGEST) }
end

local function read_text(text)
  local value = values.decode(text, "the file")
  if value.celspan ~= "track" then values.fail "the file must be a track of celspan" end
  if not model_number(value.model) then
    values.fail("model must be one of %s", table.concat(models, ", "))
  end
  local size, found, is_found = numbers_in(value, "", "size", 2), {}, false
  for entry, where in values.each(value, "", "frames") do
    local number = whole_in(entry, where, "frame")
    if found[number] ~= nil then
      values.fail("%sframe must be a number that is not already used", where)
    end
    found[number] = sighting_in(entry, where)
    is_found = is_found or found[number]
  end
  if not is_found then
    values.fail "frames must be a list with a frame in which the region was found"
  end
  return make({ from = whole_in(value, "", "from"), at = numbers_in(value, "", "at", 4),
    model = value.model, width = whole_in(size, "size: ", 1),
    height = whole_in(size, "size: ", 2) }, found)
end

---@param path string Relative to the caller's file, else to the script
---@return celspan.track? track
---@return string? message
function track.read(path)
  fields.takes("track: read", "string", "a file name", path)
  local text, message = files.read_found(path, MOST_BYTES)
  if not text then return nil, message end
  return fields.caught_in(path, read_text, text)
end

return fields.publish("track", track, methods)
