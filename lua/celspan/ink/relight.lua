--- Removes the light from pictures, so that they can be relit.
--
--   local house = assert(relight.from { picture = "house.jpg", light = "#ffe0b0" })
--   local cel = celspan.cel { celspan.rect { 0, 0, 1920, 1080, texture = house }, front = dusk }
--   assert(relight.write(house, "house.exr"))                   -- and relight.read "house.exr"
--
-- The result is a texture with its own S, T and beta: as paint it scatters S times the front light,
-- and lets T of the light behind it through. Under its original light it is the picture again,
-- including highlights.
local celspan = require "celspan"
local native = require "celspan.native"
local fields = require "celspan.fields"

local relight = {}

local WHITE = { 1, 1, 1 }
local GREY = { 0.18, 0.18, 0.18 }
local clues = { grey = 0, patch = 1, light = 2 }

-- ---------------------------------------------------------------- what is given

--- A colour string as three numbers in linear light; nil for any other value.
local function parse(text)
  if type(text) ~= "string" then return nil end
  local good, paint = pcall(celspan.rgb, text)
  return good and paint.beta == 1 and paint.pigment or nil
end

--- Raises an error at the line of the nearest caller outside celspan.
local function refuse(text, ...) native.refuse("relight: " .. text:format(...)) end

local function numbers_of(name, value, count, shape)
  fields.expect_kind(type(value) == "table", value, "relight: %s must be %s", name, shape)
  for i = 1, count do
    fields.expect(fields.is_finite(value[i]), value[i],
      "relight: %s[%d] must be a finite number", name, i)
  end
  return value
end

--- A light or a pigment: {r, g, b}, or a colour.
local function colour_of(name, value)
  local colour = parse(value) or value
  if type(colour) == "string" then
    refuse('%s must be {r, g, b} or a colour like "#ffe0b0", got "%s"', name, value)
  end
  numbers_of(name, colour, 3, "{r, g, b} or a colour")
  for i = 1, 3 do
    fields.expect(colour[i] >= 0, colour[i], "relight: %s[%d] must be 0 or more", name, i)
  end
  return colour
end

--- A picture: a file name or a celspan.picture.
local function picture_of(name, value)
  if type(value) == "string" then return celspan.picture { file = value } end
  fields.expect_kind(type(value) == "userdata" and tostring(value):find "^picture", value,
    "relight: %s must be a file's name or a celspan.picture", name)
  return value
end

-- ---------------------------------------------------------------- lights

--- The given facts about the light: the kind of clue, a colour, and a patch.
local function clue_of(options, estimate)
  if options.light then return clues.light, colour_of("light", options.light) end
  if type(estimate) == "string" then return clues.grey, GREY end
  return clues.patch, colour_of("estimate.colour", estimate.colour or GREY),
    numbers_of("estimate.at", estimate.at, 4, "{x, y, w, h}")
end

--- The field of the light, and the same light as a value for `front`.
local function find_light(picture, options, estimate)
  local clue, colour, patch = clue_of(options, estimate)
  local uneven = options.uneven
  if clue == clues.light and not uneven then return colour, colour end
  local blank = uneven and uneven ~= true and picture_of("uneven", uneven) or nil
  local field, message = native.light_estimate(picture, clue, colour, patch,
    uneven and true or false, blank)
  if not field then return nil, message end
  if not uneven then return field, field end
  local w, h = native.picture_size(picture)
  if not w then return nil, h end
  local shape, problem = native.light_shape(field, w, h)
  return shape and field, shape or problem
end

-- ---------------------------------------------------------------- ways

local function from_picture(options)
  local estimate = options.estimate
  if (options.light == nil) == (estimate == nil) then
    refuse "a picture needs its light or an estimate of it, but not both"
  end
  if type(estimate) == "table" then
    estimate = fields.check("relight: estimate", estimate, { at = "any", colour = "any" })
  elseif estimate ~= nil and (native.synonym(tostring(estimate)) or estimate) ~= "grey" then
    refuse('estimate must be "grey" or { at = {x, y, w, h}, colour = ... }, got %s',
      type(estimate) == "string" and ("%q"):format(estimate) or fields.kind(estimate))
  end
  local picture = picture_of("picture", options.picture)
  local field, light = find_light(picture, options, estimate)
  if not field then return nil, light end
  local texture, message = native.relight_picture(picture, field)
  return texture, texture and light or message
end

local function from_exposures(options)
  local known = { picture = "any", light = "any" }
  local front, back = options.front, options.back
  if front == nil or back == nil then
    refuse "two exposures are front = { picture =, light = } and back = { picture =, light = }"
  end
  fields.check("relight: front", front, known)
  fields.check("relight: back", back, known)
  local light = colour_of("front.light", front.light)
  local texture, message = native.relight_exposures(picture_of("front.picture", front.picture),
    light, picture_of("back.picture", back.picture), colour_of("back.light", back.light))
  return texture, texture and light or message
end

--- A ground: its picture, or the light that it gives.
local function ground_of(name, value)
  local is_colour = type(value) == "table" or parse(value)
  return is_colour and colour_of(name, value) or picture_of(name, value)
end

local function from_grounds(options)
  local over = options.over
  if type(over) ~= "table" or #over ~= 2 then
    refuse "over must be two pictures, { { picture =, ground = }, { picture =, ground = } }"
  end
  local given = {}
  for i, shot in ipairs(over) do
    local name = ("over[%d]"):format(i)
    fields.check("relight: " .. name, shot, { picture = "any", ground = "any" })
    given[2 * i - 1] = picture_of(name .. ".picture", shot.picture)
    given[2 * i] = ground_of(name .. ".ground", shot.ground)
  end
  given[5] = colour_of("light", options.light or WHITE)
  local texture, message = native.relight_grounds(table.unpack(given))
  return texture, texture and given[5] or message
end

-- ---------------------------------------------------------------- the module

---@class celspan.relight.options
---@field picture? string|celspan.texture A file name or a celspan.picture
---@field light? number[]|string The light in the picture; with `over` the light in both, default white
---@field estimate? "grey"|{at: number[], colour?: number[]|string} Instead of the light: the mean of the picture is a grey of 0.18; or the pigment of a patch, x, y, w, h in pixels
---@field uneven? boolean|string|celspan.texture The light varies slowly: like the picture's own brightness, or like that of a picture of a white or grey surface
---@field front? {picture: string|celspan.texture, light: number[]|string} Lit only from the front
---@field back? {picture: string|celspan.texture, light: number[]|string} Lit only from behind
---@field over? {picture: string|celspan.texture, ground: string|number[]|celspan.texture}[] Two pictures, in front of two grounds

local known = { picture = "any", light = "any", estimate = "any", uneven = "any", front = "table",
  back = "table", over = "table" }

--- For each way to give the pictures: its fields and its function.
local ways = {
  { "picture", from_picture, { picture = true, light = true, estimate = true, uneven = true } },
  { "front", from_exposures, { front = true, back = true } },
  { "over", from_grounds, { over = true, light = true } },
}

---@param options celspan.relight.options
---@return celspan.texture? texture
---@return number[]|celspan.texture|string light The original light, for use as `front`; or the message
function relight.from(options)
  fields.check("relight", options, known)
  for _, way in ipairs(ways) do
    if options[way[1]] ~= nil then
      for name in pairs(options) do
        if not way[3][name] then
          refuse("'%s' cannot be combined with '%s'", name, way[1])
        end
      end
      return way[2](options)
    end
  end
  refuse "it takes a picture, or front and back, or over"
end

--- Stores a relit picture, or any picture, as an EXR file of seven channels.
---@param texture celspan.texture
---@param path string With the extension .exr
---@return true?
---@return string? message
function relight.write(texture, path)
  local noun = tostring(texture)
  if type(texture) ~= "userdata" or not (noun:find "^relit" or noun:find "^picture") then
    refuse("write takes a relit picture, got %s", fields.kind(texture))
  end
  fields.takes("relight: write", "string", "the name of a file", path)
  return native.relight_write(texture, path)
end

---@param path string Relative to the caller's file, else to the script
---@return celspan.texture? texture
---@return string? message
function relight.read(path)
  fields.takes("relight: read", "string", "the name of a file", path)
  return native.relight_read(path)
end

-- ---------------------------------------------------------------- frames taken apart

---@class celspan.relight.stack
---@field width integer Of the frame, in pixels
---@field height integer
---@field bytes integer The size of its rows of spans
local Stack = { __name = "celspan.relight.stack" }
local methods = {}
Stack.__index = fields.reads("a stack", methods)

--- The data of stacks, hidden from scripts: the core's value, facts about the cels, and the
--- rostrum's own lights.
local behind = setmetatable({}, { __mode = "k" })

local NUMBERS = 8 -- for each cel: r, g, b, a of its front light and of its back light

--- A frame whose lights can be changed without rendering it again.
---@param rostrum celspan.rostrum|celspan.film
---@param options? celspan.pixels.options
---@return celspan.relight.stack? stack
---@return string? message
function relight.stack(rostrum, options)
  local stack, facts = native.stack(rostrum, options)
  if not stack then return nil, facts end
  local self = setmetatable({ width = math.tointeger(facts.width),
    height = math.tointeger(facts.height), bytes = math.tointeger(facts.bytes) }, Stack)
  behind[self] = { stack = stack, cels = facts.cels, brightness = facts.brightness,
    mixes_codes = facts.mixes_codes, own = native.stack_lights(stack) }
  return self
end

--- {r, g, b} or {r, g, b, a}, or a colour, which is converted where codes are mixed.
local function light_of(self, name, value)
  local alpha = type(value) == "table" and value[4]
  local colour = colour_of(name, value)
  if self.mixes_codes and type(value) == "string" then
    colour = { native.code(colour[1]), native.code(colour[2]), native.code(colour[3]) }
  end
  fields.expect(not alpha or fields.is_finite(alpha) and alpha >= 0 and alpha <= 1, alpha,
    "relight: %s[4] must be from 0 to 1", name)
  return colour, alpha or 1
end

--- Sets a light of cel i (0 for the rostrum) in the list of numbers.
local function set_light(self, lights, i, which, name, value)
  local colour, alpha = light_of(self, name, value)
  local first = NUMBERS * i + (which == "back" and 4 or 0)
  for c = 1, 3 do lights[first + c] = colour[c] * self.brightness end
  lights[first + 4] = alpha
end

--- The indices for a key: a cel's index, 0 for the rostrum, or those of all cels with a name.
local function places_of(self, key)
  local places = {}
  if math.type(key) == "integer" and key >= 0 and key <= #self.cels then return { key } end
  for i, cel in ipairs(self.cels) do
    if cel.name == key then places[#places + 1] = i end
  end
  if #places > 0 then return places end
  local names = {}
  for _, cel in ipairs(self.cels) do names[#names + 1] = cel.name ~= "" and cel.name or nil end
  refuse("light: there is no cel '%s'%s", fields.key(key), fields.hint(key, names) or "")
end

--- The front light of the rostrum lights all cels that have no front light.
local function set_lights(self, lights, i, given)
  local name = ("light[%s]"):format(i)
  if given.back then set_light(self, lights, i, "back", name .. ".back", given.back) end
  if not given.front then return end
  for place, cel in ipairs(self.cels) do
    if place == i or i == 0 and not cel.has_front then
      set_light(self, lights, place, "front", name .. ".front", given.front)
    end
  end
end

--- The types of the keys of changes, in the order in which they are applied; others come last, and
--- are refused.
local ranks = { string = 1, number = 2 }

--- The frame in other lights; lights that are not given do not change.
---@param changes? table<string|integer, {front: number[]|string, back: number[]|string}> By the names or positions of cels; 0: of the rostrum itself
---@return celspan.pixels.image? image
---@return string? message
function methods:light(changes)
  fields.self("relight", Stack, self, "light")
  local self_behind = behind[self]
  local lights, keys = table.move(self_behind.own, 1, #self_behind.own, 1, {}), {}
  fields.expect_kind(changes == nil or type(changes) == "table", changes,
    "relight: light takes a table")
  for key in pairs(changes or {}) do keys[#keys + 1] = key end
  table.sort(keys, function(a, b) -- positions override names, and cels override the rostrum
    local rank_a, rank_b = ranks[type(a)] or 3, ranks[type(b)] or 3
    if rank_a ~= rank_b or rank_a == 3 then return rank_a < rank_b end
    return a < b
  end)
  for _, key in ipairs(keys) do
    fields.check("relight: light", changes[key], { front = "any", back = "any" })
    for _, i in ipairs(places_of(self_behind, key)) do
      set_lights(self_behind, lights, i, changes[key])
    end
  end
  return native.stack_light(self_behind.stack, lights)
end

return fields.publish("relight", relight, methods)
