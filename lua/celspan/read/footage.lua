--- Footage: the pictures of a movie, or of numbered files, by their times: celspan.footage.
--
--   file   |  1  |  2  |  3  |  4  |  5  |  6  |      seconds of the file
--              from ^                  ^ to
--   clip         |  1  |  2  |  3  |                  from its `from`; divided by its speed
--
--   clip:at(seconds)   the last picture whose time is at most that, as far as the clock is exact
local celspan = require "celspan"
local native = require "celspan.native"
local fields = require "celspan.fields"

local footage = {}

local RATE = 24 -- pictures a second of numbered files
local FASTEST = 1000 -- of a speed
local RANGES = 8 -- of missing files in a message
local HIGH = { smpte2084 = "PQ", ["arib-std-b67"] = "HLG" } -- curves of high dynamic range
local KEPT = 8 -- numbered files that stay open though no frame shows them

local function refuse(text, ...) native.refuse("footage: " .. text:format(...)) end

--- Refuses because files are not there, which is no fault of the script.
local function miss(text, ...) native.miss("footage", text:format(...)) end

--- The methods of a clip, celspan.footage; celspan.annotations lists its fields.
local Clip = {}

--- What is hidden from scripts: source, first, last, from, length (seconds of the file), speed,
--- loop.
local data_of = setmetatable({}, { __mode = "k" })

local metatable = {
  __name = "celspan.footage",
  __index = fields.reads("footage", Clip),
  __newindex = function() refuse "clips are immutable" end,
}

-- ---------------------------------------------------------------- sources

-- A source has: size, fps, count, finish (seconds at which its last picture ends), slack (by how
-- many seconds its times may be too late), sound, time(i) (seconds of picture i, from 1),
-- texture(i).

--- "1003-1005, 1010": the numbers that a list leaves out.
local function missing_in(numbers)
  local ranges, count = {}, 0
  for i = 2, #numbers do
    local first, last = numbers[i - 1] + 1, numbers[i] - 1
    if first <= last then
      count = count + last - first + 1
      ranges[#ranges + 1] = first == last and ("%d"):format(first) or ("%d-%d"):format(first, last)
    end
  end
  if #ranges > RANGES then
    ranges[RANGES + 1] = ("and more up to %d"):format(numbers[#numbers])
  end
  return table.concat(ranges, ", ", 1, math.min(#ranges, RANGES + 1)), count
end

--- The numbers of the files of a pattern.
local function find_numbers(pattern)
  local found_at, tried = native.find(pattern)
  local numbers, message = native.frames(found_at)
  if tried and (not numbers or #numbers == 0) then numbers = native.frames(tried) or numbers end
  if not numbers then refuse("%s", message) end
  if #numbers == 0 then
    miss("%s: there are no such files%s", pattern,
      tried and "; also looked for at " .. tried or "")
  end
  return numbers
end

--- A function texture(i), and the size. Files are opened when they are seen: the first one at once,
--- for its size.
local function open_textures(given, numbers)
  local textures, kept = setmetatable({}, { __mode = "v" }), {}
  local function open(i)
    local found = celspan.picture { file = given.file, frame = numbers[i], colour = given.colour,
                                    layer = given.layer }
    return found, native.picture_size(found)
  end
  local first, width, height = open(1)
  return function(i)
    local found = i == 1 and first or textures[i]
    if not found then
      local w, h
      found, w, h = open(i)
      if w ~= width or h ~= height then
        refuse("%s: number %d has %d x %d pixels, and the first one %d x %d: all must have one "
          .. "size", given.file, numbers[i], w, h, width, height)
      end
      textures[i] = found
      kept[#kept + 1] = found
      if #kept > KEPT then table.remove(kept, 1) end
    end
    return found
  end, { width, height }
end

local function open_files(given)
  local numbers = find_numbers(given.file)
  local missing, count = missing_in(numbers)
  if count > 0 then
    miss("%s: %s missing: %s", given.file, count == 1 and "a file is" or count .. " files are",
      missing)
  end
  if given.alpha then
    refuse "field 'alpha' is for movies; the alpha of numbered files is that of their format"
  end
  local fps = given.fps or RATE
  fields.must(fps > 0, "footage: field 'fps'", "above 0", fps)
  local texture, size = open_textures(given, numbers)
  return { size = size, fps = fps, count = #numbers, finish = #numbers / fps, slack = 1e-6,
           sound = false, time = function(i) return (i - 1) / fps end, texture = texture }
end

--- The upright size, with square pixels: the side that grows is the stored width.
local function size_of(facts)
  local aspect = facts.aspect or { 1, 1 }
  local width, height = facts.width * aspect[1] / aspect[2], facts.height
  width = math.max(1, math.floor(width + .5))
  if facts.turns % 2 == 1 then width, height = height, width end
  return { width, height }
end

--- What the codes of a movie may mean. Spaces of a configuration are for files of pictures.
local OWN = { srgb = true, linear = true, rec709 = true, cineon = true }

local function check_transfer(given, facts)
  if given.colour and not OWN[given.colour] then
    refuse("%s: colour %q is for numbered pictures; a movie takes \"srgb\", \"linear\", \"rec709\" "
      .. "or \"cineon\": make pictures of it, ffmpeg -i MOVIE plate.%%04d.png", given.file,
      given.colour)
  end
  if facts.high and not given.colour then
    refuse("%s is of high dynamic range (%s), which is not read: convert it to BT.709, or give "
      .. "'colour' to take its codes as they are", given.file, facts.high)
  end
end

--- What there is to know about a movie: the facts of native.movie with size, fps, tick (seconds),
--- finish (seconds at which the last picture ends), high (the name of a high dynamic range) and
--- time(i); or nil and a message.
function footage.describe(path, tried)
  local facts, message = native.movie(path, tried)
  if not facts then return nil, message end
  local tick = facts.tick[1] / facts.tick[2]
  local function ticks(i) return (("=i8"):unpack(facts.times, i * 8 - 7)) end
  local first, fps = ticks(1), facts.rate and facts.rate[1] / facts.rate[2]
  local last = facts.last > 0 and facts.last * tick or fps and 1 / fps or tick
  facts.size, facts.tick, facts.high = size_of(facts), tick, HIGH[facts.transfer]
  facts.finish = (ticks(facts.count) - first) * tick + last
  facts.fps = fps or facts.count / facts.finish
  -- Where a picture lasts a whole number of ticks, times are exact; elsewhere they are rounded, and
  -- half a tick too late at most.
  local lasting = 1 / (facts.fps * tick)
  facts.slack = math.abs(lasting - math.floor(lasting + .5)) < 1e-6 and 1e-6 or tick / 2
  function facts.time(i) return (ticks(i) - first) * tick end
  return facts
end

local function open_movie(given, facts)
  check_transfer(given, facts)
  if given.fps or given.layer then
    refuse("field '%s' is for numbered files; %s is a movie", given.fps and "fps" or "layer",
      given.file)
  end
  local textures, premultiplied = setmetatable({}, { __mode = "v" }), given.alpha == "premultiplied"
  function facts.texture(i)
    textures[i] = textures[i] or celspan.picture { colour = given.colour or "srgb",
      pixels = facts.picture(i, premultiplied) }
    return textures[i]
  end
  return facts
end

-- ---------------------------------------------------------------- times

--- The last picture of a source whose time is at most `seconds`, as far as its clock is exact; at
--- least 1.
local function place_at(source, seconds)
  local low, high = 1, source.count
  seconds = seconds + source.slack
  while low < high do
    local middle = (low + high + 1) // 2
    if source.time(middle) <= seconds then
      low = middle
    else
      high = middle - 1
    end
  end
  return low
end

--- The last picture that begins before a time.
local function place_before(source, seconds)
  local place = place_at(source, seconds)
  if place > 1 and source.time(place) >= seconds - source.slack then place = place - 1 end
  return place
end

--- What is said of a movie that is not there, or of any in a host that reads none.
local ABSENT = { "No such file", "Not a directory", "by the program celspan alone" }

local function is_absent(message)
  for _, words in ipairs(ABSENT) do
    if message:find(words, 1, true) then return true end
  end
  return false
end

--- A movie may have a name such as take#3.mp4, too.
local function open_source(given)
  local facts, message = footage.describe(native.find(given.file))
  if facts then return open_movie(given, facts) end
  local is_numbered = given.file:find "#" or given.file:find "%%0?%d*d"
  if is_numbered and is_absent(message) then return open_files(given) end
  refuse("%s", message)
end

local function check_times(given, source)
  local from, to, speed = given.from or 0, given.to, given.speed or 1
  fields.must(speed > 0 and speed <= FASTEST, "footage: field 'speed'",
    ("above 0 and at most %d"):format(FASTEST), speed)
  fields.expect(from >= 0 and from < source.finish, from,
    "footage: field 'from' must be from 0 to before the end, at %.6g seconds", source.finish)
  fields.expect(not to or to > from, to,
    "footage: field 'to' must be above 'from', %s", fields.shown(from))
  return from, math.min(to or source.finish, source.finish), speed
end

-- ---------------------------------------------------------------- clips

local function check_words(given)
  if given.alpha and given.alpha ~= "straight" and given.alpha ~= "premultiplied" then
    refuse("field 'alpha' must be \"straight\" or \"premultiplied\", got %q", given.alpha)
  end
  if not given.file then refuse "field 'file' must be a string, got nil" end
end

--- Opens a movie, or numbered files such as "plate.####.exr".
---@param options { file: string, from?: number, to?: number, speed?: number, loop?: boolean, fps?: number, alpha?: "straight"|"premultiplied", colour?: string, layer?: string }
---@return celspan.footage
function footage.open(options)
  options = fields.check("footage", options, { file = "string", from = "number", to = "number",
    speed = "number", loop = "boolean", fps = "number", alpha = "string", colour = "string",
    layer = "string" })
  check_words(options)
  local source = open_source(options)
  local from, to, speed = check_times(options, source)
  local first = place_at(source, from)
  local last = math.max(first, place_before(source, to))
  local clip = setmetatable({ size = source.size, fps = source.fps, frames = last - first + 1,
    seconds = (to - from) / speed, sound = source.sound }, metatable)
  data_of[clip] = { source = source, first = first, last = last, from = from, length = to - from,
                    speed = speed, loop = options.loop }
  return clip
end

--- The picture that is shown at a time; before the first one the first, after the end the last, or
--- from the start again with `loop`.
function Clip:at(seconds)
  fields.check_at("footage", metatable, self, seconds, "seconds")
  local data = data_of[self]
  local since, slack = seconds * data.speed, data.source.slack
  if data.loop then since = (since + slack) % data.length - slack end
  local place = place_at(data.source, data.from + math.max(0, math.min(since, data.length)))
  return data.source.texture(math.max(data.first, math.min(place, data.last)))
end

--- The picture with this number, from 1; beyond the ends as at those times.
function Clip:frame(number)
  fields.self("footage", metatable, self, "frame")
  fields.expect(fields.is_finite(number) and number == math.floor(number), number,
    "footage: frame takes a whole number from 1")
  local data = data_of[self]
  local place = data.loop and (number - 1) % self.frames or math.min(number, self.frames) - 1
  return data.source.texture(data.first + math.tointeger(math.max(0, place)))
end

return fields.publish("footage", footage, Clip)
