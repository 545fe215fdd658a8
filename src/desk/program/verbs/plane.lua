--- celspan plane FILE -o PAGE: a page that shows a plane at any size, by the element celspan-film.
--- The plane and the element, with its decoder as WebAssembly, are in the page, and the first frame
--- as a picture for browsers without script. Without a FILE, the script of the element alone. With
--- --windows, a plane with planes in it (windows.lua).
local program, request = ...
local celspan = require "celspan"

local STILL_MOST = 1280 -- pixels of the longer side of the picture

local page = request.output
if not page then program.usage "-o is missing: give -o page.html" end
if request.windows then
  if not request[1] or not program.has_ending(page, ".plane") then
    program.usage "--windows: give a FILE, and -o with a name that ends in .plane"
  end
  if request.title then program.usage "--title: a plane has no title: leave it out" end
  return program.part("windows.lua", program, request)
end
local path, is_script = request[1], program.has_ending(page, ".js")
if path and not program.has_ending(page, ".html", ".htm") then
  program.usage("%s: a page is an HTML file: give it a name that ends in .html", page)
elseif not path and not is_script then
  program.usage("%s: which plane? Without a FILE, only the player is written, to a name that ends "
    .. "in .js", page)
end
local module = program.text "plane.module"
if module == "none" then
  program.fail("input", "this celspan was built without clang and lld, which make the decoder of "
    .. "pages: install them, for example the Debian packages clang and lld, and build it again")
end
local function filled(name, fields) return (program.text(name):gsub("@(%u+)@", fields)) end
local player = filled("celspan-film.js", {
  VERSION = celspan._VERSION:match "%S+$", VIEWER = program.text "viewer.js",
  NEST = program.text "nest.js", DECODER = filled("decoder.js", { MODULE = module }),
})
if not path then return program.save(page, player) end
program.refuse_self(path, page)
program.plane(path) -- fails if the file is not a plane

--- The first frame of the plane as the bytes of a PNG.
local function still()
  local plane = program.check(celspan.plane_read(path))
  local by = STILL_MOST / math.max(plane.width, plane.height)
  local size = { math.ceil(plane.width * by), math.ceil(plane.height * by) }
  local image = program.check(plane:pixels { size = size })
  return (program.png(celspan.rostrum { size = size, celspan.cel { celspan.image { size = size,
    pixels = image:bytes { depth = 8 }, format = "rgba8", x = 0, y = 0 } } }))
end

program.save(page, filled("plane.html", {
  TITLE = program.markup(request.title or path:match "[^/]*$"),
  PLAYER = player, PLANE = program.base64(program.bytes(path)), STILL = program.base64(still()),
}))
