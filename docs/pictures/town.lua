-- Makes the town with its windows, FOLDER/town.plane: a plane of what is still, planes of
-- what moves over it, and those of the rooms of scripts/town/boxes.csv; and the film of the way
-- into it, FOLDER/town_zoom.mp4, whose last sheet is a picture in tiles. From the top of the
-- tree:
--
--   lua5.4 docs/pictures/town.lua BINARY FOLDER
package.path = "./?.lua;" .. package.path
local system = require "tests.support.system"

local binary, folder = ...
assert(binary and folder, "usage: lua5.4 docs/pictures/town.lua BINARY FOLDER")
local planes = folder .. "/town"

local function run(...) assert(os.execute((...):format(select(2, ...)))) end


--- The plane of a script, as planes/NAME.plane.
local function render(script, name, options)
  run("'%s' render %s --allow scripts --depth 8 --progress none %s -o '%s/%s.plane'", binary,
    script, options or "", planes, name)
end

--- Makes planes/NAME.plane a plane with windows: rows as `celspan plane --windows` reads them.
local function add_windows(name, rows, output)
  system.write(planes .. "/windows.csv", "x,y,width,height,plane\n" .. table.concat(rows))
  run("'%s' plane '%s/%s.plane' --windows '%s/windows.csv' -o '%s'", binary, planes, name, planes,
    output)
end

local make_rooms

--- Makes the plane of a room, with windows if it has a table of its own; returns its file's name.
local function make_room(room)
  local path = "scripts/town/windows/" .. room
  render(path .. ".lua", room)
  if not system.exists(path .. ".csv") then return room .. ".plane" end
  add_windows(room, make_rooms(path .. ".csv"), ("%s/%s_open.plane"):format(planes, room))
  return room .. "_open.plane"
end

--- Rows for the rooms in a table of boxes, one for each box.
function make_rooms(path, rows)
  rows = rows or {}
  for line in system.read(path):gmatch "[^\n]+" do
    local place, room = line:match "^%w+,([%d.]+,[%d.]+,[%d.]+,[%d.]+).*,([%l%d_]+)$"
    if not line:find "^box," then
      assert(room, path .. ": this row is not understood: " .. line)
      rows[#rows + 1] = ("%s,%s\n"):format(place, make_room(room))
    end
  end
  return rows
end

run("mkdir -p '%s'", planes)
run("'%s' plane -o '%s/celspan-film.js'", binary, folder) -- the player of its page
render("scripts/town.lua", "still", "--set part=still")
local rows = {}
for i, part in ipairs { "lights", "street", "air", "snow" } do -- below the rooms
  render("scripts/town.lua", part, "--set part=" .. part)
  rows[i] = ("0,0,1920,1080,%s.plane\n"):format(part)
end
add_windows("still", make_rooms("scripts/town/boxes.csv", rows), folder .. "/town.plane")

-- The film of the way: its last sheet is cut from the frame with which it begins.
run("'%s' tiles scripts/town.lua --frame 97 --fresh --sparse --scale 2 --progress none "
  .. "-o '%s/tiles'", binary, planes)
run("'%s' render scripts/town/zoom.lua --allow scripts --allow '%s' --quality 70 --progress none "
  .. "--set sheet=\"$(realpath '%s')/tiles/town.dzi\" -o '%s/town_zoom.mp4'", binary, planes,
  planes, folder)
