-- The scripts that ship, and what they need.
local present = require "tests.support.present"
local system = require "tests.support.system"

local shipped = {}

--- Paths of the scripts that make pictures, in order; the others are their modules.
function shipped.scripts()
  local paths = {}
  local listed = system.output "ls scripts/*.lua scripts/works/*.lua scripts/paper/figure*.lua"
  for path in listed:gmatch "[^\n]+" do
    paths[#paths + 1] = path
  end
  return paths
end

--- The options that a script needs. Works and the paper's figures read what is next to their
--- folder.
function shipped.options(path)
  return (path:find "/paper/" or path:find "/works/") and " --allow scripts" or ""
end

--- The text of a script and of the files in the folder of its name.
local function text_of(path)
  return (system.output(("cat %s $(find %s -name '*.lua' 2>/dev/null)"):format(path,
    path:gsub("%.lua$", ""))))
end

--- Whether a script needs a module that was not built.
function shipped.lacks_module(path)
  local text = text_of(path)
  local function calls(...)
    for _, name in ipairs { ... } do
      if text:find("%f[%w_]" .. name .. " ?[.({]") then return true end
    end
  end
  if path:find "/paper/" then return not (present.pictures() and present.type()) end
  return calls("image", "picture", "trace") and not present.pictures()
    or calls("text", "glyphs", "layers", "svg") and not present.type()
end

return shipped
