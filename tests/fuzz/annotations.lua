--- The functions, methods and classes of celspan, from the annotations for editors.
local manual = require "tests.support.own" "celspan.manual"

local annotations = {}

local aliases, classes, functions, methods = {}, {}, {}, {}

-- ---------------------------------------------------------------- reading

for _, block in ipairs(manual.read(manual.annotations(), { celspan = "celspan" })) do
  local types = {}
  for i, param in ipairs(block.params) do types[i] = param.type end
  if block.owner then
    table.insert(block.is_method and methods or functions, { name = block.short, types = types })
  elseif block.class then
    local class = { parents = {}, fields = {} }
    for parent in block.parents:gmatch "[%w_.]+" do table.insert(class.parents, parent) end
    for _, field in ipairs(block.fields) do
      if field.name == "[integer]" then class.item = field.type
      else table.insert(class.fields, field) end
    end
    classes[block.class] = class
  elseif block.name then
    aliases[block.name] = block.fields[1].type
  end
end

-- ---------------------------------------------------------------- asking

--- Functions of the module, and methods of all its values: { name =, types = } each.
function annotations.functions() return functions end
function annotations.methods() return methods end

--- The fields of a class and of its base classes: { name =, type =, is_optional = } each.
function annotations.fields(name)
  local class, found = classes[name], {}
  for _, parent in ipairs(class and class.parents or {}) do
    for _, field in ipairs(annotations.fields(parent)) do found[#found + 1] = field end
  end
  for _, field in ipairs(class and class.fields or {}) do found[#found + 1] = field end
  return found
end

--- The type of the items in the list of a class; nil: it has no list.
function annotations.item(name)
  local class = classes[name]
  if not class or class.item then return class and class.item end
  for _, parent in ipairs(class.parents) do
    if annotations.item(parent) then return annotations.item(parent) end
  end
end

--- The members of a union type.
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

--- Classes of tables whose names have none of the usual endings.
local TABLES = {
  ["celspan.camera"] = true, ["celspan.defocus"] = true, ["celspan.filter"] = true,
  ["celspan.light_shape"] = true, ["celspan.gradient"] = true,
}

--- The values that a type requires; of a union, those of the member that `take` chooses:
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
  local is_table = TABLES[text] or text:find "fields$" or text:find "options$"
    or text:find "style$"
  return classes[text] and is_table and "class" or "plain", text
end

return annotations
