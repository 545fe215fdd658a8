-- examples/hello.c in LuaJIT, built with the declarations of a version that are kept in the tree:
--   luajit host.lua DECLARATIONS LIBRARY PICTURE
local ffi = require "ffi"

local file = assert(io.open(arg[1]))
ffi.cdef(file:read "*a")
file:close()
local lib = ffi.load(arg[2])

--- A description with its defaults.
local function begin(name)
  local made = ffi.new(name)
  lib[name .. "_default"](made, ffi.sizeof(made))
  return made
end

local context = ffi.new "celspan_context *[1]"
local function check(status)
  if status ~= lib.CELSPAN_OK then
    error(context[0] ~= nil and ffi.string(lib.celspan_context_error(context[0])) or "no context")
  end
end

check(lib.celspan_context_create(nil, context))
local disc = begin "celspan_ellipse_desc"
disc.centre = { 60, 60 }
disc.radius_x, disc.radius_y = 40, 40
local objects = ffi.new "celspan_object *[1]"
check(lib.celspan_object_create_ellipse(context[0], disc, objects))
local cel = begin "celspan_cel_desc"
cel.objects, cel.object_count = objects, 1
local cels = ffi.new "celspan_cel *[1]"
check(lib.celspan_cel_create(context[0], cel, cels))
local scene = begin "celspan_rostrum_desc"
scene.cels, scene.cel_count = cels, 1
scene.back = { 1, 1, 1, 1 }
local rostrum = ffi.new "celspan_rostrum *[1]"
check(lib.celspan_rostrum_create(context[0], scene, rostrum))
check(lib.celspan_rostrum_write(context[0], rostrum[0], 120, 120, arg[3]))
lib.celspan_object_unref(objects[0])
lib.celspan_cel_unref(cels[0])
lib.celspan_rostrum_unref(rostrum[0])
lib.celspan_context_destroy(context[0])
