--- Requirements of tests that not every build or machine meets, each checked once per process:
---
---   local present = require "tests.support.present"
---   local it_reads = present.pictures() and it or pending
---   if not present.program "ffmpeg" then return pending "there is no ffmpeg" end
local binary = require("tests.support.workbench").binary

local present = {}
local answers = {}

--- Whether a shell command succeeds; its output is discarded.
local function ends_well(command)
  if answers[command] == nil then
    answers[command] = os.execute("{ " .. command .. "; } >/dev/null 2>&1") == true
  end
  return answers[command]
end

--- Whether the program contains a pattern.
local function contains(pattern)
  return ends_well(("grep -qaE '%s' '%s'"):format(pattern, binary))
end

--- Whether celspan has a module: it is run with arguments that need the module, and does not report
--- it as missing.
local function has(module, arguments)
  return ends_well(("! '%s' %s 2>&1 | grep -qF %s"):format(binary, arguments, module))
end

--- Whether the module that reads and writes pictures exists: built without OpenImageIO, celspan
--- writes only PNG, Targa and span files, and reads none. In emulation the decoder does not start.
function present.pictures()
  return has("celspan-picture.so", "info --trust scripts/pictures/canal.png")
end

--- Whether the module for type and XML exists: without it there are no letters, no drawings, and no
--- paintings that are archives.
function present.type() return has("celspan-type.so", "info scripts/paintings/valley.ora") end

--- Whether there is a module for colour profiles: without it, profiles are not understood.
function present.colour()
  return contains "reading colour profiles" and not contains "built without Little CMS"
end

--- Whether there is a module for the spaces of an OpenColorIO configuration.
function present.spaces() return not contains "built without OpenColorIO" end

--- Whether AVIF can be written: the picture module that is used was built with libavif.
function present.avif()
  for _, name in ipairs { "oiio/celspan-picture.so", "raster/celspan-raster.so" } do
    local path = (os.getenv "CELSPAN_BUILD" or "build") .. "/src/kit/plugins/" .. name
    if present.program(path) then
      return not ends_well(("grep -qsaE 'built without libavif' '%s'"):format(path))
    end
  end
  return false
end

--- Whether PDF can be written.
function present.pdf() return contains "writing PDF" and not contains "built without Cairo" end

--- Whether celspan watch can show a page: it was built with libmicrohttpd.
function present.web() return not contains "built without libmicrohttpd" end

--- Whether celspan plane can make pages: it was built with clang and lld.
function present.pages() return contains "H4sIAAAAAAAC" end -- the beginning of a packed module

--- Whether all of these programs are installed; a path is a program too.
function present.program(...)
  for _, name in ipairs { ... } do
    if not ends_well(("command -v '%s'"):format(name)) then return false end
  end
  return true
end

--- Whether celspan was built with a sanitizer: it then has memory limits of its own, and is many
--- times slower.
function present.sanitizer() return contains "__(asan|tsan)_init" end

--- The folder of pictures and drawings for tests that need some; nil if there is none.
present.material = os.getenv "CELSPAN_MATERIAL"

--- Whether `./run docs site` can be made: with markdown-it of node and pygments of python3.
function present.site()
  return present.program("node", "python3") and ends_well [[python3 -c 'import pygments' &&
    NODE_PATH=/usr/share/nodejs node -e 'require("markdown-it")']]
end

--- The folder that `./run web` has made; nil: there is none.
function present.engine()
  local folder = os.getenv "CELSPAN_WEB" or "out/web"
  return ends_well(("[ -e '%s/celspan.wasm' ]"):format(folder)) and folder or nil
end

return present
