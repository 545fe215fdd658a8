--- The drawings of the benchmark, written into a folder; those missing from the material are left
--- out.
local house = require "tests.bench.house"
local shapes = require "tests.bench.shapes"
local svg = require "tests.bench.svg"
local present = require "tests.support.present"
local prng = require "tests.support.prng"

local scenes = {}

local function files_of(folder)
  local pipe = assert(io.popen(("ls '%s'/*.svg 2>/dev/null"):format(folder)))
  local list = {}
  for path in pipe:lines() do list[#list + 1] = path end
  pipe:close()
  return list
end

--- Pieces of artwork: one drawing, or a sheet of many. `house` is drawn by code.
local clipart = "/artwork-openclipart/"
local single = { mosquito = "zanzara_cretina_architet_01", skaters = "pattinatrici_sul_ghiacc_01",
                 boating = "boating_rules5" }
local sheets = { clipart = { "/artwork-openclipart", 8 }, emoji = { "/artwork-noto", 8 },
                 twemoji = { "/artwork-twemoji", 8 } }
scenes.random = { "10", "100", "1000" }
scenes.hard = { "opaque", "small", "faint" }
scenes.gradients = { "gradients-100", "gradients-1000" }
scenes.sheets = { "clipart", "emoji", "twemoji" }
--- The backgrounds of films, which are measured alone, too.
scenes.backs = { "clipart", "emoji", "twemoji", "house" }
--- Films: the name, the sheet, and the drawings in front of it, the nearest last.
scenes.films = { { "clipart", "clipart", "skaters", "mosquito" },
                 { "emoji", "emoji", "skaters", "mosquito" },
                 { "twemoji", "twemoji", "skaters", "mosquito" },
                 { "house", "house", "skaters", "mosquito" },
                 { "three sheets", "clipart", "emoji", "twemoji" } }
scenes.artwork = { "mosquito", "skaters", "boating", "clipart", "emoji", "twemoji", "house" }
--- Folders of SVG files that are drawn with all that they have: the name, the folder.
scenes.files = { { "clip art as it is", "artwork-openclipart" },
                 { "noto as it is", "artwork-noto" } }

local function write_artwork(material, folder)
  for name, file in pairs(single) do
    svg.write(svg.lines(material .. clipart .. file .. ".svg", 0, 0, 1),
      folder .. "/" .. name .. ".txt")
  end
  for name, sheet in pairs(sheets) do
    svg.write(svg.sheet(files_of(material .. sheet[1]), sheet[2]), folder .. "/" .. name .. ".txt")
  end
end

--- Three clovers of four leaves: the drawn part of the paper's figure 14.
local function clovers()
  local list = {}
  local leaf = { 0, 0, 0.24, -0.33, 0, -0.27, -0.24, -0.33 }
  for _, clover in ipairs { { 0.43, 0.42, 1.5 }, { 0.76, 0.7, 0.8 }, { 0.23, 0.78, 0.6 } } do
    for turn = 0, 3 do
      local angle = math.rad(20 + 90 * turn)
      local c, s = clover[3] * math.cos(angle), clover[3] * math.sin(angle)
      local points = {}
      for k = 1, 8, 2 do
        points[k] = clover[1] + c * leaf[k] - s * leaf[k + 1]
        points[k + 1] = clover[2] + s * leaf[k] + c * leaf[k + 1]
      end
      list[#list + 1] = { rgba = { 140, 8, 13, 204 }, points = points }
    end
  end
  return list
end

--- Writes FOLDER/NAME.txt of each. Returns whether the material was found.
function scenes.write(folder)
  local material = present.material
  local all = material and shapes.read(material .. "/bench-scenes/scene1000.txt")
  local is_given = all ~= nil
  all = all or shapes.random(1000)
  local function write(list, name) shapes.write(list, ("%s/%s.txt"):format(folder, name)) end
  for _, count in ipairs(scenes.random) do
    write(table.move(all, 1, tonumber(count), 1, {}), count)
  end
  local random = prng.new(22)
  write(shapes.with_alpha(all, function() return 255 end), "opaque")
  write(shapes.with_alpha(all, function() return random:whole(5, 20) end), "faint")
  write(shapes.small(10000, 1 / 20), "small")
  local gradients = shapes.with_gradients(all)
  write(table.move(gradients, 1, 100, 1, {}), "gradients-100")
  write(gradients, "gradients-1000")
  write(clovers(), "clovers")
  svg.write(house.lines(), folder .. "/house.txt")
  if is_given then write_artwork(material, folder) end
  return is_given
end

return scenes
