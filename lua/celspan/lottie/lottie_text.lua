--- Text layers: their documents, and animators that move and colour letters.
local affine = require "celspan.affine"
local celspan = require "celspan"
local letters = require "celspan.lottie_letters"
local paint = require "celspan.lottie_paint"
local property = require "celspan.lottie_property"
local ranges = require "celspan.lottie_ranges"
local text_path = require "celspan.lottie_text_path"
local transform = require "celspan.lottie_transform"
local values = require "celspan.lottie_values"

local text = {}

-- ---------------------------------------------------------------- documents

--- The document at a frame: the last key that is not later.
local function documents(scope, given)
  local slot = values.table(given) and scope.root.slot(given.sid, "text")
  given = slot or given
  local keys = values.table(given) and given.k
  if type(values.table(given) and given.x) == "string" then
    scope.note "the text has an expression, which is not run; the value without it is shown"
  end
  if type(keys) == "string" then keys = { { s = { t = keys }, t = 0 } } end
  if values.table(keys) and keys.s and keys[1] == nil then keys = { { s = keys, t = 0 } } end
  local list = {}
  for _, one in ipairs(values.items(keys)) do
    if values.table(one[2].s) then
      list[#list + 1] = { t = values.number(one[2].t, 0), value = one[2].s, place = one[1] }
    end
  end
  table.sort(list, function(a, b) return a.t < b.t or a.t == b.t and a.place < b.place end)
  return list
end

local function document_at(list, t)
  local found = list[1]
  for _, one in ipairs(list) do
    if one.t <= t then found = one end
  end
  return found and found.value
end

-- ---------------------------------------------------------------- animators

--- What animators change, by short names, in the order in which it is read: its default, and what
--- reads it.
local known = {
  { "a", { 0, 0 }, property.list }, { "p", { 0, 0 }, property.list },
  { "s", { 100, 100 }, property.list }, { "r", 0, property.number }, { "sk", 0, property.number },
  { "sa", 0, property.number }, { "o", 100, property.number }, { "fo", 100, property.number },
  { "so", 100, property.number }, { "sw", 0, property.number }, { "t", 0, property.number },
  { "fc", nil, property.colour }, { "sc", nil, property.colour },
}
local is_known = {}
for _, one in ipairs(known) do is_known[one[1]] = true end

--- Notes what an animator has and does not change here.
local function note_others(scope, a)
  local others = {}
  for name in pairs(a) do
    if type(name) == "string" and not is_known[name] then
      others[#others + 1] = ("'%s'"):format(values.name(name, "?"))
    end
  end
  table.sort(others)
  if others[1] then
    scope.note(("what the animator changes by %s is left out"):format(table.concat(others, ", ")))
  end
end

--- An animator: its properties by their short names, and its ranges.
local function animator(scope, item)
  local a, made = values.table(item.a) or {}, { get = {} }
  local read, moves = property.reader(scope)
  for _, one in ipairs(known) do
    local name, default, how = one[1], one[2], one[3]
    if a[name] ~= nil then
      made.get[name] = read(how, a[name], "the animator's " .. name, default)
    end
  end
  note_others(scope, a)
  made.range = read(ranges.compile, item.s)
  return made, moves()
end

local function mixed(base, to, k)
  return { base[1] + k * (to[1] - base[1]), base[2] + k * (to[2] - base[2]),
           base[3] + k * (to[3] - base[3]) }
end

--- Changes how a letter looks by one animator, as far as its range reaches.
local function animate(one, look, k, t)
  local get = one.get
  local p, s = get.p and get.p(t), get.s and get.s(t)
  if p then look.x, look.y = look.x + k * p[1], look.y + k * p[2] end
  if s then
    look.sx, look.sy = look.sx * (1 + k * (s[1] / 100 - 1)), look.sy * (1 + k * (s[2] / 100 - 1))
  end
  if get.r then look.turn = look.turn + k * get.r(t) end
  if get.a then
    local anchor = get.a(t)
    look.ax, look.ay = look.ax + k * anchor[1], look.ay + k * anchor[2]
  end
  if get.sk then look.skew = look.skew + k * get.sk(t) end
  if get.sa then look.axis = look.axis + k * get.sa(t) end
  if get.o then look.opacity = look.opacity * (1 + k * (get.o(t) / 100 - 1)) end
  if get.fo then look.fill_opacity = look.fill_opacity * (1 + k * (get.fo(t) / 100 - 1)) end
  if get.so then look.stroke_opacity = look.stroke_opacity * (1 + k * (get.so(t) / 100 - 1)) end
  if get.fc then look.fill = look.fill and mixed(look.fill, get.fc(t), k) end
  if get.sc then look.stroke = mixed(look.stroke or { 0, 0, 0 }, get.sc(t), k) end
  if get.sw then look.width = look.width + k * get.sw(t) end
  if get.t then look.tracking = look.tracking + k * get.t(t) end
end

-- ---------------------------------------------------------------- letters

local function texture(colour, opacity)
  return paint.coded(colour[1], colour[2], colour[3], opacity)
end

--- The drawn letter in its look, at 0, 0.
local function painted(letter, look, over)
  local parts = {}
  if look.fill and look.fill_opacity > 0 then
    parts[1] = letters.object(letter, texture(look.fill, look.fill_opacity))
  end
  if look.stroke and look.width > 0 and look.stroke_opacity > 0 then
    local line = letters.object(letter, texture(look.stroke, look.stroke_opacity), look.width)
    table.insert(parts, over and 1 or #parts + 1, line)
  end
  if #parts < 2 then return parts[1] end
  return celspan.union(parts)
end

--- place: the map of its middle on a path, or nil.
local function shown(letter, look, over, shift, place)
  local object = look.opacity > 0 and painted(letter, look, over)
  if not object then return nil end
  local middle = letter.advance / 2
  local x = place and 0 or letter.x + shift + look.x + middle
  local map = transform.map({ x, letter.y + look.y }, { middle + look.ax, look.ay },
    { look.sx * 100, look.sy * 100 }, look.turn, look.skew, look.axis)
  if place then map = affine.compose(place, map) end
  object = object:transform(affine.matrix(map))
  return look.opacity < 1 and celspan.group { object, opacity = look.opacity } or object
end

--- A colour of a document, or nil; 0..255 in old files.
local function colour_of(given)
  if not values.table(given) then return nil end
  local list = values.list(given, { 0, 0, 0 }, 3)
  if math.max(list[1], list[2], list[3]) > 1.5 then
    for i = 1, 3 do list[i] = list[i] / 255 end
  end
  return list
end

--- How all letters of a document look before they are animated.
local function base_look(given)
  local fill, stroke = colour_of(given.fc), colour_of(given.sc)
  return { x = 0, y = 0, ax = 0, ay = 0, sx = 1, sy = 1, turn = 0, skew = 0, axis = 0, opacity = 1,
           fill_opacity = 1, stroke_opacity = 1, tracking = 0, fill = fill, stroke = stroke,
           width = stroke and values.number(given.sw, 0) or 0 }
end

--- The looks of all letters, and how much wider animated tracking makes each line.
local function looks_of(list, given, animators, t)
  local looks, extra, size = {}, {}, values.number(given.s, 12)
  for i, letter in ipairs(list) do
    local look = base_look(given)
    for _, one in ipairs(animators) do animate(one, look, one.range(list, i, t), t) end
    looks[i] = look
    extra[letter.line] = (extra[letter.line] or 0) + look.tracking * size / 1000
  end
  return looks, extra, size
end

local shares = { [0] = 0, 1, 0.5 }

--- path: as text_path.compile returns it.
local function draw(list, given, animators, path, t)
  local looks, extra, size = looks_of(list, given, animators, t)
  local objects, shift, line = {}, 0, nil
  local justify = values.number(given.j, 0) % 3
  local share, place_of = shares[justify] or 0, path and path(list, justify, t)
  for i, letter in ipairs(list) do
    if letter.line ~= line then line, shift = letter.line, -share * extra[letter.line] end
    local place = place_of and place_of(i, shift + looks[i].x)
    objects[#objects + 1] = shown(letter, looks[i], given.of ~= true, shift, place)
    shift = shift + looks[i].tracking * size / 1000
  end
  return #objects > 0 and celspan.union(objects) or nil
end

--- Notes letters that turn and grow about other points than the middle of each.
local function note_grouping(scope, given)
  local more = values.table(given.m) or {}
  local shift = values.table(more.a) and values.list(more.a.k, { 0, 0 }, 2) or { 0, 0 }
  if values.number(more.g, 1) ~= 1 or shift[1] ~= 0 or shift[2] ~= 0 then
    scope.note "the grouping of its anchors is left out; each letter turns about its middle"
  end
end

--- The contents of a text layer.
---@return (fun(t: number): any)? get
---@return boolean moves
function text.compile(scope, item)
  local given = values.table(item.t) or {}
  local list, animators = documents(scope, given.d), {}
  local moves = #list > 1
  for n, one in ipairs(values.items(given.a)) do
    local made, is_moving = animator(scope.within((".t.a[%d]"):format(one[1] - 1), one[2].nm),
      one[2])
    animators[n], moves = made, moves or is_moving
  end
  local path, moves_path = text_path.compile(scope, item)
  moves = moves or moves_path
  note_grouping(scope, given)
  local laid = {}
  for _, one in ipairs(list) do laid[one.value] = letters.lay(scope.root, one.value, scope.note) end
  return paint.memo(moves, function(t)
    local document = document_at(list, t)
    if not document then return nil end
    return draw(laid[document], document, animators, path, t)
  end), moves
end

return require "celspan.fields".seal("lottie_text", text)
