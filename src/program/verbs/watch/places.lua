--- The lines of scripts that films have named, which an editor may be asked for (celspan watch).
local program = ...

local PLACES_MOST = 10000  -- lines
local AROUND = 3           -- lines shown before and after that of an error
local LINES_MOST = 1 << 20 -- bytes of a script of which lines are shown

local places = {}
places.__index = places

--- files: of files.lua.
function places.new(files)
  return setmetatable({ files = files, known = {}, count = 0 }, places) -- keys: "shot.lua:12"
end

local function key_of(path, line) return ("%s:%d"):format(path, line) end

function places:note(path, line)
  local key = path and line and key_of(path, line)
  if not key or self.known[key] or self.count == PLACES_MOST then return end
  self.known[key], self.count = true, self.count + 1
end

function places:has(path, line) return self.known[key_of(path, line)] end

--- The places in a text such as "from shot.lua:40, hand.lua:7", which are noted: { file, line }.
function places:of_text(text)
  local list = {}
  for path, line in text:gmatch "([^%s:(),]+):(%d+)" do
    list[#list + 1] = { file = path, line = math.tointeger(line) }
    self:note(path, math.tointeger(line))
  end
  return { list = list }
end

--- The lines around one of a file that a film has asked for; nil: they cannot be read.
function places:excerpt(path, line, film)
  local opened = self.files:has(path, film) and io.open(path, "rb")
  if not opened then return nil end
  local text, number, lines = opened:read(LINES_MOST) or "", 0, {}
  opened:close()
  for one in (text:gsub("\n?$", "\n", 1)):gmatch "([^\n]*)\n" do
    number = number + 1
    if number > line + AROUND then break end
    if number >= line - AROUND then lines[#lines + 1] = { number, one:sub(1, 200) } end
  end
  return lines
end

--- An error of a film as /errors.json lists it.
function places:describe(message, frame, film)
  local path, line = program.place_of(message)
  self:note(path, line)
  frame = frame or math.tointeger(message:match "frame (%-?%d+): ")
  local callers = self:of_text(message:match " %(called from ([^()]*)%)" or "")
  return { message = message, frame = frame, file = path, line = line, callers = callers,
           lines = path and self:excerpt(path, line, film) }
end

return places
