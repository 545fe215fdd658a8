--- Motion blur: a frame function that exposes a frame at several moments.
--
--   frame = shutter{ angle = 180, samples = 8, frame = function(f) ... end }
--
-- The shutter opens at the frame's time and stays open for angle / 360 of a frame. The inner
-- function is called once for each sample with an f whose time, middle and progress are those of
-- the middle of the sample's interval; number, index, f:on and f:random are those of the frame. The
-- samples are exposed with equal weights that add up to 1.
local native = require "celspan.native"
local fields = require "celspan.fields"

local known = { angle = "number", samples = "number", frame = "function" }

--- f, moved in time by a fraction of a frame.
local function moved(f, share)
  local g = {
    time = f.time + share / f.fps,
    middle = f.middle + share / f.fps,
    progress = f.count > 1 and (f.index + share) / (f.count - 1) or 0,
    on = function(_, ...) return f:on(...) end,
    random = function(_, ...) return f:random(...) end,
  }
  return setmetatable(g, {
    __index = function(_, name) return f[name] end,
    __newindex = function() native.refuse("frames are immutable") end,
  })
end

local function shutter(_, settings)
  fields.check("shutter", settings, known)
  local angle, samples, frame = settings.angle or 180, settings.samples or 8, settings.frame
  fields.must(angle >= 0 and angle <= 360, "shutter: field 'angle'", "0..360 degrees", angle)
  fields.whole("shutter: field 'samples'", samples, 1, 10000)
  if not frame then native.refuse("shutter: field 'frame' must be a function, got nil") end
  return function(f)
    local exposures = {}
    for k = 1, samples do
      local made = frame(moved(f, (k - 0.5) / samples * angle / 360))
      for _, exposure in ipairs(native.exposures("shutter: the frame function's result", made)) do
        exposures[#exposures + 1] = { exposure[1], exposure[2] * (1 / samples) }
      end
    end
    return exposures
  end
end

---@class celspan.shutter
---@overload fun(settings: table): fun(f: celspan.frame): table[]
return fields.publish("shutter", setmetatable({}, { __call = native.entry(shutter) }))
