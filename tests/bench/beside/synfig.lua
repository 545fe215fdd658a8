-- The film as a file of Synfig, which people draw in its studio:
--   lua5.4 synfig.lua DRAWING > film.sif
-- A unit of its canvas is 160 pixels here, and y goes up.
local drawing = ...
local colours = { "e4572e", "f3a712", "2e86ab" }

local function put(format, ...) io.write(format:format(...), "\n") end

local function real(name, value) put('<param name="%s"><real value="%g"/></param>', name, value) end

local function vector(x, y)
  return ("<vector><x>%.6f</x><y>%.6f</y></vector>"):format((x - 640) / 160, (360 - y) / 160)
end

local function still(name, x, y) put('<param name="%s">%s</param>', name, vector(x, y)) end

--- A place that moves evenly from a to b.
local function moving(name, a, b)
  put('<param name="%s"><animated type="vector">', name)
  for i, at in ipairs { a, b } do
    put('<waypoint time="%df" before="linear" after="linear">%s</waypoint>', 149 * (i - 1),
      vector(at[1], at[2]))
  end
  put "</animated></param>"
end

local function colour(code, position)
  local r, g, b = code:match "(..)(..)(..)"
  local function share(digits) return tonumber(digits, 16) / 255 end
  return ("<color%s><r>%.6f</r><g>%.6f</g><b>%.6f</b><a>1</a></color>"):format(
    position and (' pos="%g"'):format(position) or "", share(r), share(g), share(b))
end

local function gradient(from, to)
  put('<param name="gradient"><gradient>%s%s</gradient></param>', colour(from, 0), colour(to, 1))
end

--- body() puts the parameters of a layer.
local function layer(kind, version, body)
  put('<layer type="%s" active="true" version="%s">', kind, version)
  body()
  put "</layer>"
end

--- A disc, and on it a gradient that is seen only where the disc is.
local function disc(i)
  local radius, a = (30 + 3 * i) / 160, { 173 * i % 1280, 97 * i % 720 }
  local b = { 311 * i % 1280, (59 * i + 300) % 720 }
  layer("circle", "0.2", function()
    real("radius", radius)
    moving("origin", a, b)
  end)
  layer("radial_gradient", "0.1", function()
    put '<param name="blend_method"><integer value="13"/></param>' -- onto
    gradient("fff4d6", colours[i % 3 + 1])
    moving("center", a, b)
    real("radius", radius)
  end)
end

put '<?xml version="1.0" encoding="UTF-8"?>'
put('<canvas version="1.2" width="1280" height="720" view-box="-4 2.25 4 -2.25" antialias="1" '
  .. 'fps="25" begin-time="0f" end-time="149f" bgcolor="0 0 0 1">')
layer("linear_gradient", "0.0", function()
  still("p1", 640, 0)
  still("p2", 640, 720)
  gradient("16202e", "7a5c74")
end)
for i = 0, 29 do
  layer("group", "0.3", function()
    put '<param name="canvas"><canvas>'
    disc(i)
    put "</canvas></param>"
  end)
end
layer("svg_layer", "0.1", function()
  put('<param name="filename"><string>%s</string></param>', drawing)
  put('<param name="transformation"><composite type="transformation"><offset>%s</offset>'
    .. '<angle><angle value="0"/></angle><skew_angle><angle value="0"/></skew_angle>'
    .. '<scale><vector><x>0.375</x><y>0.375</y></vector></scale></composite></param>',
    vector(1040, 510)) -- its own unit is 60 pixels
end)
layer("text", "0.4", function()
  put '<param name="text"><string>Six seconds</string></param>'
  put '<param name="family"><string>DejaVu Sans</string></param>'
  put '<param name="weight"><integer value="700"/></param>'
  put '<param name="size"><vector><x>0.3</x><y>0.3</y></vector></param>'
  put('<param name="color">%s</param>', colour "f6ead2")
  still("origin", 640, 130)
end)
put "</canvas>"
