--- Objects between two others: celspan.morph(a, b, u).
--
--      a            u = 0.5          b       The parts of both are matched by their names, and the
--    +----+          ----            __      others in order; the outlines of two parts by where
--    |    |   ->    (    )   ->     (  )     they lie and how large they are; and the points of
--    +----+          ----            --      two outlines by length and turning (outlines.lua).
--
-- What has no partner grows from its middle, or shrinks to it. The match is made once for two
-- objects, and kept as long as they are.
local celspan = require "celspan"
local arcs = require "celspan.arcs"
local native = require "celspan.native"
local fields = require "celspan.fields"
local likeness = require "celspan.likeness"
local outlines = require "celspan.outlines"

local morph = {}

local FAR = 0.25 -- of a drawing's longer side

local function refuse(text, ...) native.refuse("morph: " .. text:format(...)) end

local function between(x, y, u) return x + (y - x) * u end

--- An object with the values that both nodes have in common. The first node gives the name.
local function finish(object, p, q, u)
  local fade, name = between(p.fade, q.fade, u), p.name ~= "" and p.name or q.name
  if fade ~= 1 then object = object:fade(fade) end
  return name ~= "" and object:named(name) or object
end

--- One object that becomes another without any movement: the sum of shares of both.
local function dissolved(first, second, u)
  return celspan.group { first:fade(1 - u), second:fade(u):blend "add", isolate = true }
end

-- ---------------------------------------------------------------- paints

--- The matrix that maps one box to another; a side of length 0 is only moved.
local function fitting(from, to)
  local sx = from[3] > 0 and to[3] / from[3] or 1
  local sy = from[4] > 0 and to[4] / from[4] or 1
  return { sx, 0, to[1] - sx * from[1], 0, sy, to[2] - sy * from[2], 0, 0, 1 }
end

--- The texture of a node on an object with other bounds.
local function texture_of(node, box)
  if node.paint then return celspan.paint(node.paint) end
  local own = { node.object:bounds() }
  return own[1] and box[1] and native.move_texture(node.texture, fitting(own, box)) or node.texture
end

--- make: a function of a texture.
local function painted(p, q, u, make)
  if p.paint and q.paint then
    return make(celspan.mix(celspan.paint(p.paint), celspan.paint(q.paint), u))
  end
  local box = { make("#000"):bounds() }
  return dissolved(make(texture_of(p, box)), make(texture_of(q, box)), u)
end

-- ---------------------------------------------------------------- parts

--- The plan for a node without a partner: a function of the node's scale, from 0 to 1.
local function lone(node)
  local x, y, w, h = node.object:bounds()
  if not x then return function() return node.object end end
  return function(share) return node.object:scale(share, share, x + w / 2, y + h / 2) end
end

local function plan_outlines(p, q, steering)
  if (p.line == nil) ~= (q.line == nil) then -- one is a line, the other a shape: both become shapes
    local one, other = native.anatomy(p.object, true), native.anatomy(q.object, true)
    one.name, other.name = p.name, q.name
    p, q = one, other
  end
  local match = outlines.match(p.contours, q.contours, steering, refuse)
  return function(u)
    local contours = outlines.between(match, arcs.field(steering.places, u))
    local style = u < 0.5 and p or q
    return finish(painted(p, q, u, function(texture)
      if not p.line then
        return celspan.path { contours = contours, rule = style.rule, texture = texture }
      end
      return celspan.stroke { contours = contours, width = between(p.line.width, q.line.width, u),
                              cap = style.line.cap, join = style.line.join,
                              miter = between(p.line.miter, q.line.miter, u), texture = texture }
    end), p, q, u)
  end
end

--- The operands of a union with their partners, in order. An operand of the second union without a
--- partner follows the partner of the operand before it.
local function partners(p, q, steering)
  local wanted, by_name, taken, list = {}, {}, {}, {}
  for _, pair in ipairs(steering.names) do wanted[pair[1]] = pair[2] end
  local rest = {}
  for _, node in ipairs(q) do
    if node.name ~= "" then by_name[node.name] = by_name[node.name] or node end
  end
  for _, node in ipairs(p) do
    local partner = by_name[wanted[node.name] or node.name]
    if partner and not taken[partner] then taken[partner], taken[node] = node, partner end
  end
  for _, node in ipairs(q) do
    if not taken[node] and node.name == "" then rest[#rest + 1] = node end
  end
  local found = steering.unsure and likeness.partners(p, rest, steering)
  for _, node in ipairs(p) do
    local partner = node.name == "" and (found or rest)[found and node or 1]
    if partner and not found then table.remove(rest, 1) end
    if partner then taken[partner], taken[node] = node, partner end
    list[#list + 1] = { node, taken[node] }
  end
  local at = 1
  for _, node in ipairs(q) do
    if taken[node] then
      for i, entry in ipairs(list) do at = entry[2] == node and i + 1 or at end
    else
      table.insert(list, at, { nil, node })
      at = at + 1
    end
  end
  return list
end

local plan -- for two nodes: a function of u

local function plan_union(p, q, steering)
  local plans = {}
  for i, pair in ipairs(partners(p, q, steering)) do
    local first, second = pair[1], pair[2]
    if first and second then
      plans[i] = plan(first, second, steering)
    else
      local alone = lone(first or second)
      plans[i] = function(u) return alone(first and 1 - u or u) end
    end
  end
  return plans
end

--- Whether two nodes can become one boolean.
local function is_alike(p, q)
  return p.kind == "boolean" and q.kind == "boolean" and p.op == q.op
    and (p.op == "union" or #p == #q)
end

function plan(p, q, steering)
  if p.kind == "outline" and q.kind == "outline" then return plan_outlines(p, q, steering) end
  local function is_union(node) return node.kind == "boolean" and node.op == "union" end
  --- Makes an outline a union with one operand, if its partner is a union.
  local function widened(node)
    return { kind = "boolean", op = "union", name = "", fade = 1, object = celspan.union {}, node }
  end
  if is_union(p) and q.kind == "outline" then q = widened(q) end
  if is_union(q) and p.kind == "outline" then p = widened(p) end
  if not is_alike(p, q) then
    return function(u) return dissolved(p.object, q.object, u) end
  end
  local plans = {}
  if is_union(p) then
    plans = plan_union(p, q, steering)
  else
    for i = 1, #p do plans[i] = plan(p[i], q[i], steering) end
  end
  return function(u)
    local operands = {}
    for i, make in ipairs(plans) do operands[i] = make(u) end
    return finish(native.rebuild((u < 0.5 and p or q).object, operands), p, q, u)
  end
end

-- ---------------------------------------------------------------- pairs

--- From where to where, and the angle of the arc; 0 for a straight way.
local function read_places(i, pair)
  local first, last, turn = pair[1], pair[3] or pair[2], 0
  for _, point in ipairs(pair) do
    fields.numbers("morph", ("pair %d: its value %%d"):format(i), point, 2, "{x, y}")
  end
  if pair[3] then
    turn = arcs.turn(first, pair[2], last)
      or refuse("pair %d: no circle goes from its first place through the second to the third", i)
  end
  return { first[1], first[2], last[1], last[2], turn }
end

--- The pairs of names, and the pairs of places; `key` is the same for the same pairs.
local function read_pairs(list)
  local steering, key = { names = {}, places = {} }, {}
  for i = 1, rawlen(list or {}) do
    local pair = list[i]
    local first, second = table.unpack(type(pair) == "table" and pair or {})
    if type(first) == "string" and type(second) == "string" then
      steering.names[#steering.names + 1] = pair
      key[#key + 1] = ("%q %q"):format(first, second)
    elseif type(first) == "table" and type(second) == "table" then
      local place = read_places(i, pair)
      place.number = i
      steering.places[#steering.places + 1] = place
      key[#key + 1] = ("%a %a %a %a %a"):format(table.unpack(place))
    else
      refuse("pair %d must be two places {{x, y}, {x, y}}, three, or two names of parts, got %s", i,
        fields.kind(pair))
    end
  end
  return steering, table.concat(key, ";")
end

--- Whether a node, or a node inside it, has this name.
local function has_name(node, name)
  if node.name == name then return true end
  for _, child in ipairs(node) do
    if has_name(child, name) then return true end
  end
  return false
end

local function check_names(p, q, names)
  for _, pair in ipairs(names) do
    for k, node in ipairs { p, q } do
      if not has_name(node, pair[k]) then
        refuse("there is no part %q in the %s object", pair[k], k == 1 and "first" or "second")
      end
    end
  end
end

--- The contours of the outline that is nearest to a place.
local function nearest(node, x, y, best)
  for _, contour in ipairs(node.contours or {}) do
    local distance = outlines.distance(contour, x, y)
    if distance < best.distance then best.distance, best.contours = distance, node.contours end
  end
  for _, child in ipairs(node) do nearest(child, x, y, best) end
  return best.contours, best.distance
end

--- Between drawings, a place chooses a piece, and so lies near one.
local function check_near(node, which, place, x, y, distance)
  local _, _, w, h = node.object:bounds()
  if w and distance > FAR * math.max(w, h) then
    refuse("pair %d: no line of the %s drawing is near (%g, %g); the nearest is %.4g away",
      place.number, which, x, y, distance)
  end
end

--- Assigns each pair of places to the nearest outlines of both nodes.
local function assign(p, q, steering)
  local given = {}
  for _, place in ipairs(steering.places) do
    local x, y, u, v = table.unpack(place)
    local own, far = nearest(p, x, y, { distance = math.huge })
    local other, far_off = nearest(q, u, v, { distance = math.huge })
    if steering.unsure then
      check_near(p, "first", place, x, y, far)
      check_near(q, "second", place, u, v, far_off)
      if own and given[own] and given[own] ~= other then
        refuse("pair %d: the piece at (%g, %g) has another partner already", place.number, x, y)
      end
    end
    place.contours = own
    if own then given[own] = other end
  end
  steering.given = given
end

-- ---------------------------------------------------------------- the face

local kept = setmetatable({}, { __mode = "k" })

--- The plan for two objects, which is made on first use, and its steering. by_place: pieces without
--- names are matched by likeness, not in order.
local function plan_of(a, b, list, by_place)
  local steering, key = read_pairs(list)
  kept[a] = kept[a] or setmetatable({}, { __mode = "k" })
  kept[a][b] = kept[a][b] or {}
  local plans = kept[a][b]
  if by_place then steering.unsure, key = {}, key .. ";by place" end
  if not plans[key] then
    local p, q = native.anatomy(a), native.anatomy(b)
    check_names(p, q, steering.names)
    assign(p, q, steering)
    plans[key] = { make = plan(p, q, steering), unsure = steering.unsure }
  end
  return plans[key]
end

--- The object between two drawings, whose pieces without names are matched by place, length and
--- direction; and the list of pairs that are not sure, as of likeness.partners.
function morph.drawings(a, b, u, list)
  local made = plan_of(a, b, list, true)
  return u <= 0 and a or u >= 1 and b or made.make(u), made.unsure
end

--- The object between two others. Outlines are matched by length and turning, parts by name and in
--- order; at 0 and 1 it is the one and the other.
---@param a celspan.object
---@param b celspan.object
---@param u number Limited to 0..1
---@param options? { pairs?: table[] } Two places {{x, y}, {x, y}}, three on an arc, or two names of parts each
---@return celspan.object
function morph.between(a, b, u, options)
  fields.check("morph", options or {}, { pairs = "table" })
  fields.expect(fields.is_finite(u), u, "morph: takes a share from 0 to 1 as its third argument")
  local given = { a, b }
  for i = 1, 2 do
    fields.expect_kind(fields.is_object(given[i]), given[i],
      "morph: argument %d must be an object", i)
  end
  local list = options and options.pairs
  if u <= 0 or u >= 1 then
    read_pairs(list) -- only to refuse mistakes in the list; nothing must be matched
    return u <= 0 and a or b
  end
  return plan_of(a, b, list).make(u)
end

return fields.seal("morph", morph)
