-- Modules of celspan without comments and indentation; lines keep their numbers, for messages.
--
--   lua5.4 strip.lua FOLDER FILE...       each into the folder
--   lua5.4 strip.lua OUT.json FILE...     an object: "celspan/base/csv.lua": "...", of paths that
--                                         end so
local function lines_in(text) return select(2, text:gsub("\n", "")) end

--- The end of what begins at a place, and what remains of it.
local function take(text, place)
  local level = text:match("^%-%-%[(=*)%[", place)
  if level then
    local close = select(2, text:find("]" .. level .. "]", place, true))
    return close, ("\n"):rep(lines_in(text:sub(place, close)))
  end
  if text:find("^%-%-", place) then return (text:find("\n", place, true) or #text + 1) - 1, "" end
  level = text:match("^%[(=*)%[", place)
  local close = place
  if level then
    close = select(2, text:find("]" .. level .. "]", place, true))
  elseif text:find("^[\"']", place) then
    local quote = text:sub(place, place)
    repeat
      close = text:find("[\\" .. quote .. "]", close + 1)
      local is_escape = text:sub(close, close) == "\\"
      if is_escape then close = close + 1 end
    until not is_escape
  end
  return close, text:sub(place, close)
end

local function stripped(text)
  local kept, place = {}, 1
  while place <= #text do
    local close, remains = take(text, place)
    kept[#kept + 1] = remains
    place = close + 1
  end
  return table.concat(kept)
end

--- Indentation is left out before comments are, so that long strings keep theirs.
local function module_of(path)
  local file = assert(io.open(path))
  local text = file:read "a"
  file:close()
  local short = stripped(text)
  if not short:find "%[=*%[" then short = short:gsub("[ \t]+\n", "\n"):gsub("\n[ \t]+", "\n") end
  assert(load(short, "=" .. path))
  assert(lines_in(short) == lines_in(text), path)
  return short
end

local function quoted(text)
  return '"' .. text:gsub('[%c"\\]', function(c) return ("\\u%04x"):format(c:byte()) end)
    :gsub("\\u000a", "\\n"):gsub("\\u0022", '\\"'):gsub("\\u005c", "\\\\") .. '"'
end

local function write(path, text)
  local file = assert(io.open(path, "w"))
  assert(file:write(text))
  assert(file:close())
end

local rows = {}
for i = 2, #arg do
  local path = arg[i]
  if arg[1]:find "%.json$" then
    rows[#rows + 1] = quoted(path:match "celspan/%w+/[^/]+$") .. ":" .. quoted(module_of(path))
  else
    write(arg[1] .. "/" .. path:match "[^/]+$", module_of(path))
  end
end
if arg[1]:find "%.json$" then write(arg[1], "{" .. table.concat(rows, ",\n") .. "}\n") end
