-- Makes the pictures of the documentation: lua5.4 docs/pictures/make.lua BINARY FOLDER, from the
-- top of the tree. Examples in pages are put into FOLDER/examples/ first.
package.path = "./?.lua;" .. package.path
local markdown = require "tests.support.markdown"
local list = require "docs.pictures.list"

local binary, folder = ...
assert(binary and folder, "usage: lua5.4 docs/pictures/make.lua BINARY FOLDER")

local function run(command, ...)
  local words = {}
  for i, word in ipairs { ... } do words[i] = "'" .. word:gsub("'", "'\\''") .. "'" end
  assert(os.execute(command .. " " .. table.concat(words, " ")))
end

--- The example `name` of a page, as a file of its own.
local function extract(page, name)
  for _, block in ipairs(markdown.blocks(page)) do
    if block.name == name then
      local path = folder .. "/examples/" .. name .. ".lua"
      local file = assert(io.open(path, "wb"))
      assert(file:write(block.text))
      file:close()
      return path
    end
  end
  error(("%s has no example %s.lua"):format(page, name))
end

run("mkdir -p", folder .. "/examples")
for _, picture in ipairs(list) do
  local script = picture.script or extract(picture.page, picture.name)
  local arguments = { script, "--frames", tostring(picture.frame or 1), "--progress", "none",
                      "-o", folder .. "/" .. picture.name .. ".png" }
  if picture.size then table.move({ "--size", picture.size }, 1, 2, #arguments + 1, arguments) end
  run(binary .. " render", table.unpack(arguments))
end
