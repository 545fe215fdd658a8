--- What celspan offers and what it takes, out of the annotations for editors, lua/celspan.d.lua: the specs
--- keep them equal to the tables of fields in the binding.
local annotations = {}

local aliases, classes, functions, methods = {}, {}, {}, {}

-- ---------------------------------------------------------------- reading

--- The type at the beginning of a text: up to a space that is in no bracket and behind no comma or colon.
local function type_in(text)
  local depth, at = 0, 1
  while at <= #text do
    local sign = text:sub(at, at)
    if sign:find "[%(%[{<]" then depth = depth + 1 end
    if sign:find "[%)%]}>]" then depth = depth - 1 end
    if sign == " " and depth == 0 and text:sub(at - 1, at - 1) ~= ":" then break end
    at = at + 1
  end
  return text:sub(1, at - 1)
end

local function read_class(line)
  local name, parents = line:match "^%-%-%-@class ([%w_.]+):?%s*(.*)$"
  if not name then return nil end
  local class = { parents = {}, fields = {} }
  for parent in parents:gmatch "[%w_.]+" do table.insert(class.parents, parent) end
  classes[name] = class
  return class
end

local function read_field(class, line)
  local name, mark, rest = line:match "^%-%-%-@field ([%w_]+)(%??) (.*)$"
  if name then
    table.insert(class.fields, { name = name, is_optional = mark == "?", type = type_in(rest) })
  elseif line:find "^%-%-%-@field %[integer%]" then
    class.item = type_in(line:match "%[integer%] (.*)$")
  end
end

local function read_function(types, line)
  local name = line:match "^function celspan%.(%w+)%("
  if name then table.insert(functions, { name = name, types = types }) end
  name = line:match "^function %w+:(%w+)%("
  if name then table.insert(methods, { name = name, types = types }) end
end

local function read(text)
  local class, types
  for line in text:gmatch "[^\n]+" do
    local alias, meaning = line:match "^%-%-%-@alias ([%w_.]+) (.*)$"
    if alias then aliases[alias] = type_in(meaning) end
    class = read_class(line) or line:find "^%-%-%-@field" and class or nil
    if class then read_field(class, line) end
    local parameter = line:match "^%-%-%-@param %w+%?? (.*)$"
    if parameter then
      types = types or {}
      types[#types + 1] = type_in(parameter)
    elseif not line:find "^%-%-%-" then
      read_function(types or {}, line)
      types = nil
    end
  end
end

local file = assert(io.open((package.path:match "^(.-)%?" or "") .. "lua/celspan.d.lua"))
read(file:read "a")
file:close()

-- ---------------------------------------------------------------- asking

--- Functions of the module, and methods of all that it makes: { name =, types = } each.
function annotations.functions() return functions end
function annotations.methods() return methods end

--- The fields of a class and of what it is derived from: { name =, type =, is_optional = } each.
function annotations.fields(name)
  local class, found = classes[name], {}
  for _, parent in ipairs(class and class.parents or {}) do
    for _, field in ipairs(annotations.fields(parent)) do found[#found + 1] = field end
  end
  for _, field in ipairs(class and class.fields or {}) do found[#found + 1] = field end
  return found
end

--- The type of the items in the list of a class; nil: it has none.
function annotations.item(name)
  local class = classes[name]
  if not class or class.item then return class and class.item end
  for _, parent in ipairs(class.parents) do
    if annotations.item(parent) then return annotations.item(parent) end
  end
end

--- The types that a union is made of.
local function union_of(text)
  local found, depth, start = {}, 0, 1
  for place, sign in text:gmatch "()([%(%)%[%]{}<>|])" do
    if sign:find "[%(%[{<]" then depth = depth + 1 end
    if sign:find "[%)%]}>]" then depth = depth - 1 end
    if sign == "|" and depth == 0 then
      found[#found + 1] = text:sub(start, place - 1)
      start = place + 1
    end
  end
  found[#found + 1] = text:sub(start)
  return found
end

--- What a type asks for, of a union one that `take` chooses:
---
---   "word", value        a literal             "list", type       a list of that type
---   "function", type     with that answer      "class", name      a table of its fields
---   "plain", name        anything else
function annotations.parse(text, take)
  while aliases[text] do text = aliases[text] end
  if text:find "^fun%(" then return "function", text:match "%): (.*)$" end
  local union = union_of(text)
  if #union > 1 then return annotations.parse(union[take(#union) + 1], take) end
  local literal = text:match '^"(.*)"$' or tonumber(text)
  if literal then return "word", literal end
  if text:find "%[%]$" then return "list", text:sub(1, -3) end
  local is_table = classes[text] and (text:find "fields$" or text:find "options$" or text:find "style$"
    or text == "celspan.camera" or text == "celspan.filter" or text == "celspan.light_shape" or text == "celspan.gradient")
  return is_table and "class" or "plain", text
end

return annotations
