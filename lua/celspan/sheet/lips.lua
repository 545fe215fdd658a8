--- Mouth shapes frame by frame, from lip-sync files.
--
--   local track = assert(lips.read("line1.json", { fps = 24, hold = 2 }))
--   track:at(f.number)                      -- "A" .. "X", or its name in `map`
--
-- Frame n (from 1) shows the time from (n-1)/fps to n/fps: the shape that covers most of it. A
-- shape stays for at least `hold` frames, so that mouths do not flicker. Closed mouths (A, MBP, X,
-- rest) are never dropped: viewers notice when they are missing. After the last cue the mouth is at
-- rest: X in Rhubarb's files, where a last X only marks the end, and rest in the others.
local native = require "celspan.native"
local cues = require "celspan.cues"
local fields = require "celspan.fields"
local files = require "celspan.files"
local json = require "celspan.json"
local mouths = require "celspan.mouths"

local lips = {}

---@class celspan.lips.track
---@field frames integer
---@field fps number
---@field shapes string[]
---@field rest any The shape after the last frame
local Track = fields.class("celspan.lips", "a track of mouths")

--- The replacements for shapes that a set of drawings lacks, as Rhubarb defines them.
local fallbacks = { G = "A", H = "C", X = "A" }

local known = { fps = "number", hold = "number", map = "table", set = "table",
                start = "number" }

local SHIFT_MOST = 1e6 -- frames before a line

--- Checks ranges; names and types have already been checked.
local function check_ranges(options)
  local fps, hold = options.fps or 24, options.hold or 2
  fields.must(fps > 0 and fps <= 1000, "lips: field 'fps'", "above 0 and at most 1000", fps)
  fields.must(hold >= 1 and hold == math.floor(hold), "lips: field 'hold'",
    "a whole number of frames, 1 or more", hold)
  if math.abs((options.start or 0) * fps) > SHIFT_MOST then
    native.refuse(("lips: field 'start' must be within %d frames, got %s seconds"):format(
      SHIFT_MOST, fields.shown(options.start)))
  end
end

--- The shapes of a line that begins some frames later, with the mouth at rest before it; a negative
--- number cuts its beginning.
local function shifted(shapes, count, rest)
  local list = {}
  for n = 1, count do list[n] = rest end
  return table.move(shapes, 1 + math.max(0, -count), #shapes, #list + 1, list)
end

--- The name of the drawing of a shape: first the replacements for missing shapes, then the map.
local function namer(options)
  local has, map = {}, options.map or {}
  for _, name in ipairs(options.set or {}) do has[name] = true end
  return function(shape)
    if options.set and not has[shape] then shape = fallbacks[shape] or shape end
    local mapped = map[shape]
    return mapped == nil and shape or mapped
  end
end

--- The mouth shape at a frame, counted from 1: before frame 1 the first shape, after the last frame
--- the mouth at rest.
---@param frame integer
---@return any shape
function Track:at(frame)
  fields.check_at("lips", Track, self, frame, "a frame's number")
  local n = math.max(1, math.floor(frame))
  if n > self.frames then return self.rest end
  return self.shapes[n]
end

---@class celspan.lips.options
---@field fps? number Default 24
---@field hold? integer The shortest time of a shape, in frames; default 2
---@field map? table<string, any> Names of your own
---@field start? number When the line begins, in seconds of the film; default 0
---@field set? string[] The shapes that are drawn; missing ones are replaced: G by A, H by C, X by A

---@param path string Relative to the caller's file, else to the script
---@param options? celspan.lips.options
---@return celspan.lips.track? track
---@return string? message
function lips.read(path, options)
  fields.takes("lips: read", "string", "a file name", path)
  options = options or {}
  fields.check("lips", options, known)
  check_ranges(options)
  local text, message = files.read_found(path, json.most_bytes)
  if not text then return nil, message end
  local fps, name, rest = options.fps or 24, namer(options), nil
  local shapes, problem = fields.caught_in(path, function()
    local found = cues.read(text)
    rest = name(found.is_timed and "X" or "rest")
    return mouths.hold(mouths.expose(found, fps), options.hold or 2)
  end)
  if not shapes then return nil, problem end
  for n, shape in ipairs(shapes) do shapes[n] = name(shape) end
  shapes = shifted(shapes, math.floor((options.start or 0) * fps + 0.5), rest)
  mouths.keep(path, shapes)
  return setmetatable({ shapes = shapes, frames = #shapes, fps = fps, rest = rest }, Track)
end

return fields.publish("lips", lips, Track)
