--- celspan init NAME: a folder with a film that renders and tests that pass.
--
--   project/ --@NAME@, @ANNOTATIONS@ replaced--> NAME/...
--
-- No existing file is replaced: the folder must be new or empty. The project's own program computes
-- the sound: when celspan is built, or here if celspan was built on another kind of machine.
local program, request = ...

local NAME_MOST, PATH_MOST = 100, 2047

local texts = { -- the texts by the names of the files
  ["film.lua"] = "film.lua", ["cat.lua"] = "cat.lua", ["town.lua"] = "town.lua",
  ["timing.lua"] = "timing.lua", ["tune.lua"] = "tune.lua",
  ["spec/film_spec.lua"] = "film_spec.lua", ["README.md"] = "README.md",
  [".luarc.json"] = "luarc.json", [".luacheckrc"] = "luacheckrc", [".busted"] = "busted",
  [".gitignore"] = "gitignore", ["type/block.ttf"] = "block.ttf",
  [".vscode/tasks.json"] = "tasks.json", [".vscode/extensions.json"] = "extensions.json",
}

local folder = request[1]
local name = folder:match "[^/]*$" -- it is written into Lua and Markdown without changes

--- Letters may be of every script, with spaces between words.
local function is_name(text)
  return #text <= NAME_MOST and utf8.len(text) and text:find "^[%w_\x80-\xff-][%w_. \x80-\xff-]*$"
    and not text:find " $"
end

if not is_name(name) then
  program.usage("'%s' cannot be the name of a film: use at most %d bytes of letters, digits, "
    .. "spaces, '_', '-' and '.', and begin with none of ' ' and '.'", folder, NAME_MOST)
elseif #folder > PATH_MOST then
  program.usage("'%.60s...' is too long a path: use at most %d bytes", folder, PATH_MOST)
end

local entries, message, how = program.entries(folder)
if how == "cut" then
  program.fail("output", "%s: cannot be read: %s", folder, message)
elseif not entries and how ~= "missing" then
  program.fail("output", "%s: cannot be a folder for the film: %s", folder,
    message or "Not a directory")
elseif entries and #entries > 0 then
  program.fail("output", "%s: the folder is not empty; choose another name", folder)
end

local names = table.concat((require "celspan.native".names()), '",\n  "')
local marks = { NAME = name, ANNOTATIONS = program.annotations(), NAMES = names }
for path, text in pairs(texts) do
  program.save(folder .. "/" .. path, (program.text(text):gsub("@(%u+)@", marks)))
end

--- The output that a program of the project prints.
local function printed(file)
  local pieces = {}
  local function write(...)
    for _, piece in ipairs { ... } do pieces[#pieces + 1] = piece end
  end
  local function require(module) return load(program.text(module .. ".lua"))() end
  local world = setmetatable({ io = { write = write }, require = require }, { __index = _G })
  load(program.text(file), "=" .. file, "t", world)()
  return table.concat(pieces)
end

program.save(folder .. "/tune.wav", program.text "tune.wav" or printed "tune.lua")
local shown = folder:find "[^%w_./-]" and ("'%s'"):format(folder) or folder -- for a shell
print(("%s: a film of six seconds, with its sound and its spec\n  cd %s\n"
  .. "  celspan watch film.lua\n  celspan render film.lua -o out/film.mp4\n"
  .. "  celspan test"):format(folder, shown))
