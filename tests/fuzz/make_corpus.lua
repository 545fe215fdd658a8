--- Writes the seeds of the fuzz targets: small paintings of every form.
--
--   lua5.4 tests/fuzz/make_corpus.lua [FOLDER]      from the root of the tree; tests/fuzz/corpus
package.path = "./?.lua;" .. package.path
local paintings = require "tests.support.paintings"
local stored = require "tests.support.stored"

local folder = arg[1] or "tests/fuzz/corpus"

local function write(kind, name, bytes)
  os.execute(("mkdir -p '%s/%s'"):format(folder, kind))
  local file = assert(io.open(("%s/%s/%s"):format(folder, kind, name), "wb"))
  file:write(bytes)
  file:close()
end

local function dots(x, y) return x * 9, y * 7, 30, (x + y) % 3 * 127 end

local function layer(more)
  local out = { name = "a", x = 1, y = 2, w = 5, h = 4, pixel = dots }
  for key, value in pairs(more or {}) do out[key] = value end
  return out
end

local function painting(...) return { w = 8, h = 8, layers = { ... } } end

write("zip", "stored", paintings.openraster(painting(layer {})))
write("zip", "deflated", paintings.openraster(painting(layer { deflate = true },
  { name = "g", layers = { layer { visible = false, opacity = 0.5 } } })))
write("zip", "krita", paintings.krita(painting({ name = "a", kind = "shapelayer" })))
write("zip", "comment", paintings.zip({ { name = "stack.xml", data = "<image w='1' h='1'/>" } },
  "a comment"))

local function around(document, data) return string.pack("<I2", #document) .. document .. data end

local stack = '<image w="8" h="8"><stack><layer src="a.png" x="%d" opacity="0.5" name="a" '
  .. 'composite-op="svg:%s"/><stack isolation="auto"><layer src="a.png"/></stack></stack></image>'
write("ora", "rgba8", around(stack:format(3, "plus"), paintings.png(layer())))
write("ora", "rgba16", around(stack:format(-3, "multiply"), paintings.png(layer { depth = 16 })))
write("ora", "indexed", around(stack:format(0, "screen"), paintings.png_of(4, 2, 2, 3,
  "\0\x1b\1\x1b", stored.chunk("PLTE", ("\1\2\3"):rep(4)) .. stored.chunk("tRNS", "\1\2"))))
write("ora", "grey", around(stack:format(0, "x"), paintings.png_of(3, 4, 8, 0,
  "\1\1\2\3\2\1\2\3\3\1\2\3\4\1\2\3")))

write("ora", "profile", around(stack:format(1, "y"), paintings.png(layer {
  profile = paintings.profile { curve = "formula" } })))

local document = '<DOC xmlns="k"><IMAGE name="f" width="80" height="8"><layers><layer '
  .. 'nodetype="grouplayer" name="g"><layers><layer nodetype="paintlayer" filename="a" name="a" '
  .. 'opacity="99" compositeop="add" colorspacename="%s" x="-3"/></layers></layer></layers>'
  .. "</IMAGE></DOC>"
for _, form in ipairs { { "RGBA" }, { "GRAYA", grey = true }, { "RGBA16", depth = 16 } } do
  local tiles = paintings.krita_tiles(layer { grey = form.grey, depth = form.depth })
  write("kra", form[1], around(document:format(form[1]), tiles))
end

for _, packing in ipairs { "raw", "packbits", "zip", "predicted" } do
  for _, depth in ipairs { 8, 16 } do
    local one = painting(layer { packing = packing, mask = { x = 2, y = 1, w = 3, h = 3,
      value = function(x, y) return x + y end } },
      { name = "g", layers = { layer { packing = packing, clipped = true } } })
    one.depth = depth
    write("psd", packing .. depth, paintings.psd(one))
  end
end
write("psd", "grey", paintings.psd { w = 8, h = 8, grey = true, layers = { layer() } })
local profiled = painting(layer())
profiled.profile = paintings.profile { curve = 2.2, wide = true }
write("psd", "profile", paintings.psd(profiled))
write("psd", "merged", paintings.psd { w = 2, h = 1,
  merged = "\0\1" .. string.pack(">I2I2I2", 2, 2, 2) .. "\255\1\255\2\255\3" })

--- A table of colours in which light mixes to less than its sum.
local function muddy(r, g, b)
  local most = math.max(r, g, b)
  return most * (0.3 * r + 0.2 * g) + 0.1 * b, most * (0.2 * r + 0.4 * g), most * 0.5 * b
end
write("profile", "power", paintings.profile { curve = 2.2 })
write("profile", "formula", paintings.profile { curve = "formula", wide = true })
write("profile", "grey", paintings.profile { curve = 1.8, grey = true })
write("profile", "table", paintings.profile { lut = muddy })
