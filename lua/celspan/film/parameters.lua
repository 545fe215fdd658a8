--- celspan.parameters: values of a film that are given from outside.
--
--   parameters{...} --> declared: { { name =, kind =, default =, ... }, ... }, sorted by name
--   --set, --set-from, celspan_lua_set --> settings --> checked against it --> values
--
-- The settings are a table in the registry of the Lua state (src/kit/lua/module/parameters.h). A
-- host fills it before it runs the script, with { source =, name =, text = } or { source =, json =
-- } for each value or file; `source` is the beginning of messages. Two fields are answers to the
-- host:
-- `declared`, and `refused`, the sentence about a wrong setting.
local native = require "celspan.native"
local ease = require "celspan.ease"
local fields = require "celspan.fields"
local json = require "celspan.json"
local ordered = require "celspan.ordered"

local parameters = {}

-- ---------------------------------------------------------------- kinds

local function range_of(one)
  if one.min and one.max then return (" from %.14g to %.14g"):format(one.min, one.max) end
  return one.min and (" of %.14g or more"):format(one.min)
    or one.max and (" of at most %.14g"):format(one.max) or ""
end

local function is_in_range(one, number)
  return fields.is_finite(number) and number >= (one.min or number)
    and number <= (one.max or number)
end

--- A value that is not a text is already of its type: it comes from JSON or from the script.
local function read_with(reader, given)
  if type(given) == "string" then return reader(given) end
  return given
end

--- A point { x, y } of a text such as "120,80", or of a list of two numbers; nil: it is neither.
local function read_point(given)
  local x, y
  if type(given) == "string" then
    x, y = given:match "^([^,]+),([^,]+)$"
    x, y = x and fields.read_number(x), y and fields.read_number(y)
  elseif type(given) == "table" and #given == 2 then
    x, y = given[1], given[2]
  end
  return fields.is_finite(x) and fields.is_finite(y) and { x, y } or nil
end

--- A value as --set takes it.
local function text_of(value)
  if type(value) ~= "table" then return tostring(value) end
  return ("%.14g,%.14g"):format(value[1], value[2])
end

--- The kinds of values. A reader makes a value from a text, and returns nil for a wrong text.
local kinds = {
  text = { type = "string", read = function(_, text) return text end },
  file = {
    type = "string",
    allowed = function() return "the name of a file" end,
    read = function(_, text) return text ~= "" and text or nil end,
  },
  number = {
    type = "number",
    allowed = function(one) return "a number" .. range_of(one) end,
    read = function(one, text)
      local number = read_with(fields.read_number, text)
      return number and is_in_range(one, number) and number or nil
    end,
  },
  boolean = {
    type = "boolean",
    allowed = function() return fields.booleans end,
    read = function(_, text) return read_with(fields.read_boolean, text) end,
  },
  choice = {
    type = "string",
    allowed = function(one) return "one of " .. table.concat(one.choices, ", ") end,
    read = function(one, text)
      for _, choice in ipairs(one.choices) do
        if choice == text then return text end
      end
    end,
  },
  point = {
    type = "table",
    allowed = function() return 'a point, such as "120,80"' end,
    read = function(_, given) return read_point(given) end,
  },
  ease = {
    type = "string",
    allowed = function() return 'the name of a curve, such as "outBack"' end,
    read = function(_, text) return text ~= "" and pcall(ease, text) and text or nil end,
  },
  colour = {
    type = "string",
    allowed = function() return 'a colour, such as "#f80" or "#ff8800"' end,
    read = function(_, text) return native.hex(text) end,
  },
}

--- A value in the form in which messages show it.
local function shown(value)
  if type(value) == "string" then return "'" .. value .. "'" end
  return type(value) == "table" and "a table" or tostring(value)
end

-- ---------------------------------------------------------------- declaring

local function refuse(name, format, ...)
  error(("parameters: '%s' "):format(name) .. format:format(...), 0)
end

--- The kind of a table, and its default.
local function kind_of_table(name, given)
  local colour = given.colour or given.color
  if colour ~= nil then return "colour", colour end
  if given.ease ~= nil then return "ease", given.ease end
  if given.point ~= nil then
    if given.point ~= true then
      refuse(name, "has a field 'point' that is not true: write { %s, point = true }",
        (text_of(read_point(given.point) or read_point(given) or { 120, 80 }):gsub(",", ", ")))
    end
    return "point", { given[1], given[2] }
  end
  if given.file ~= nil then return "file", given.file end
  local first = given[1]
  if type(first) == "string" then return given[2] ~= nil and "choice" or "text", first end
  if type(first) == "number" or type(first) == "boolean" then return type(first), first end
  refuse(name, "must be a string, a number, a boolean, a list of strings, or a table with a "
    .. "default as [1], a point, colour, ease or file")
end

local known = { number = { 1, min = 1, max = 1 }, boolean = { 1 }, text = { 1 },
                colour = { colour = 1, color = 1 }, file = { file = 1 }, choice = {},
                ease = { ease = 1 }, point = { 1, 1, point = 1 } }
local common = { about = "a string", group = "a string" } -- fields of all kinds

--- "; did you mean 'min'?", or nothing if no field is near.
local function hint_of(kind, field)
  local names = {}
  for _, list in ipairs { known[kind], common } do
    for one in pairs(list) do
      if type(one) == "string" then names[#names + 1] = one end
    end
  end
  table.sort(names)
  return fields.hint(field, names) or ""
end

local function check_names(name, kind, given)
  for field in pairs(given) do
    if not (known[kind][field] or common[field])
      and not (kind == "choice" and math.type(field) == "integer") then
      refuse(name, "is a %s, which has no field '%s'%s", kind, fields.key(field),
        hint_of(kind, field))
    end
  end
end

local function read_choices(name, given)
  local choices, seen = {}, {}
  for i, choice in ipairs(given) do
    if type(choice) ~= "string" then refuse(name, "has choices that are no strings") end
    if seen[choice] then refuse(name, "has the choice \"%s\" twice", choice) end
    choices[i], seen[choice] = choice, true
  end
  return choices
end

local function declare_one(name, given)
  if type(name) ~= "string" or not name:find "^[%a_][%w_]*$" then
    error(("parameters: %s is not a name: letters, digits and _, not beginning with a digit")
      :format(type(name) == "string" and "'" .. name .. "'" or fields.key(name)), 0)
  end
  if type(given) ~= "table" then given = { given } end
  local kind, default = kind_of_table(name, given)
  check_names(name, kind, given)
  local choices = kind == "choice" and read_choices(name, given) or nil
  local one = { name = name, kind = kind, default = default, min = given.min,
                max = given.max, about = given.about, group = given.group, choices = choices }
  for _, bound in ipairs { "min", "max" } do
    if one[bound] ~= nil and not fields.is_finite(one[bound]) then
      refuse(name, "has a field '%s' that is not a finite number", bound)
    end
  end
  for field in pairs(common) do
    if one[field] ~= nil and type(one[field]) ~= "string" then
      refuse(name, "has a field '%s' that is not a string", field)
    end
  end
  if type(default) ~= kinds[kind].type or kinds[kind].read(one, default) == nil then
    refuse(name, "has the default %s, which is not %s", shown(default), kinds[kind].allowed(one))
  end
  one.text = text_of(default)
  return one
end

local function declare_all(given)
  local declared = {}
  for name, value in pairs(given) do declared[#declared + 1] = declare_one(name, value) end
  table.sort(declared, function(a, b) return a.name < b.name end)
  return declared
end

-- ---------------------------------------------------------------- settings

--- Ends the script; the program reports the sentence as wrong usage.
local function refuse_setting(settings, format, ...)
  settings.refused = format:format(...)
  error(settings.refused, 0)
end

--- source: the beginning of messages.
local function find(settings, declared, source, name)
  local names = {}
  for i, one in ipairs(declared) do
    if one.name == name then return one end
    names[i] = one.name
  end
  refuse_setting(settings, "%sthe script has no parameter '%s'%s", source, name,
    fields.choice(name, names))
end

--- The value of a parameter; nil and a sentence: it cannot be that. is_text: the value is a text
--- that must be converted; otherwise it already has its type.
local function read(one, value, is_text)
  local kind, made = kinds[one.kind], nil
  if is_text or type(value) == kind.type then made = kind.read(one, value) end
  if made ~= nil then return made end
  return nil, ("%s is %s; it must be %s"):format(one.name, shown(value),
    kind.allowed and kind.allowed(one) or "a text")
end

local function set(settings, declared, values, source, name, value, is_text)
  local made, fault = read(find(settings, declared, source, name), value, is_text)
  if made == nil then refuse_setting(settings, "%s%s", source, fault) end
  values[name] = made
end

--- Sets the values of a JSON object.
local function set_from(settings, declared, values, given)
  local object, problem = json.decode(given.json)
  if object == nil then refuse_setting(settings, "%s%s", given.source, problem) end
  if type(object) ~= "table" or object == json.null or #object > 0 then
    refuse_setting(settings, '%sit must be a JSON object, { "name": value }', given.source)
  end
  for _, name in ipairs(ordered.names(object)) do
    set(settings, declared, values, given.source, name, object[name])
  end
end

local read_points = {} -- the names of points that the script has read since they were asked for

--- Makes it an error to read an unknown name, and notes which points are read: they are not in the
--- table itself.
local function sealed(values, points)
  local missing = fields.reads("parameters", {})
  return setmetatable(values, {
    __name = "celspan.parameters",
    __index = function(_, name)
      if points[name] == nil then return missing(values, name) end
      read_points[name] = true
      return points[name]
    end,
    __newindex = function(_, name, value)
      if points[name] == nil then return rawset(values, name, value) end
      points[name] = value
    end,
    __pairs = function()
      local all = {}
      for name, value in next, values do all[name] = value end
      for name, value in next, points do all[name], read_points[name] = value, true end
      return next, all
    end })
end

--- The names of the points that the script has read since they were asked for last, each with a
--- comma behind it.
function parameters.reads()
  local names = {}
  for name in pairs(read_points) do names[#names + 1] = name .. "," end
  read_points = {}
  return table.concat(names)
end

--- celspan.parameters.
function parameters.declare(given)
  local settings = native.settings()
  fields.takes("parameters:", "table", "a table of names and defaults", given)
  if settings.declared then native.refuse("parameters: a script declares its parameters once") end
  local good, declared = pcall(declare_all, given)
  if not good then native.refuse(declared) end
  settings.declared = declared
  local values = {}
  for _, one in ipairs(declared) do
    values[one.name] = one.kind == "point" and read_point(one.default) or one.default
  end
  for _, one in ipairs(settings) do
    if one.json then
      set_from(settings, declared, values, one)
    else
      set(settings, declared, values, one.source, one.name, one.text, true)
    end
  end
  local points = {}
  for _, one in ipairs(declared) do
    if one.kind == "point" then points[one.name], values[one.name] = values[one.name], nil end
  end
  return sealed(values, points)
end

--- Why "NAME=VALUE", from a row of a table, cannot be set; "" if it can be set.
function parameters.fault(setting)
  local settings, name, value = native.settings(), setting:match "^(.-)=(.*)$"
  local good, message = pcall(set, settings, settings.declared or {}, {}, "", name,
    value, true)
  settings.refused = nil
  return good and "" or message
end

-- ---------------------------------------------------------------- JSON Schema

local types = { text = "string", file = "string", choice = "string", colour = "string",
                number = "number", boolean = "boolean", ease = "string", point = "array" }
local formats = { colour = "color", file = "path", ease = "ease", point = "point" }

local function schema_of(one)
  local is_point = one.kind == "point"
  local default = is_point and { list = one.default } or one.default
  local members = { { "type", types[one.kind] }, { "default", default } }
  local function add(name, value)
    if value ~= nil then members[#members + 1] = { name, value } end
  end
  if is_point then
    add("items", { { "type", "number" } })
    add("minItems", 2)
    add("maxItems", 2)
  end
  add("description", one.about)
  add("group", one.group)
  add("enum", one.choices and { list = one.choices })
  add("minimum", one.min)
  add("maximum", one.max)
  add("format", formats[one.kind])
  return members
end

--- The parameters that the script of this state has declared, as JSON Schema.
function parameters.schema(title)
  local properties = {}
  for i, one in ipairs(native.settings().declared or {}) do
    properties[i] = { one.name, schema_of(one) }
  end
  return json.encode({
    { "$schema", "https://json-schema.org/draft/2020-12/schema" },
    { "title", title },
    { "type", "object" },
    { "properties", properties },
    { "additionalProperties", false },
  }) .. "\n"
end

--- A parameter of its name and its member of `properties` in the schema, as it was declared.
local function declared_of(name, given)
  local kind = given.enum and "choice" or given.type == "string" and "text" or given.type
  for other, format in pairs(formats) do
    if given.format == format then kind = other end
  end
  return { name = name, kind = kind, min = given.minimum, max = given.maximum,
           about = given.description, group = given.group, choices = given.enum }
end

--- A text for a parameter of a schema as the program shows it, such as "200,90" for "200, 90"; nil
--- and a sentence: it cannot be its value.
function parameters.taken(name, given, text)
  local value, fault = read(declared_of(name, given), text, true)
  if value == nil then return nil, fault end
  return type(value) == "table" and text_of(value) or text
end

--- A value in Lua.
local function literal(value)
  if type(value) ~= "string" then
    return type(value) == "number" and ("%.14g"):format(value) or tostring(value)
  end
  return (("%q"):format(value):gsub("\\\n", "\\n"))
end

--- The default of a declaration, as the parts of a table.
local function parts_of(one, value)
  if one.kind == "point" then return { literal(value[1]), literal(value[2]), "point = true" } end
  if formats[one.kind] then return { one.kind .. " = " .. literal(value) } end
  local parts = { literal(value) }
  for _, choice in ipairs(one.choices or {}) do
    if choice ~= value then parts[#parts + 1] = literal(choice) end
  end
  return parts
end

--- How a script declares a parameter of a schema with a text as its default, such as "sun = { 120,
--- 80, point = true }"; nil: it cannot be its value.
function parameters.line(name, given, text)
  local one = declared_of(name, given)
  local value = read(one, text, true)
  if value == nil then return nil end
  local parts = parts_of(one, value)
  local is_plain = #parts == 1 and not formats[one.kind]
  for _, field in ipairs { "min", "max", "about", "group" } do
    if one[field] ~= nil then
      is_plain, parts[#parts + 1] = false, field .. " = " .. literal(one[field])
    end
  end
  local all = table.concat(parts, ", ")
  local is_word = not load("local " .. name) -- of Lua, such as "end"
  return (is_word and '["%s"] = %s' or "%s = %s"):format(name, is_plain and all
    or "{ " .. all .. " }")
end

--- A value on one line, in a form that a terminal may show: control characters are written as
--- numbers.
local function in_line(value)
  local function number(one) return ("\\x%02x"):format(one:byte()) end
  return (tostring(value):gsub("\xc2([\x80-\x9f])", number):gsub("%c", number))
end

--- The same as lines, "name kind default".
function parameters.lines()
  local lines = {}
  for i, one in ipairs(native.settings().declared or {}) do
    local allowed = kinds[one.kind].allowed
    lines[i] = ("parameter %s %s %s%s\n"):format(one.name, one.kind, in_line(one.text),
      allowed and " (" .. allowed(one) .. ")" or "")
  end
  return table.concat(lines)
end

return fields.seal("parameters", parameters)
