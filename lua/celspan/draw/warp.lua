--- Objects that are bent: object:warp{ map = | along = | lattice = | bones = | pins = }, and
--- object:boil{ amount = }.
--
--   flag:warp{ map = function(x, y) return x, y + 9 * math.sin(x / 40 - 6 * f.time) end }
--   arm:warp{ bones = { { from = {0, 0}, to = {60, 0} }, { from = {60, 0}, to = {120, 0},
--                                                          rotate = 70 } } }
--
-- Each of the five is a way to write down a map of the plane. The core bends by the map: outlines
-- as curves, pictures and gradients as a mesh.
local celspan = require "celspan"
local affine = require "celspan.affine"
local chance = require "celspan.chance"
local native = require "celspan.native"
local curves = require "celspan.curves"
local fields = require "celspan.fields"

local warp = {}

local function refuse(text, ...) native.refuse("warp: " .. text:format(...)) end

local function read_point(subject, value)
  fields.numbers("warp", subject .. ": its value %d", value, 2, "{x, y}")
  return value[1], value[2]
end

local maps = {}

-- ---------------------------------------------------------------- along a path

--- The line through the middle of the box becomes the path; all other points keep their distance
--- from it.
function maps.along(path, options, box)
  local curve = curves.read("warp", path)
  local start = (options.start or 0) * curve.length
  local scale = options.stretch and (curve.length - start) / box[3] or 1
  local left, middle = box[1], box[2] + box[4] / 2
  return function(x, y)
    local px, py, dx, dy = curve:at(start + (x - left) * scale)
    return px - (y - middle) * dy, py + (y - middle) * dx
  end
end

-- ---------------------------------------------------------------- lattices

local function read_lattice(lattice)
  fields.check("warp: lattice", lattice, { columns = "number", rows = "number", points = "table",
                                           smooth = "boolean", box = "table" })
  local columns, rows = lattice.columns or 1, lattice.rows or 1
  for name, count in pairs { columns = columns, rows = rows } do
    fields.whole("warp: lattice: " .. name, count, 1, 1000)
  end
  local points = lattice.points
  if type(points) ~= "table" or rawlen(points) ~= (columns + 1) * (rows + 1) then
    refuse("lattice: %d columns and %d rows of cells have %d points, got %s", columns, rows,
      (columns + 1) * (rows + 1), type(points) == "table" and rawlen(points) or "none")
  end
  for i = 1, #points do read_point(("lattice: point %d"):format(i), points[i]) end
  return columns, rows, points
end

--- The shares of four neighbouring points, two on each side of the place: linear interpolation, or
--- Catmull and Rom's curve.
local function spread(u, smooth)
  if not smooth then return 0, 1 - u, u, 0 end
  local v = 1 - u
  return -u * v * v / 2, (2 - 5 * u * u + 3 * u * u * u) / 2, (2 - 5 * v * v + 3 * v * v * v) / 2,
    -v * u * u / 2
end

--- The cell that contains a place, among `count` cells, and the position in it; for a place
--- outside, the nearest cell.
local function cell_of(at, count)
  local cell = math.max(0, math.min(count - 1, math.floor(at)))
  return cell, at - cell
end

function maps.lattice(lattice, _, box)
  local columns, rows, points = read_lattice(lattice)
  local left, top, width, height = table.unpack(lattice.box or box)
  --- Outside the lattice its points continue at equal distances.
  local function point(i, j, k)
    if i < 0 then return 2 * point(0, j, k) - point(-i, j, k) end
    if i > columns then return 2 * point(columns, j, k) - point(2 * columns - i, j, k) end
    if j < 0 then return 2 * point(i, 0, k) - point(i, -j, k) end
    if j > rows then return 2 * point(i, rows, k) - point(i, 2 * rows - j, k) end
    return points[j * (columns + 1) + i + 1][k]
  end
  return function(x, y)
    local column, u = cell_of((x - left) / width * columns, columns)
    local row, v = cell_of((y - top) / height * rows, rows)
    local across = { spread(u, lattice.smooth) }
    local to = { 0, 0 }
    for j, down in ipairs { spread(v, lattice.smooth) } do
      for i = 1, 4 do
        local share = across[i] * down
        if share ~= 0 then
          for k = 1, 2 do to[k] = to[k] + share * point(column + i - 2, row + j - 2, k) end
        end
      end
    end
    return to[1], to[2]
  end
end

-- ---------------------------------------------------------------- bones

local SOFT = 0.0025 -- how sharply weights change at a joint, as a share of the square of a radius

local known_bone = { "name", from = "table", to = "table", parent = "any", rotate = "number",
                     scale = "number", at = "table", radius = "number", weight = "any" }

local CELLS = 64 -- the cells of a painted weight along its longer side: finer paint is smoothed

--- Alpha of an object in cells over its bounds: a function alpha(i, j), 0 outside; and the side of
--- a cell.
local function read_cells(object, x, y, w, h)
  local side = math.max(w, h) / CELLS
  local columns, rows = math.ceil(w / side), math.ceil(h / side)
  local image = assert(celspan.pixels(celspan.rostrum { celspan.cel { object:translate(-x, -y) } },
    { size = { columns, rows }, film = { columns * side, rows * side } }))
  local cells = {}
  for i = 0, columns * rows - 1 do cells[i] = select(4, image:get(i % columns, i // columns)) end
  return function(i, j)
    return i >= 0 and i < columns and j >= 0 and j < rows and cells[j * columns + i] or 0
  end, side
end

--- The weights of three neighbouring cells for the place u, from -0.5 to 0.5, measured from the
--- centre of the middle cell: the quadratic B-spline, which has no kinks and is never negative.
local function blend_three(u) return (0.5 - u) ^ 2 / 2, 0.75 - u * u, (0.5 + u) ^ 2 / 2 end

--- The paint's weight as a function of the place.
local function read_paint(object)
  local left, top, w, h = object:bounds()
  if not left or w == 0 or h == 0 then return function() return 0 end end
  local cell, side = read_cells(object, left, top, w, h)
  return function(x, y)
    x, y = (x - left) / side, (y - top) / side
    local i, j = math.floor(x), math.floor(y)
    local a, b, c = blend_three(x - i - 0.5)
    local sum, shares = 0, { blend_three(y - j - 0.5) }
    for k = -1, 1 do
      sum = sum + shares[k + 2]
        * (a * cell(i - 1, j + k) + b * cell(i, j + k) + c * cell(i + 1, j + k))
    end
    return sum
  end
end

--- Painted weights by their objects; they are kept as long as the objects are used.
local painted = setmetatable({}, { __mode = "k" })

local function read_weight(i, weight)
  if weight == nil or type(weight) == "function" then return weight end
  fields.expect_kind(fields.is_object(weight), weight,
    "warp: bone %d: its weight must be an object or a function(x, y)", i)
  painted[weight] = painted[weight] or read_paint(weight)
  return painted[weight]
end

--- The number of the parent of bone number i: by default the bone before it.
local function parent_of(bones, i)
  local parent = bones[i].parent
  if parent == nil then return i > 1 and i - 1 or nil end
  if parent == false then return nil end
  for j = 1, i - 1 do
    if j == parent or bones[j][1] == parent then return j end
  end
  return refuse("bone %d: its parent must be false, or the number or name of a bone before it, "
    .. "got %s", i, type(parent) == "string" and ("%q"):format(parent) or fields.shown(parent))
end

--- The map by which a bone moves its surroundings: its joint turns, and the bone is stretched along
--- its length.
local function motion_of(bone, fx, fy, tx, ty, length)
  local map = affine.turn(bone.rotate or 0, fx, fy)
  if bone.scale then
    map = affine.compose(map, affine.stretch(bone.scale, 1, (tx - fx) / length,
      (ty - fy) / length, fx, fy))
  end
  if bone.at then
    local x, y = read_point("bone: at", bone.at)
    map = affine.compose(affine.translation(x - fx, y - fy), map)
  end
  return map
end

local function read_bone(list, made, i)
  local bone = list[i]
  fields.check(("warp: bone %d"):format(i), bone, known_bone)
  local fx, fy = read_point(("bone %d: from"):format(i), bone.from)
  local tx, ty = read_point(("bone %d: to"):format(i), bone.to)
  local length = math.sqrt((tx - fx) ^ 2 + (ty - fy) ^ 2)
  local radius = bone.radius or length / 4
  if not (length > 0 and radius > 0) then
    refuse("bone %d: its %s must be above 0", i, length > 0 and "radius" or "length")
  end
  local parent, own = parent_of(list, i), motion_of(bone, fx, fy, tx, ty, length)
  return { x = fx, y = fy, dx = (tx - fx) / length, dy = (ty - fy) / length, length = length,
           size = radius * radius, weight = read_weight(i, bone.weight),
           map = parent and affine.compose(made[parent].map, own) or own }
end

--- How much a point follows a bone near it: by its distance, in radii of the bone.
local function nearness(bone, x, y)
  local px, py = x - bone.x, y - bone.y
  local along = math.max(0, math.min(bone.length, px * bone.dx + py * bone.dy))
  px, py = px - along * bone.dx, py - along * bone.dy
  local q = (px * px + py * py) / bone.size + SOFT
  return 1 / (q * q)
end

--- Sets the shares of the bones that have their own weights; returns the sum of these shares.
local function share_given(bones, shares, x, y)
  local sum = 0
  for i = 1, #bones do
    local weight = bones[i].weight and bones[i].weight(x, y) or 0
    if not (fields.is_finite(weight) and weight >= 0) then
      refuse("bone %d: its weight must be 0 or more everywhere, got %s at {%.6g, %.6g}", i,
        fields.shown(weight), x, y)
    end
    shares[i], sum = weight, sum + weight
  end
  return sum
end

--- Divides `rest` among the bones with the numbers in `list`, by their nearness.
local function share_rest(bones, list, shares, rest, x, y)
  local total = 0
  for i = 1, #list do
    local bone = bones[list[i]]
    bone.near = nearness(bone, x, y)
    total = total + bone.near
  end
  for i = 1, #list do shares[list[i]] = shares[list[i]] + rest * bones[list[i]].near / total end
end

--- The numbers of the bones that have no weight of their own; all bones if each has one.
local function numbers_without_weight(bones)
  local some, all = {}, {}
  for i, bone in ipairs(bones) do
    all[i] = i
    if not bone.weight then some[#some + 1] = i end
  end
  return some[1] and some or all
end

local function check_list(list, name, more)
  if type(list) ~= "table" or rawlen(list) == 0 then
    refuse("%s must be a list of { from = {x, y}, to = {x, y}%s }, got %s", name, more,
      type(list) == "table" and "an empty one" or fields.kind(list))
  end
end

local function read_bones(list)
  local bones = {}
  check_list(list, "bones", ", rotate = degrees")
  for i = 1, rawlen(list) do bones[i] = read_bone(list, bones, i) end
  return bones
end

--- Each point follows the bones by their weights. If the weights at a point add up to less than
--- one, it also follows the bones near it.
function maps.bones(list)
  local bones, shares = read_bones(list), {}
  local others = numbers_without_weight(bones)
  return function(x, y)
    local sum = share_given(bones, shares, x, y)
    if sum < 1 then share_rest(bones, others, shares, 1 - sum, x, y) end
    local sx, sy, whole = 0, 0, math.max(sum, 1)
    for i = 1, #bones do
      local m, share = bones[i].map, shares[i] / whole
      sx = sx + share * (m[1] * x + m[2] * y + m[3])
      sy = sy + share * (m[4] * x + m[5] * y + m[6])
    end
    return sx, sy
  end
end

-- ---------------------------------------------------------------- pins

local function read_pins(pins)
  local read = {}
  check_list(pins, "pins", "")
  for i = 1, rawlen(pins) do
    fields.check(("warp: pin %d"):format(i), pins[i], { from = "table", to = "table" })
    local x, y = read_point(("pin %d: from"):format(i), pins[i].from)
    local u, v = read_point(("pin %d: to"):format(i), pins[i].to or pins[i].from)
    for j, other in ipairs(read) do
      if other[1] == x and other[2] == y then refuse("pins %d and %d are at one place", j, i) end
    end
    read[i] = { x, y, u, v }
  end
  return read
end

--- The sums of moving least squares about a point: the mean place of the pins around it, before and
--- after the movement, and the weighted rotation. Schaefer, McPhail and Warren, Image Deformation
--- Using Moving Least Squares, 2006: the rigid deformation.
local function fitted(pins, weights, sum)
  local px, py, qx, qy = 0, 0, 0, 0
  for i, pin in ipairs(pins) do
    local w = weights[i] / sum
    px, py, qx, qy = px + w * pin[1], py + w * pin[2], qx + w * pin[3], qy + w * pin[4]
  end
  local along, across = 0, 0
  for i, pin in ipairs(pins) do
    local ax, ay, bx, by = pin[1] - px, pin[2] - py, pin[3] - qx, pin[4] - qy
    along = along + weights[i] * (ax * bx + ay * by)
    across = across + weights[i] * (ax * by - ay * bx)
  end
  local size = math.sqrt(along * along + across * across)
  if size == 0 then return px, py, qx, qy, 1, 0 end
  return px, py, qx, qy, along / size, across / size
end

--- Pins move to their new places, and everything between them turns and moves with the nearest
--- ones.
function maps.pins(list)
  local pins = read_pins(list)
  return function(x, y)
    local weights, sum = {}, 0
    for i, pin in ipairs(pins) do
      local d = (pin[1] - x) ^ 2 + (pin[2] - y) ^ 2
      if d == 0 then return pin[3], pin[4] end
      weights[i] = 1 / d
      sum = sum + weights[i]
    end
    local px, py, qx, qy, c, s = fitted(pins, weights, sum)
    return qx + c * (x - px) - s * (y - py), qy + s * (x - px) + c * (y - py)
  end
end

-- ---------------------------------------------------------------- the method

function maps.map(map) return map end

local known = { map = "function", along = "any", start = "number", stretch = "boolean",
                lattice = "table", bones = "any", pins = "any", within = "number",
                pieces = "number" }

--- Which of the five options is given.
local function kind_of(options)
  local found
  for _, name in ipairs { "along", "bones", "lattice", "map", "pins" } do
    if options[name] ~= nil then
      if found then refuse("%s and %s are given; it takes one of them", found, name) end
      found = name
    end
  end
  return found or refuse "give one of along, bones, lattice, map and pins"
end

--- object:warp(options)
function warp.apply(object, options)
  fields.check("warp", options, known)
  local kind = kind_of(options)
  for _, name in ipairs { "start", "stretch" } do
    if options[name] ~= nil and kind ~= "along" then refuse("%s goes with along alone", name) end
  end
  local box = { object:bounds() }
  if not box[1] then return object end
  return native.warp(object, maps[kind](options[kind], options, box), options.within or 0,
    options.pieces)
end

-- ---------------------------------------------------------------- boiling lines

local GRAIN = 12 -- the default length of the waves, as a multiple of the amount
local LEAST = 4  -- a multiple of the amount: shorter waves would fold

local boiled = { amount = "number", every = "number", seed = "any", frame = "number",
                 grain = "number", within = "number", pieces = "number" }

local function refuse_boil(text, ...) native.refuse("boil: " .. text:format(...)) end

local function check_boil(options)
  fields.check("boil", options, boiled)
  local amount, every = options.amount, options.every or 2
  for _, name in ipairs { "amount", "frame" } do
    if not fields.is_finite(options[name]) then
      refuse_boil("needs the field '%s', a number", name)
    end
  end
  local grain = options.grain or GRAIN * amount
  fields.must(amount >= 0, "boil: field 'amount'", "0 or more", amount)
  fields.must(every >= 1, "boil: field 'every'", "1 or more", every)
  fields.expect(grain >= LEAST * amount and grain < math.huge, grain, "boil: field 'grain' must be "
    .. "at least %d times the amount, %.14g, or lines would fold", LEAST, LEAST * amount)
  return amount, every, grain
end

--- object:boil(options): the lines wobble, as if each drawing were traced again. The movement of a
--- point depends on its place, so shapes that touch still touch.
function warp.boil(object, options)
  local amount, every, grain = check_boil(options)
  if amount == 0 then return object end
  if not object:bounds() then return object end
  local seed = options.seed or 0
  return native.boil(object, chance.seed(("%s across"):format(seed)),
    chance.seed(("%s down"):format(seed)), options.frame // every, amount, grain,
    options.within or 0, options.pieces)
end

return fields.seal("warp", warp)
