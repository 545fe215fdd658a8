-- Makes the pictures of the documentation, or those with the names: lua5.4 docs/pictures/make.lua
-- BINARY FOLDER [--exact] [NAME...], from the top of the tree. Examples in pages are saved in
-- FOLDER/examples/, and the frames from which pictures are composed in FOLDER/parts/.
--   --exact   loops without loss, as NAME.mkv, for comparison
package.path = "./?.lua;" .. package.path
local markdown = require "tests.support.markdown"
local list = require "docs.pictures.list"

local binary, folder = ...
assert(binary and folder, "usage: lua5.4 docs/pictures/make.lua BINARY FOLDER [--exact] [NAME...]")
local names = { select(3, ...) }
local is_exact = names[1] == "--exact" and table.remove(names, 1) ~= nil
local is_wanted = {}
for _, name in ipairs(names) do is_wanted[name] = true end
local program = ("CELSPAN_PATH='scripts/?.lua' '%s'"):format(binary)

local function run(command, ...)
  local words = {}
  for i, word in ipairs { ... } do words[i] = "'" .. word:gsub("'", "'\\''") .. "'" end
  assert(os.execute(command .. " " .. table.concat(words, " ")))
end

local is_saved = {}

--- Saves the example `name` of a page as a file, beside the others of that page: its path and the
--- options that its command has.
local function extract(page, name)
  if not is_saved[page] then
    markdown.save(page, folder .. "/examples", function() return true end)
  end
  is_saved[page] = true
  for _, block in ipairs(markdown.blocks(page)) do
    if block.name == name then return folder .. "/examples/" .. name .. ".lua", block.options end
  end
  error(("%s has no example %s.lua"):format(page, name))
end

local function render(script, picture, output, argument, options)
  local arguments = { script, "--progress", "none", "-o", output }
  local function add(...) table.move({ ... }, 1, select("#", ...), #arguments + 1, arguments) end
  if picture.loop then add("--fps", picture.fps or "12", "--no-dither") end
  if picture.loop and is_exact then
    add("--codec", "ffv1")
  elseif picture.loop then
    add("--quality", picture.quality or "50")
  end
  local frames = picture.loop or picture.frame or 1
  if frames ~= "all" then add("--frames", tostring(frames)) end
  if picture.size then add("--size", picture.size) end
  if picture.crop then add("--crop", picture.crop) end
  if picture.onion then add("--onion", picture.onion) end
  if picture.background then add("--background", picture.background) end
  if picture.set then add("--set", picture.set) end
  if picture.allow then add("--allow", picture.allow) end
  if options and options ~= "" then add(options) end
  if argument then add("--allow", argument, "--", argument) end
  run(program .. " render", table.unpack(arguments))
end

local parts = folder .. "/parts"
run("mkdir -p", folder .. "/examples", folder .. "/works", parts)
run("cp -r scripts/type scripts/paintings scripts/pictures scripts/drawings scripts/stage",
  "scripts/pencil", folder .. "/examples/")
-- A script gets an absolute path, because it looks for files beside itself, and may read there.
local pwd = assert(io.popen "pwd"):read "l"
local absolute = parts:find "^/" and parts or pwd .. "/" .. parts
local function make(picture)
  for _, part in ipairs(picture.parts or {}) do
    render(part.script, part, parts .. "/" .. part.file)
  end
  local script, options = picture.script, nil
  if not script then script, options = extract(picture.page, picture.name) end
  if picture.before then
    local before = extract(table.unpack(picture.before))
    run(("modules=$(realpath \"$(dirname '%s')\") && cd %s/examples && "
      .. "LUA_CPATH=\"$modules/?.so\" lua5.4"):format(binary, folder), before:match "[^/]+$")
  end
  local file = picture.loop and is_exact and picture.name .. ".mkv" or list.file_of(picture)
  local output = ("%s/%s"):format(folder, file)
  if picture.strip then
    local _, commas = picture.strip:gsub(",", "")
    run(program .. " contact", script, "--grid", commas + 1 .. "x1", "--frames", picture.strip,
      "--size", "320x180", "-o", output, options ~= "" and options or nil)
  elseif picture.grid then
    local sheet = ("%s/%s.sheet.png"):format(parts, picture.name)
    run(program .. " contact", script, "--grid", picture.grid, "-o", sheet,
      table.unpack(picture.frames and { "--frames", picture.frames } or {}))
    run(program .. " convert", sheet, output, "--size", picture.size)
  else
    render(script, picture, output, picture.parts and absolute, options)
  end
end
for _, picture in ipairs(list) do
  if #names == 0 or is_wanted[picture.name] then make(picture) end
end
