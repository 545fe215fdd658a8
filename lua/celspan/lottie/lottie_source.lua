--- The documents of a file: one JSON, or the members of a dotLottie archive.
--
--   version 1: manifest.json, animations/ID.json, images/NAME, audio/NAME, themes/ID.json,
--              states/ID.json
--   version 2: manifest.json, a/ID.json, i/NAME, u/NAME, t/ID.json, s/ID.json
local native = require "celspan.native"
local fields = require "celspan.fields"
local files = require "celspan.files"
local json = require "celspan.json"
local values = require "celspan.lottie_values"

local source = {}

local folders = { animation = { "a/", "animations/" }, picture = { "i/", "images/" },
                  sound = { "u/", "audio/" }, theme = { "t/", "themes/" } }

--- The value of a JSON text; the message begins with the name of what is read.
local function decode(text, name)
  local value, message = json.decode(text)
  if value == nil then return nil, ("%s: %s"):format(name, message) end
  return value
end

--- What a function of an archive returns for a member, in the folder of either version. The last
--- failure is that of the member.
local function in_folders(ask, archive, kind, name, most)
  local newer, older = folders[kind][1] .. name, folders[kind][2] .. name
  if not native.archive_size(archive, newer) and native.archive_size(archive, older) then
    return ask(archive, older, most)
  end
  return ask(archive, newer, most)
end

local function member(archive, kind, name)
  return in_folders(native.archive, archive, kind, name, json.most_bytes)
end

--- The ids of a list of the manifest.
local function ids(list)
  local found = {}
  for _, one in ipairs(values.items(list)) do
    if type(one[2].id) == "string" then found[#found + 1] = one[2].id end
  end
  return found
end

--- The animation that a player would show first, and its entry in the manifest.
local function first_of(manifest)
  local initial = values.table(manifest.initial)
  local wanted = values.text(initial and initial.animation)
    or values.text(manifest.activeAnimationId)
  local entries = values.items(manifest.animations)
  for _, one in ipairs(entries) do
    if one[2].id == wanted then return one[2] end
  end
  return entries[1] and entries[1][2]
end

local function open_archive(path, found_at)
  local text, message = native.archive(found_at, "manifest.json", json.most_bytes)
  if not text then return nil, message end
  local manifest, problem = decode(text, path .. ": manifest.json")
  if not manifest then return nil, problem end
  local entry = values.table(manifest) and first_of(manifest)
  if not entry or type(entry.id) ~= "string" then
    return nil, ("%s: manifest.json names no animation"):format(path)
  end
  text, message = member(found_at, "animation", entry.id .. ".json")
  if not text then return nil, message end
  local document
  document, problem = decode(text, ("%s: %s.json"):format(path, entry.id))
  if document == nil then return nil, problem end
  return { document = document, archive = found_at, id = entry.id, themes = ids(manifest.themes),
           states = ids(values.table(manifest.stateMachines) or manifest.states),
           theme = values.text(entry.initialTheme) or values.text(entry.defaultTheme) }
end

--- The document of a file; archive: its path, if it is one.
---@param path string
---@return table? found { document, archive, id, folder, themes, states, theme }
---@return string? message
function source.open(path)
  local text, message = files.read_found(path, json.most_bytes)
  if not text then return nil, message end
  local found_at = native.find(path)
  if text:sub(1, 4) == "PK\3\4" then return open_archive(path, found_at) end
  if not text:find "%S" then return nil, path .. ": it is no Lottie animation: it is empty" end
  local document, problem = decode(text, path)
  if document == nil then return nil, problem end
  return { document = document, folder = found_at:match "^(.*)/[^/]*$" or ".", themes = {},
           states = {} }
end

--- A picture or sound of the archive as an address that contains it.
---@param found table
---@param kind "picture" | "sound"
---@param name string
---@param most? integer Bytes; default: as of all members
---@return string? address
---@return string? message
function source.address(found, kind, name, most)
  local bytes, message = in_folders(native.archive, found.archive, kind, name,
    math.min(most or json.most_bytes, json.most_bytes))
  if not bytes then return nil, message end
  return native.data(bytes)
end

--- The bytes that a picture or sound of the archive says to have.
---@param found table
---@param kind "picture" | "sound"
---@param name string
---@return integer? bytes
---@return string? message
function source.bytes(found, kind, name)
  return in_folders(native.archive_size, found.archive, kind, name)
end

--- The rules of a theme: a list of { id =, value = }.
---@return table[]? rules
---@return string? message
function source.theme(found, id)
  local known = false
  for _, one in ipairs(found.themes) do known = known or one == id end
  if not known then
    return nil, ("there is no theme '%s'%s"):format(id, fields.choice(id, found.themes))
  end
  local text, message = member(found.archive, "theme", id .. ".json")
  if not text then return nil, message end
  local theme, problem = decode(text, ("theme '%s'"):format(id))
  if theme == nil then return nil, problem end
  return values.items(values.table(theme) and theme.rules)
end

return require "celspan.fields".seal("lottie_source", source)
