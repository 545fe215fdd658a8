-- SVG files on a sheet, eight in a row, with all that they have: gradients, strokes, groups. The
-- sheet moves from frame to frame. Arguments: the folder of the files; how many frames there are.
local celspan = require "celspan"
local svg = require "celspan.svg"

local folder, count = ...
local across, side = 8, 1024
local cell = side / across

local function files()
  local list = {}
  local pipe = assert(io.popen(("ls '%s'/*.svg"):format(folder)))
  for path in pipe:lines() do list[#list + 1] = path end
  pipe:close()
  return list
end

local sheet = {}
for _, path in ipairs(files()) do
  local art, place = svg.read(path), #sheet
  if art and place < across * across then
    local scale = cell / math.max(art.width, art.height)
    sheet[place + 1] = art.object:scale(scale):translate(place % across * cell,
      place // across * cell)
  end
end

return celspan.film { size = { side, side }, frames = tonumber(count), frame = function(f)
  local cel = celspan.cel(sheet):translate(-2.5 * f.index, -1.25 * f.index)
  return celspan.rostrum { cel, back = "#ffffff" }
end }
