-- The scripts that ship, and what they need.
local shipped = {}

local command = os.getenv "CELSPAN" or "build/celspan"

--- What a shell command prints; nil when it fails.
local function output_of(line)
  local pipe = assert(io.popen(line))
  local text = pipe:read "a"
  return pipe:close() and text or nil
end

--- Paths of the scripts that make pictures, in order; the others are their modules.
function shipped.scripts()
  local paths = {}
  for path in output_of "ls scripts/*.lua scripts/paper/figure*.lua":gmatch "[^\n]+" do
    paths[#paths + 1] = path
  end
  return paths
end

--- What a script needs beside its path. Those of the paper's figures read the font and the pictures
--- beside their folder.
function shipped.options(path) return path:find "/paper/" and " --allow scripts" or "" end

-- Built without OpenImageIO, there are no pictures to read; without the libraries for type and XML,
-- no letters, drawings and paintings.
local function has(module, arguments)
  return not output_of(command .. " " .. arguments .. " 2>&1; true"):find(module, 1, true)
end

local has_pictures = has("celspan-picture.so", "convert no-such.png no-such-either.png")
local has_art = has("celspan-art.so", "check scripts/title.lua")

shipped.has_art = has_art

--- A script, and what is in the folder of its name.
local function text_of(path)
  return output_of(("cat %s $(find %s -name '*.lua' 2>/dev/null)"):format(path,
    path:gsub("%.lua$", "")))
end

--- Whether a script needs a module that was not built.
function shipped.lacks_module(path)
  local text = text_of(path)
  local function calls(...)
    for _, name in ipairs { ... } do
      if text:find("celspan." .. name, 1, true) then return true end
    end
  end
  if path:find "/paper/" then return not (has_pictures and has_art) end
  return calls("image", "picture") and not has_pictures
    or calls("text", "glyphs", "layers", "svg") and not has_art
end

return shipped
