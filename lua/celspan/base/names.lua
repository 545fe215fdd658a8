--- celspan's names without a prefix: of the globals of scripts, and of one file by celspan.names.
--
--   circle          a local, then a global, then celspan.circle
--   ease            ..., then the module celspan.ease
--   count           if the text of the file assigns it anywhere: a global of the script, or nil
--
-- src/kit/lua/bind/names.h keeps what was found, so that it costs no call to read a name again.
local celspan = require "celspan"
local native = require "celspan.native"
local fields = require "celspan.fields"

local names = {}

local TEXT_MOST = 256 << 20

-- Modules whose names scripts do not use for things of their own.
local module_of = { color = "celspan.colour" }
for _, name in ipairs { "chart", "colour", "cut", "ease", "keys", "lips", "motion", "multiplane",
                        "particles", "puppet", "shutter", "svg", "typewriter" } do
  module_of[name] = "celspan." .. name
end

--- What a name stands for, or nil.
local function value_of(name)
  if module_of[name] then return require(module_of[name]) end
  return name == "celspan" and celspan or name:sub(1, 1) ~= "_" and native.own(name) or nil
end

--- All names, sorted, each with the name of its module or false.
function names.list()
  local list = {}
  for _, known in ipairs { native.own(), module_of } do
    for name in pairs(known) do
      if name ~= "_VERSION" then list[#list + 1] = name end
    end
  end
  table.sort(list)
  return list, module_of
end

-- ---------------------------------------------------------------- what a file assigns

--- The names that a text may assign.
local function candidates_in(text)
  local list, own = {}, native.own()
  for name in next, native.assignable(text) do
    if own[name] or module_of[name] then list[#list + 1] = name end
  end
  return list
end

--- The names that a text assigns as globals, with the line. Lua itself knows what is a local: here
--- the names are constants, and it refuses to assign one.
function names.assigned(text)
  local list, found = candidates_in(text), {}
  local count = #list + 1
  text = text:gsub("^\xEF\xBB\xBF", ""):gsub("^#[^\n]*", "")
  while #list > 0 and #list < count do
    count = #list
    local message = native.refusal(("local %s <const> = nil return function(...) %s\nend"):format(
      table.concat(list, " <const> = nil local "), text))
    local line, name = (message or ""):match ":(%d+): attempt to assign to const variable '(.-)'"
    for i = #list, 1, -1 do
      if list[i] == name then found[table.remove(list, i)] = tonumber(line) end
    end
  end
  return found
end

--- The text of a file by Lua's name of it, which for a text is the text itself; nil and a message,
--- if it cannot be read.
local function text_of(source)
  local path = source:match "^@(.*)$"
  if path then return native.file_text(path, TEXT_MOST) end
  return source:sub(1, 1) ~= "=" and source or ""
end

-- ---------------------------------------------------------------- globals

local assigned, is_read = {}, {} -- by name, the lines by file; by file

local function read(source, text)
  is_read[source] = true
  for name, line in pairs(names.assigned(text)) do
    assigned[name] = assigned[name] or {}
    assigned[name][source] = line
  end
end

--- Reads the files that were loaded since the last call, and forgets them.
local function read_all(files)
  for source, text in pairs(files) do
    local message
    if not text then text, message = text_of(source) end
    read(source, text or error(message, 0))
    files[source] = nil
  end
end

--- What a global that has no value is in a file. If it is the same in all files, it is kept in the
--- table of those without a value, or of those that were found: nil, if not all files are noted.
function names.find(found, missing, name, source, files)
  read_all(files)
  if not is_read[source] then read(source, text_of(source) or "") end
  local by = assigned[name]
  if by and by[source] then return nil end
  local value = value_of(name)
  if value == nil then missing[name] = true end
  if value ~= nil and found and not by then rawset(found, name, value) end
  return value
end

--- The end of a message about a global without a value: "; did you mean 'circle'?", or "".
function names.hint(name, globals)
  local _, message = pcall(function() return celspan[name] end)
  local hint = tostring(message):match "celspan has no '.-'(; .*)$"
  local list = {}
  for _, known in ipairs { module_of, globals } do
    for key in next, known do
      if type(key) == "string" then list[#list + 1] = key end
    end
  end
  table.sort(list)
  return hint or fields.hint(name, list) or ""
end

--- celspan.names: the globals with these names beside them, for the file that calls it.
function names.of(globals)
  fields.expect_kind(type(globals) == "table", globals,
    "names: takes the globals, celspan.names(_ENV)")
  local own = names.assigned(text_of(native.caller()) or "")
  return setmetatable({}, { __newindex = globals, __index = function(_, name)
    local value = globals[name]
    if value == nil and type(name) == "string" and not own[name] then return value_of(name) end
    return value
  end })
end

return fields.seal("names", names)
