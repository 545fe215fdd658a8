--- celspan plane FILE --windows TABLE -o OUT: a nest, which is a plane and those that its windows
--- show, each a file of its own (docs/planefile.md, "Nests").
local program, request = ...
local csv = require "celspan.csv"

local MOST, LEAST = 1024, 1 / (1 << 20) -- planes, and windows; of a window, in sides of the frame
local DEEPEST = 16 -- planes in each other

--- CRC-32C.
local function checksum(bytes)
  local sum = 0xffffffff
  for i = 1, #bytes do
    sum = sum ~ bytes:byte(i)
    for _ = 1, 8 do sum = sum >> 1 ~ (sum & 1) * 0x82f63b78 end
  end
  return sum ~ 0xffffffff
end

local path, list = request[1], request.windows
program.refuse_self(list, request.output)
local rows, message = csv.decode(program.bytes(list),
  { types = { x = "number", y = "number", width = "number", height = "number" } })
if not rows then program.fail("input", "%s: %s", list, message) end
local outer = program.plane(path)
local planes, numbers, windows = { program.bytes(path) }, {}, {}
if planes[1]:find("^celnests") then
  program.fail("input", "%s: this plane has windows already", path)
end
program.refuse_self(path, request.output)

--- The number of a plane, which is in the file once.
local function number_of(name)
  local file = program.resolve(name)
  if not numbers[file] then
    program.refuse_self(name, request.output)
    local levels = program.plane(name).levels -- fails if the file is not a plane
    if levels == DEEPEST then
      program.fail("input", "%s: it has planes %d deep; no reader goes deeper", name, DEEPEST)
    end
    planes[#planes + 1] = program.bytes(name)
    numbers[file] = #planes - 1
  end
  return numbers[file]
end

--- Refuses a row; it is counted without the heads of the columns.
local function refuse(i, format, ...)
  program.fail("input", "%s: row %d: %s", list, i, format:format(...))
end

if #rows == 0 then program.fail("input", "%s: has no rows: give one for each window", list) end
if #rows > MOST then
  program.fail("input", "%s: has %d rows; a plane has at most %d windows", list, #rows, MOST)
end
for i, row in ipairs(rows) do
  for _, name in ipairs { "x", "y", "width", "height", "plane" } do
    if not row[name] or row[name] == "" then refuse(i, "it has no '%s'", name) end
  end
  local left, top = row.x / outer.width, row.y / outer.height
  local right, foot = (row.x + row.width) / outer.width, (row.y + row.height) / outer.height
  if not (left >= 0 and top >= 0 and right <= 1 and foot <= 1 and right - left >= LEAST
    and foot - top >= LEAST) then
    refuse(i, "the window %g,%g,%g,%g is not in the frame, which is %g x %g, or too small "
      .. "(at least a 1048576th of each side)",
      row.x, row.y, row.width, row.height, outer.width, outer.height)
  end
  local name = row.plane:find "^/" and row.plane or (list:match "^.*/" or "") .. row.plane
  windows[i] = ("<ddddI4"):pack(left, top, right, foot, number_of(name))
end
if #planes > MOST then
  program.fail("input", "%s: names %d planes; a plane has at most %d in it", list, #planes - 1,
    MOST - 1)
end

local sizes = {}
for i, bytes in ipairs(planes) do sizes[i] = ("<I8"):pack(#bytes) end
local head = ("<c8I4I4I4"):pack("celnests", 1, #planes, #windows) .. table.concat(sizes)
  .. table.concat(windows)
program.save(request.output, head .. ("<I4"):pack(checksum(head)) .. table.concat(planes))
