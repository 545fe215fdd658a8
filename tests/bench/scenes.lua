--- The drawings of the benchmark, written into a folder; what the material lacks is left out.
local shapes = require "tests.bench.shapes"
local svg = require "tests.bench.svg"
local prng = require "tests.support.prng"

local scenes = {}

local function files_of(folder)
  local pipe = assert(io.popen(("ls '%s'/*.svg 2>/dev/null"):format(folder)))
  local list = {}
  for path in pipe:lines() do list[#list + 1] = path end
  pipe:close()
  return list
end

--- Pieces of artwork: one drawing, or a sheet of many.
local clipart = "/artwork-openclipart/"
local single = { mosquito = "zanzara_cretina_architet_01", skaters = "pattinatrici_sul_ghiacc_01",
                 boating = "boating_rules5" }
local sheets = { clipart = { "/artwork-openclipart", 8 }, emoji = { "/artwork-noto", 8 },
                 twemoji = { "/artwork-twemoji", 8 } }
scenes.artwork = { "mosquito", "skaters", "boating", "clipart", "emoji", "twemoji" }

local function write_artwork(material, folder)
  for name, file in pairs(single) do
    svg.write(svg.lines(material .. clipart .. file .. ".svg", 0, 0, 1),
      folder .. "/" .. name .. ".txt")
  end
  for name, sheet in pairs(sheets) do
    svg.write(svg.sheet(files_of(material .. sheet[1]), sheet[2]), folder .. "/" .. name .. ".txt")
  end
end

--- Writes FOLDER/NAME.txt of each. Returns whether the material was there.
function scenes.write(folder)
  local material = os.getenv "CELSPAN_MATERIAL"
  local all = material and shapes.read(material .. "/bench-scenes/scene1000.txt")
  local is_given = all ~= nil
  all = all or shapes.random(1000)
  local function write(list, name) shapes.write(list, ("%s/%s.txt"):format(folder, name)) end
  for _, count in ipairs { 10, 100, 1000 } do
    write(table.move(all, 1, count, 1, {}), tostring(count))
  end
  local random = prng.new(22)
  write(shapes.with_alpha(all, function() return 255 end), "opaque")
  write(shapes.with_alpha(all, function() return random:whole(5, 20) end), "faint")
  write(shapes.small(10000, 1 / 20), "small")
  if is_given then write_artwork(material, folder) end
  return is_given
end

return scenes
