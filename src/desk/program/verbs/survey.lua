--- Surveys a film: what is seen of it, frame by frame, for `celspan describe` and `celspan check`.
--
--   every frame, once it is built --> its parts and texts, with their boxes
--                                 --> the luminances at a grid of points
--   where that seems to flash,    --> the luminances of a grid of areas, which decide: they take
--   or has one colour                 three times as long
--
-- A frame with the scene of the one before is not looked at again, and a frame without a picture
-- not at all: with scan-line procedures, or pictures that cannot be read. What is kept depends on
-- how many parts, stretches and texts with different words there are.
local program, script = ...
local celspan = require "celspan"
local native = require "celspan.native"
local flashes = program.part("flashes.lua")
local texts = program.part("texts.lua", script)

local survey = {}
survey.__index = survey

local RED, GREEN, BLUE = native.luma()
local POINTS, AREAS = 24, 48 -- points and areas along the longer side
local SEEMS = 0.2      -- the share of the points that must flash before a flash is suspected
local PARTS_MOST = 1000
local STRETCH = 1      -- stretches of at least this many seconds without a change are listed
local TITLE = 3        -- the seconds that a text may last longer than its words need
local COLLECTED = 4    -- garbage is collected after this many frames
local CUT = 0.08       -- the least mean change of luminance in a cut,
local CUT_RATIO = 3    -- and how many times greater it is than the changes before and after

--- A picture of the whole frame, with this many pixels along its longer side.
local function grid(count, antialias)
  local scale = math.min(1, count / math.max(script.size[1], script.size[2]))
  return { size = { math.max(1, math.floor(script.size[1] * scale + 0.5)),
                    math.max(1, math.floor(script.size[2] * scale + 0.5)) }, antialias = antialias }
end

local function new()
  return setmetatable({ points = grid(POINTS, "none"), areas = grid(AREAS, "area"),
                        texts = texts.new(), flashes = flashes.new(script.fps, SEEMS),
                        parts = {}, on = {}, looked = {}, empty = {}, frozen = {},
                        unseen = {}, cuts = {}, count = 0 }, survey)
end

-- ---------------------------------------------------------------- pictures

--- The relative luminances and the alphas of a picture over black, and whether it has one colour;
--- nil: it cannot be made.
local function look(exposures, view)
  local good, image = pcall(celspan.pixels, program.still(script, exposures), view)
  if not good or not image then return nil end
  local bytes = image:bytes { depth = "float", colour = "linear", alpha = "premultiplied" }
  local lights, alphas, at, is_plain = {}, {}, 1, true
  local r0, g0, b0 = ("<fff"):unpack(bytes)
  for i = 1, image.width * image.height do
    local r, g, b, a
    r, g, b, a, at = ("<ffff"):unpack(bytes, at)
    is_plain = is_plain and r == r0 and g == g0 and b == b0
    lights[i] = math.min(1, math.max(0, RED * r + GREEN * g + BLUE * b))
    alphas[i] = a
  end
  return lights, alphas, is_plain
end

-- ---------------------------------------------------------------- stretches

--- Adds a frame to a list of stretches { first =, last = }.
local function add_frame(list, frame)
  local last = list[#list]
  if last and last.last == frame - 1 then
    last.last = frame
    return last
  end
  list[#list + 1] = { first = frame, last = frame }
  return list[#list]
end

local function seconds(stretch) return (stretch.last - stretch.first + 1) / script.fps end

--- The stretches that are long enough.
local function lasting(list)
  local found = {}
  for _, stretch in ipairs(list) do
    if stretch.last > stretch.first and seconds(stretch) >= STRETCH - 1e-9 then
      found[#found + 1] = stretch
    end
  end
  return found
end

--- Whether the frame function asked an exposure sheet when the last frame was built: if so, and if
--- the frame shows the same as the one before, the sheet holds it.
function survey:has_asked()
  local before = self.asked
  self.asked = script:ask("celspan.columns", "lookups", "")
  return before ~= nil and before ~= self.asked
end

-- ---------------------------------------------------------------- parts

--- The parts that can be seen in a frame, by kind and name: { share, hash } of each.
local function seen_of(list)
  local seen, order = {}, {}
  for _, part in ipairs(list) do
    local is_listed = part.kind ~= "text" and not part.unnamed -- mostly parts of an effect
    local is_seen = is_listed and part.box and part.fade > 0
    local share = is_seen and texts.share_of(part.box) or 0
    if share > 0 then
      local key = part.kind .. " " .. part.name
      local one = seen[key]
      if not one then
        one = { key = key, kind = part.kind, name = part.name, share = 0, hash = "",
                file = part.file, line = part.line }
        seen[key], order[#order + 1] = one, one
      end
      one.share, one.hash = math.max(one.share, share), one.hash .. part.drawing .. part.placement
    end
  end
  return order
end

--- The part of the film that has this key; nil: there are too many parts.
function survey:part_of(one)
  local part = self.parts[one.key]
  if not part and #self.parts == PARTS_MOST then
    self.has_more = true
    return nil
  end
  if not part then
    part = { kind = one.kind, name = one.name, file = one.file, line = one.line, share = 0,
             moves = false, on = {} }
    self.parts[one.key], self.parts[#self.parts + 1] = part, part
  end
  return part
end

function survey:add_parts(number, list)
  local on = {}
  for _, one in ipairs(seen_of(list)) do
    local part = self:part_of(one)
    if part then
      local stretch = add_frame(part.on, number)
      part.moves = part.moves or stretch.first < number and part.hash ~= one.hash
      part.share, part.hash = math.max(part.share, one.share), one.hash
      on[#on + 1] = part
    end
  end
  self.on = on
end

-- ---------------------------------------------------------------- cuts

--- Adds the difference between a frame and the previous one. The difference at a cut is much
--- greater than its neighbours.
function survey:add_change(number, change)
  local before, middle = self.before or 0, self.middle
  if middle and middle.change > CUT
    and middle.change > CUT_RATIO * math.max(before, change) then
    table.insert(self.cuts, middle.number)
  end
  self.before = middle and middle.change or 0
  self.middle = { number = number, change = change }
end

--- The stretches between cuts, and between frames that were not examined.
function survey:shots()
  local shots, cut = {}, {}
  for _, number in ipairs(self.cuts) do cut[number] = true end
  for _, run in ipairs(self.looked) do
    shots[#shots + 1] = { first = run.first }
    for number = run.first, run.last do
      if cut[number] then shots[#shots + 1] = { first = number } end
      shots[#shots].last = number
    end
  end
  return shots
end

local function mean_change(a, b)
  local sum = 0
  for i, light in ipairs(a) do sum = sum + math.abs(light - b[i]) end
  return sum / #a
end

-- ---------------------------------------------------------------- frames

--- Adds a frame of the same scene as the previous one.
function survey:again(number, has_asked)
  local stretch = self.frozen[#self.frozen]
  if not stretch or stretch.last ~= number - 1 then
    stretch = { first = number - 1, last = number, is_held = true }
    table.insert(self.frozen, stretch)
  end
  stretch.last, stretch.is_held = number, stretch.is_held and has_asked
  for _, part in ipairs(self.on) do add_frame(part.on, number) end
  if self.is_plain then add_frame(self.empty, number) end
  self.texts:again(number)
  self:add_change(number, 0)
end

--- Forgets the previous frame, because this one does not follow it.
function survey:cut()
  self.scene, self.lights, self.middle, self.before = nil, nil, nil, nil
  self.flashes:cut()
  self.texts:cut()
end

--- Examines the frame that was built last.
function survey:add_new(number)
  local parts = native.parts(script:exposures(), script.size[1], script.size[2])
  local lights, _, is_plain = look(script:exposures(), self.points)
  if is_plain then is_plain = select(3, look(script:exposures(), self.areas)) end
  self:add_parts(number, parts)
  self.is_plain = is_plain
  if not lights then
    add_frame(self.unseen, number)
    return self:cut()
  end
  if is_plain then add_frame(self.empty, number) end
  self.texts:add(number, parts, look)
  self.flashes:add(number, lights)
  self:add_change(number, self.lights and mean_change(self.lights, lights) or 0)
  self.lights = lights
end

--- Adds the frame `number`, which was built last.
function survey:add(number)
  local scene, has_asked = script:scene(), self:has_asked()
  if self.number ~= number - 1 then self:cut() end
  self.number = number
  add_frame(self.looked, number)
  if scene and scene == self.scene then return self:again(number, has_asked) end
  self.scene = scene -- add_new sets it to nil if there is no picture
  if scene then
    self:add_new(number)
    self.count = self.count + 1
    -- values of Lua are small, but each may hold the scene of a frame
    if self.count % COLLECTED == 0 then collectgarbage() end
  else
    add_frame(self.unseen, number)
    self:cut()
  end
end

-- ---------------------------------------------------------------- what was found

--- The frozen stretches, except those in which nothing can be seen.
function survey:still()
  local found = {}
  for _, stretch in ipairs(lasting(self.frozen)) do
    local is_empty = false
    for _, one in ipairs(self.empty) do
      is_empty = is_empty or one.first <= stretch.first and one.last >= stretch.last
    end
    if not is_empty then found[#found + 1] = stretch end
  end
  return found
end

function survey:blank() return lasting(self.empty) end

--- Examines a stretch of frames with a suspected flash, and the second before it, again by areas.
function survey:add_sure(list, stretch)
  local sure, first = flashes.new(script.fps), stretch.first
  for _, run in ipairs(self.looked) do
    if stretch.first >= run.first and stretch.first <= run.last then
      first = math.max(run.first, stretch.first - math.ceil(script.fps))
    end
  end
  for number = first, stretch.last do
    local lights = script:try(number) and look(script:exposures(), self.areas)
    if lights then sure:add(number, lights) end
    collectgarbage()
  end
  table.move(sure.list, 1, #sure.list, #list + 1, list)
end

--- The stretches that flash. In fine patterns that move, points flash, but areas do not.
function survey:flashing()
  local list = {}
  script:silence(true) -- the output of the script for these frames has been shown already
  for _, stretch in ipairs(self.flashes.list) do self:add_sure(list, stretch) end
  script:silence(false)
  return list
end

--- How long a text is shown; nil: the frames before or after it were not examined.
function survey:shown_seconds(text)
  for _, run in ipairs(self.looked) do
    if text.first >= run.first and text.last <= run.last then
      local begins = text.first > run.first or text.first == script.first
      local ends = text.last < run.last or text.last == script.first + script.frames - 1
      return begins and ends and seconds(text) or nil
    end
  end
end

--- Whether the texts of a stretch may remain as long as the stretch lasts.
function survey:is_read(stretch)
  local count = 0
  for _, text in ipairs(self.texts.list) do
    local is_in = text.first <= stretch.last and text.last >= stretch.first
    count = count + (is_in and texts.words_in(text.words) or 0)
  end
  return count > 0 and seconds(stretch) <= texts.needed(count) + TITLE
end

--- Things that could harm or annoy a viewer: a list of { message =, first =, last = }.
function survey:warnings()
  local list = {}
  local function add(stretch, ...)
    list[#list + 1] = { message = string.format(...), first = stretch.first, last = stretch.last }
  end
  for _, text in ipairs(self.texts.list) do
    local name = "the text " .. texts.quoted(text.words)
      .. (text.file and (" (%s:%d)"):format(text.file, text.line) or "")
    texts.judge(text, self:shown_seconds(text), function(format, ...)
      add(text, "%s %s", name, format:format(...))
    end)
  end
  for _, stretch in ipairs(self:blank()) do
    add(stretch, "nothing but one colour is seen for %.4g s", seconds(stretch))
  end
  for _, stretch in ipairs(self:still()) do
    if not stretch.is_held and not self:is_read(stretch) then
      add(stretch, "nothing changes for %.4g s, and no exposure sheet holds it", seconds(stretch))
    end
  end
  for _, stretch in ipairs(self:flashing()) do
    add(stretch, "more than three flashes in a second, over %d %% of the frame, may cause seizures "
      .. "(WCAG 2.3.1)", math.floor(stretch.share * 100 + 0.5))
  end
  table.sort(list, function(a, b)
    if a.first ~= b.first then return a.first < b.first end
    return a.message < b.message
  end)
  return list
end

--- The film as tables, for `celspan describe`. Stretches have the frames `first` and `last`, and
--- the times `from` and `to` in seconds of the film.
function survey:facts()
  local function timed(stretch, more)
    more = more or {}
    more.first, more.last = stretch.first, stretch.last
    more.from = (stretch.first - script.first) / script.fps
    more.to = (stretch.last - script.first + 1) / script.fps
    return more
  end
  local function all(stretches, make)
    local list = {}
    for i, one in ipairs(stretches) do list[i] = timed(one, make and make(one)) end
    return list
  end
  local function of_part(part)
    return { kind = part.kind, name = part.name, file = part.file, line = part.line,
             share = part.share, moves = part.moves, on = all(part.on) }
  end
  local parts = {}
  for i, part in ipairs(self.parts) do parts[i] = of_part(part) end
  return {
    shots = all(self:shots()), parts = parts, more = self.has_more or self.texts.has_more or false,
    texts = all(self.texts.list, function(text)
      return { words = text.words, pixels = text.pixels, share = text.share, moves = text.moves,
               contrast = text.contrast, covered = text.covered, file = text.file,
               line = text.line }
    end),
    empty = all(self:blank()), unseen = all(self.unseen),
    frozen = all(self:still(), function(one) return { held = one.is_held } end),
    flashes = all(self:flashing(), function(one) return { share = one.share } end),
  }
end

return new()
