--- Drawings in the colours of another palette: ink.recolour.
local celspan = require "celspan"
local native = require "celspan.native"
local fields = require "celspan.fields"

local ink = {}

local known = { strict = "boolean", space = "string" }

-- ---------------------------------------------------------------- colours

--- The colour that a value is; nil if it is no colour.
local function colour_of(value)
  local read = type(value) == "userdata" and function() return value.pigment and value end
  local good, paint = pcall(read or celspan.rgb, value)
  return good and paint or nil
end

--- The light of a colour, three numbers. Its alpha stays in a drawing, so it must not have one.
local function light_of(name, value)
  local paint = colour_of(value)
  if not paint then
    native.refuse(("ink: recolour: %s must be a colour, such as \"#f2c6a0\", got %s"):format(name,
      type(value) == "string" and ("%q"):format(value) or fields.kind(value)))
  end
  fields.expect(paint.beta == 1, paint.beta, "ink: recolour: %s must have an alpha of 1", name)
  return paint.pigment
end

--- Refuses names of a palette that another one does not have.
local function must_share(which, names, other)
  for name in next, names do
    if other[name] == nil then
      native.refuse(("ink: recolour: only the %s palette has '%s'"):format(which,
        fields.key(name)))
    end
  end
end

--- What becomes of each colour: { name, old, new }. to: nil if `from` has new colours by old ones.
local function pairs_of(from, to)
  local list = {}
  must_share("first", to and from or {}, to)
  must_share("second", to or {}, from)
  for key, value in next, from do
    list[#list + 1] = { fields.key(key), to and value or key, to and to[key] or value }
  end
  if #list == 0 then native.refuse "ink: recolour: there are no colours" end
  table.sort(list, function(a, b) return a[1] < b[1] end)
  return list
end

--- The lights of old and of new colours as two lists. A colour may be twice if it becomes the same.
local function lists_of(changes)
  local from, to, seen = {}, {}, {}
  for _, change in ipairs(changes) do
    local name = ("'%s'"):format(change[1])
    local old, new = light_of(name, change[2]), light_of("the new colour of " .. name, change[3])
    local key, value = table.concat(old, " "), table.concat(new, " ")
    local other = seen[key]
    if other and other[2] ~= value then
      native.refuse(("ink: recolour: %s and %s are one colour, and become two"):format(other[1],
        name))
    elseif not other then
      seen[key] = { name, value }
      table.move(old, 1, 3, #from + 1, from)
      table.move(new, 1, 3, #to + 1, to)
    end
  end
  return from, to
end

-- ---------------------------------------------------------------- films

local kept = {} -- the lights of the palettes of all films

local function keep_set(set)
  for name, value in next, set do
    local light = light_of(("'%s'"):format(fields.key(name)), value)
    table.move(light, 1, 3, #kept + 1, kept)
  end
end

--- For celspan.film: keeps the colours of its palettes.
function ink.keep(palettes)
  fields.expect_kind(type(palettes) == "table", palettes, "film: field 'palettes' must be a list")
  for i, palette in ipairs(palettes) do
    fields.expect_kind(type(palette) == "table", palette,
      "film: palettes[%d] must be a table of colours by name", i)
    for _, set in next, getmetatable(palette) and rawget(palette, "sets") or { palette } do
      keep_set(set)
    end
  end
end

--- For `celspan check`: these lights as 8-byte floats; "": there are none.
function ink.kept() return ("<" .. ("d"):rep(#kept)):pack(table.unpack(kept)) end

-- ---------------------------------------------------------------- values

local change

--- The items of a list in the new colours, for :with.
local function items_of(value, recolouring)
  local items = {}
  for i = 1, #value do items[i] = change(value[i], recolouring, {}) end
  return items
end

--- A copy of a table of drawings, or what its class makes of it. around: the tables it lies in.
local function change_table(value, recolouring, around)
  local class = getmetatable(value)
  local own = class and rawget(class, "__recolour")
  if own then return own(value, function(object) return change(object, recolouring, {}) end) end
  if class then return nil end
  if around[value] then native.refuse "ink: recolour: a table contains itself" end
  local copy = {}
  around[value] = true
  for key, item in next, value do copy[key] = change(item, recolouring, around) or item end
  around[value] = nil
  return copy
end

function change(value, recolouring, around)
  if type(value) == "table" then return change_table(value, recolouring, around) end
  if type(value) ~= "userdata" then return nil end
  local made, kind = native.recolour(recolouring, value), fields.kind(value)
  if not made and (kind == "a cel" or kind == "a rostrum") then
    made = #value > 0 and value:with(items_of(value, recolouring)) or value
  end
  return made
end

--- Whether a third argument is options and no palette. An empty table is, after new colours by old
--- ones.
local function is_options(value, from)
  for name in next, value do
    if not known[name] then return false end
  end
  for key in next, from do
    if next(value) == nil and not colour_of(key) then return false end
  end
  return true
end

--- A value in other colours. Alpha stays. In pictures, a pixel between two or three colours becomes
--- the same mixture of the new ones; colours that are not named stay.
---@generic T
---@param value T An object, a cel, a rostrum, a picture, a tree of layers, or a table of these
---@param from table<string, celspan.colour>|celspan.colour Colours by name, or new colours by old ones
---@param to? table<string, celspan.colour>|celspan.colour The new colours by the same names
---@param options? { strict?: boolean, space?: "srgb"|"linear" } strict: list what stays; space: how pixels are mixed, default "srgb"
---@return T value
---@return { colour: string, count: integer, place: string, x?: integer, y?: integer }[]? strange With strict: at most 256 colours, each with its first place
function ink.recolour(value, from, to, options)
  local is_map = type(from) == "table" and options == nil
    and (to == nil or type(to) == "table" and is_options(to, from))
  if is_map then
    to, options = nil, to
  elseif type(from) ~= "table" and from and to then
    from, to = { from }, { to }
  end
  fields.expect_kind(type(from) == "table" and (to == nil or type(to) == "table"), to,
    "ink: recolour takes two palettes, two colours, or a table of new colours by old ones")
  options = fields.check("ink: recolour", options or {}, known)
  fields.space("ink: recolour", options.space)
  local old, new = lists_of(pairs_of(from, to))
  local recolouring = native.recolouring(old, new, options.space == "linear", options.strict)
  local made = change(value, recolouring, {})
  fields.expect_kind(made ~= nil, value, "ink: recolour takes objects, cels, rostrums, pictures, "
    .. "trees of layers, and tables of these")
  return made, options.strict and native.strange(recolouring) or nil
end

return ink
