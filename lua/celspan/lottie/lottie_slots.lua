--- Slots: properties of an animation that may be given from outside, by a theme or by `set`.
--
--   "slots": { "tint": { "p": { "a": 0, "k": [1, 0, 0] } } }       and { "sid": "tint" } in layers
local celspan = require "celspan"
local fields = require "celspan.fields"
local ordered = require "celspan.ordered"
local source = require "celspan.lottie_source"
local values = require "celspan.lottie_values"

local slots = {}

-- ---------------------------------------------------------------- values from outside

--- The codes 0..1 of a colour such as "#f80"; nil for other values.
local function codes(text)
  if type(text) ~= "string" or not pcall(celspan.rgb, text) then return nil end
  local digits = text:sub(2)
  if #digits < 6 then digits = digits:gsub(".", "%0%0") end
  local list = {}
  for i = 1, 3 do list[i] = tonumber(digits:sub(2 * i - 1, 2 * i), 16) / 255 end
  return list
end

--- Numbers of a text such as "120, 80".
local function numbers_of(text)
  local list = {}
  for word in text:gmatch "[^,%s]+" do
    list[#list + 1] = tonumber(word)
    if not list[#list] then return nil end
  end
  return list[1] and list
end

local kinds = {
  colour = { shown = 'a colour, such as "#f80"', read = function(value)
    return codes(value) or values.table(value) and values.list(value, { 0, 0, 0 }, 3) end },
  number = { shown = "a number", read = function(value)
    return type(value) == "number" and value == value and value or nil end },
  list = { shown = "numbers", read = function(value)
    return type(value) == "string" and numbers_of(value) or values.table(value) end },
  gradient = { shown = "numbers", read = values.table },
  text = { shown = "a text", read = function(value) return values.text(value) end },
}

--- The documents of a text: keys { t =, s = }.
local function documents(property)
  local k = values.table(property) and values.table(property.k)
  if k and k[1] == nil and values.table(k.s) then return { { 1, k } } end
  return values.items(k)
end

--- A document with other words.
local function reworded(document, words)
  local copy = {}
  for name, value in pairs(values.table(document) or {}) do copy[name] = value end
  copy.t = words
  return copy
end

--- The text of a slot with other words.
local function with_words(property, words)
  local keys = {}
  for i, one in ipairs(documents(property)) do
    keys[i] = { t = one[2].t or 0, s = reworded(one[2].s, words) }
  end
  return { k = #keys > 0 and keys or words }
end

--- Sets a slot to a value from outside; a message if it is of another kind.
local function set_one(slot, name, value)
  local kind = kinds[slot.kind]
  local read = kind and kind.read(value)
  if read == nil or read == false then
    return ("the slot '%s' takes %s"):format(name, kind and kind.shown or "no value")
  end
  slot.property = slot.kind == "text" and with_words(slot.property, read) or { k = read }
end

-- ---------------------------------------------------------------- kinds

local function kind_of(property)
  local k = values.table(property) and property.k
  if type(k) == "number" then return "number" end
  if type(k) == "string" then return "text" end
  if not values.table(k) then return nil end
  local first = values.table(k[1])
  if first then
    local s = first.s
    if values.table(s) and (s.t ~= nil or s.f ~= nil) then return "text" end
    return kind_of { k = values.table(s) and #s == 1 and type(s[1]) == "number" and s[1] or s }
  end
  if #k == 2 then return "list" end
  return (#k == 3 or #k == 4) and "colour" or #k > 4 and "gradient" or nil
end

--- The slots of a document: { property =, kind = } by id. The kind is that of the first property
--- that uses a slot, and is guessed from the value where none does.
function slots.read(document)
  local list = {}
  for name, slot in pairs(values.table(document.slots) or {}) do
    if type(name) == "string" and values.table(slot) then
      list[name] = { property = slot.p, kind = kind_of(slot.p) }
    end
  end
  return list
end

--- The value that a slot has without a setting: a colour as "#rrggbb", a number, a list or a text;
--- nil for a gradient, and where it has keyframes.
local function value_of(slot)
  local k = values.table(slot.property) and slot.property.k
  if slot.kind == "text" then
    local first = values.items(k)[1]
    local s = first and values.table(first[2].s)
    return values.text(k) or s and values.text(s.t)
  end
  if k == nil or values.table(k) and values.table(k[1]) then return nil end
  if slot.kind == "number" then return values.number(k, 0) end
  if slot.kind == "list" then return values.numbers(k) end
  if slot.kind ~= "colour" then return nil end
  local c = values.list(k, { 0, 0, 0 }, 3)
  for i = 1, 3 do c[i] = math.floor(math.max(0, math.min(1, c[i])) * 255 + 0.5) end
  return ("#%02x%02x%02x"):format(c[1], c[2], c[3])
end

--- The slots as scripts see them, when the document has been compiled and their kinds are known.
function slots.list(list)
  local shown = {}
  for name, slot in pairs(list) do
    shown[name] = { kind = slot.kind or "list", value = value_of(slot) }
  end
  return shown
end

-- ---------------------------------------------------------------- themes and settings

--- The stops of a theme as the numbers of a gradient.
local function gradient_of(value)
  local list, alphas = {}, {}
  for _, one in ipairs(values.items(value)) do
    local c, at = values.list(one[2].color, { 0, 0, 0, 1 }, 4), values.number(one[2].offset, 0)
    for _, x in ipairs { at, c[1], c[2], c[3] } do list[#list + 1] = x end
    alphas[#alphas + 1], alphas[#alphas + 2] = at, c[4]
  end
  return table.move(alphas, 1, #alphas, #list + 1, list)
end

--- What a rule of a theme says at one time, as a property of the slot's kind has it.
local function meant(slot, value)
  if slot.kind == "text" then
    local words = values.table(value) and value.text or value
    local first = documents(slot.property)[1]
    return reworded(first and first[2].s, values.text(words, ""))
  end
  if slot.kind ~= "gradient" or not values.table(value) then return value end
  slot.count = #values.items(value)
  return gradient_of(value)
end

--- The keys of a rule; theirs are { frame =, value =, inTangent =, outTangent =, hold = }.
local function keys_of(slot, list)
  local keys = {}
  for i, one in ipairs(values.items(list)) do
    local key = one[2]
    local value = meant(slot, key.value)
    keys[i] = { t = values.number(key.frame, 0), s = values.table(value) or { value },
                h = values.flag(key.hold) and 1 or 0, i = key.inTangent, o = key.outTangent }
  end
  return keys
end

--- Gives a slot the property that its rule and its setting say, when its kind is known.
local function settle(slot, name)
  local rule = slot.rule
  slot.is_settled = true
  if rule and values.table(rule.keyframes) then
    slot.property = { a = 1, k = keys_of(slot, rule.keyframes) }
  elseif rule and slot.kind == "text" then
    slot.property = with_words(slot.property, meant(slot, rule.value).t)
  elseif rule and rule.value ~= nil then
    slot.property = { k = meant(slot, rule.value) }
  end
  if slot.given ~= nil then slot.wrong = set_one(slot, name, slot.given) end
end

--- A function that finds the property of a slot for those that name it.
function slots.finder(list)
  return function(name, kind)
    local slot = type(name) == "string" and list[name]
    if not slot then return nil end
    if not slot.is_settled then
      slot.kind = kind or "path"
      settle(slot, name)
    end
    return slot.property
  end
end

--- A function that finds the colours of a gradient, { p = their number, k = }, which may be a slot.
function slots.gradients(list)
  local find = slots.finder(list)
  return function(given)
    local k = values.table(given.k)
    local name = given.sid or k and k.sid
    local property = values.table(find(name, "gradient"))
    if not property then return given end
    local own = values.table(property.k)
    if own and own.k ~= nil then return { p = property.p or given.p, k = own } end
    return { p = list[name].count or given.p, k = property }
  end
end

--- Settles what no property uses. Returns a message if a value is of another kind than its slot.
---@return string? message
function slots.finish(list)
  for _, name in ipairs(ordered.names(list)) do
    local slot = list[name]
    if not slot.is_settled then settle(slot, name) end
    if slot.wrong then return slot.wrong end
  end
end

--- Whether a rule is for this animation of the file.
local function is_for(rule, id)
  local list = values.table(rule.animations)
  if not list or list[1] == nil then return true end
  for _, one in ipairs(list) do
    if one == id then return true end
  end
  return false
end

--- Keeps the rules of a theme until the kinds of their slots are known.
local function keep(list, rules, id, note)
  for _, one in ipairs(rules) do
    local rule = one[2]
    local slot = type(rule.id) == "string" and list[rule.id]
    if slot and is_for(rule, id) then
      slot.rule = rule
      if rule.expression ~= nil then
        note(("the theme's rule for '%s' has an expression, which is not run"):format(rule.id))
      end
    elseif is_for(rule, id) then
      note(("the theme has a rule for '%s', which is no slot of the animation"):format(
        values.name(rule.id, "?")))
    end
  end
end

--- Keeps the rules of a theme, then values by slot. Returns a message if one of them is unknown.
---@param found table As source.open returns it
---@param list table<string, table>
---@param theme? string
---@param set? table<string, any>
---@param note fun(what: string)
---@return string? message
function slots.apply(found, list, theme, set, note)
  if theme and theme ~= "" then
    local rules, message = source.theme(found, theme)
    if not rules then return message end
    keep(list, rules, found.id, note)
  end
  for _, name in ipairs(ordered.names(set or {})) do
    if not list[name] then
      local names = ordered.names(list)
      return ("there is no slot '%s'%s"):format(name, fields.choice(name, names))
    end
    list[name].given = set[name]
  end
end

return fields.seal("lottie_slots", slots)
