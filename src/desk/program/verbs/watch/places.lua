--- The lines of scripts that films have named, which an editor may be asked for (celspan watch).
--
-- INVARIANT: they are in files that the films read. A script can name anything: in the message of
-- an error, or as the name of a chunk that it loads.
local program = ...
local texts = require "celspan.files"

local PLACES_MOST = 10000  -- lines
local AROUND = 3           -- lines that are shown before and after the line of an error
local LINES_MOST = 1 << 20 -- bytes of the largest script of which lines are shown

local places = {}
places.__index = places

--- files: of files.lua. known: paths by places such as "shot.lua:12".
function places.new(files)
  return setmetatable({ files = files, known = {}, count = 0 }, places)
end

local function key_of(name, line) return ("%s:%d"):format(name, line) end

--- Notes a place. Returns its path and line; nothing if the film does not read that file.
function places:note(name, line, side)
  local path = name and line and self.files:named(name, side)
  if not path then return end
  for _, one in ipairs { name, path } do
    local key = key_of(one, line)
    if not self.known[key] and self.count < PLACES_MOST then
      self.known[key], self.count = path, self.count + 1
    end
  end
  return path, line
end

--- The path of a place that was noted; nil: it was not noted.
function places:find(name, line) return self.known[key_of(name, line)] end

--- The places in a text such as "from shot.lua:40, hand.lua:7": notes them and returns { file, line
--- } of each.
function places:of_text(text, side)
  local list = {}
  for name, digits in text:gmatch "([^%s:(),]+):(%d+)" do
    local _, line = self:note(name, math.tointeger(digits), side)
    if line then list[#list + 1] = { file = name, line = line } end
  end
  return { list = list }
end

--- The lines around a line of a file that a film reads; nil: they cannot be read.
function places.excerpt(path, line)
  local text, number, lines = texts.read(path, LINES_MOST), 0, {}
  if not text then return nil end
  for one in (text:gsub("\n?$", "\n", 1)):gmatch "([^\n]*)\n" do
    number = number + 1
    if number > line + AROUND then break end
    if number >= line - AROUND then lines[#lines + 1] = { number, one:sub(1, 200) } end
  end
  return lines
end

--- The place in the film's script where the sound of a message is named; nothing: it is not.
local function place_of_sound(message, side)
  local sound = message:match "^film: sound %d+: the sound (.-) cannot "
  local text, number = sound and texts.read(side.script, LINES_MOST), 0
  for line in (text and text .. "\n" or ""):gmatch "([^\n]*)\n" do
    number = number + 1
    for _, quote in ipairs { '"', "'" } do
      if line:find(quote .. sound .. quote, 1, true) then return side.script, number end
    end
  end
end

--- An error of a film, in the form that /errors.json has.
function places:describe(message, frame, side)
  local name, named = program.place_of(message)
  if not name then name, named = place_of_sound(message, side) end
  local path, line = self:note(name, named, side)
  frame = frame or math.tointeger(message:match "frame (%-?%d+): ")
  local callers = self:of_text(message:match " %(called from ([^()]*)%)" or "", side)
  return { message = message, frame = frame, file = path, line = line, callers = callers,
           lines = path and places.excerpt(path, line) }
end

return places
